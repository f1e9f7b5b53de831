# SPDX-License-Identifier: BSD-3-Clause
"""Simple shapes as meshes, the building stones of parts and places."""
import numpy as np

import geometry


def box(size, centre=(0, 0, 0), angle=0.):
    """A box, turned about the vertical through its centre."""
    corners = np.array([[x, y, z] for x in (-.5, .5) for y in (-.5, .5) for z in (-.5, .5)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
             (1, 5, 7, 3)]
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    turned = corners * size @ geometry.turn_about_z(angle).T
    return turned + centre, faces


def standing(size, x, y, angle=0., bottom=0.):
    """A box of which the middle of the bottom is at (x, y, bottom)."""
    return box(size, (x, y, bottom + size[2] / 2), angle)


def extruded(outline, low, high, hole=None):
    """A star-shaped outline (n x 2) as a prism, with a hole of as many points or none."""
    n = len(outline)
    inner = np.repeat(outline.mean(0)[None], n, axis=0) if hole is None else hole
    rings = [np.c_[ring, np.full(n, z)] for z in (low, high) for ring in (outline, inner)]
    i = np.arange(n)
    j = (i + 1) % n

    def band(a, b):
        a, b = a * n, b * n
        return np.vstack([np.c_[a + i, a + j, b + j], np.c_[a + i, b + j, b + i]])

    faces = [band(0, 2), band(1, 0), band(2, 3)] + ([] if hole is None else [band(3, 1)])
    return np.vstack(rings), np.vstack(faces)


def circle(radius, n=48, start=0.):
    angles = start + np.linspace(0, 2 * np.pi, n, endpoint=False)
    return radius * np.c_[np.cos(angles), np.sin(angles)]


def cylinder(radius, low, high, x=0., y=0., n=32):
    vertices, faces = extruded(circle(radius, n), low, high)
    return vertices + [x, y, 0], faces


def revolved(profile, n=64):
    """What the profile, pairs of radius and height, sweeps about the vertical."""
    rings = [np.c_[circle(radius, n), np.full(n, height)] for radius, height in profile]
    i = np.arange(n)
    j = (i + 1) % n
    faces = [t for k in range(0, n * (len(profile) - 1), n) for t in (
        np.c_[k + i, k + j, k + n + j], np.c_[k + i, k + n + j, k + n + i])]
    return np.vstack(rings), np.vstack(faces)


def sheet(points):
    """The surface through a grid of points (rows x columns x 3)."""
    rows, columns = points.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = (x.ravel() for x in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:],
                                      index[1:, :-1]))
    return points.reshape(-1, 3), np.vstack([np.c_[a, d, c], np.c_[a, c, b]])


def skins(points, thickness):
    """The sheet through the grid, its other skin so far below, and the rim between."""
    down = points - [0, 0, thickness]
    rim = [np.stack([points[0], down[0]]), np.stack([down[-1], points[-1]]),
           np.stack([down[:, 0], points[:, 0]]), np.stack([points[:, -1], down[:, -1]])]
    vertices, faces = sheet(down)
    return geometry.joined(sheet(points), (vertices, faces[:, ::-1]), *map(sheet, rim))


def ball(levels=4):
    """The unit sphere, an octahedron refined so often."""
    vertices = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1.],
                         [0, 0, -1]])
    faces = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5],
                      [3, 1, 5], [0, 3, 5]])
    vertices, faces = geometry.refined((vertices, faces), 1.5 / 2 ** (levels - 1))
    return vertices / np.linalg.norm(vertices, axis=1)[:, None], faces
