# SPDX-License-Identifier: BSD-3-Clause
"""Poses, and meshes as pairs of vertices (n x 3) and triangles (m x 3)."""
import numpy as np


def random_rotation(rng):
    """A rotation matrix, uniform over all rotations."""
    w, x, y, z = (lambda q: q / np.linalg.norm(q))(rng.normal(size=4))
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def turn_about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.]])


def similarity(rotation=np.eye(3), shift=(0, 0, 0), scale=1.):
    matrix = np.eye(4)
    matrix[:3, :3] = scale * np.asarray(rotation)
    matrix[:3, 3] = shift
    return matrix


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def moved_mesh(matrix, mesh):
    return moved(matrix, mesh[0]), mesh[1]


def diagonal(points):
    """Length of the diagonal of the box around the points."""
    return np.linalg.norm(np.ptp(points, axis=0))


def joined(*meshes):
    firsts = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    return (np.vstack([vertices for vertices, _ in meshes]),
            np.vstack([faces + first for (_, faces), first in zip(meshes, firsts)]))


def unit(mesh):
    """The mesh about the origin, its diagonal 1."""
    vertices, faces = mesh
    middle = (vertices.min(0) + vertices.max(0)) / 2
    return (vertices - middle) / diagonal(vertices), faces


def mirrored(mesh):
    vertices, faces = mesh
    return vertices * [-1, 1, 1], faces[:, ::-1]


def face_normals(mesh):
    """Unit normals and areas of the triangles."""
    a, b, c = (mesh[0][mesh[1][:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    return normals / np.maximum(lengths, 1e-30)[:, None], lengths / 2


def sampled(mesh, count, rng, weights=None):
    """Random points on the mesh, uniform by area unless the triangles have weights,
    and their triangles."""
    weights = face_normals(mesh)[1] if weights is None else weights
    cumulated = np.cumsum(weights)
    chosen = np.searchsorted(cumulated, rng.random(count) * cumulated[-1])
    chosen = np.minimum(chosen, len(weights) - 1)
    a, b, c = (mesh[0][mesh[1][chosen, k]] for k in range(3))
    r, s = np.sqrt(rng.random((count, 1))), rng.random((count, 1))
    return (1 - r) * a + r * (1 - s) * b + r * s * c, chosen


def refined(mesh, edge):
    """The mesh with triangles of edges no longer than edge."""
    vertices, faces = mesh
    done = []
    while len(faces):
        corners = vertices[faces]
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(1)
        done.append(corners[longest <= edge])
        a, b, c = (corners[longest > edge][:, k] for k in range(3))
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = np.concatenate([np.stack(t, axis=1) for t in (
            (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
        vertices, faces = parts.reshape(-1, 3), np.arange(3 * len(parts)).reshape(-1, 3)
    corners = np.concatenate(done)
    return corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3)


def bent(mesh, amount, rng):
    """The mesh bent by a few long waves, so far root mean square, in diagonals."""
    vertices, faces = mesh
    size = diagonal(vertices)
    offsets = np.zeros_like(vertices)
    for _ in range(6):
        wave = rng.normal(size=3) * 2 * np.pi / (size * rng.uniform(.3, 1.))
        offsets += np.sin(vertices @ wave + rng.uniform(0, 6.3))[:, None] * rng.normal(size=3)
    return vertices + offsets * amount * size / np.sqrt((offsets ** 2).sum(1).mean()), faces
