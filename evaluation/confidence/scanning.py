# SPDX-License-Identifier: BSD-3-Clause
"""What scanners see of meshes: one point for each ray, the nearest."""
import numpy as np

import geometry


def samples_as_seen(mesh, eye, count, rng):
    """Random points on the mesh, about even in directions from the eye."""
    normals, areas = geometry.face_normals(mesh)
    rays = mesh[0][mesh[1]].mean(1) - eye
    ranges = np.maximum(np.linalg.norm(rays, axis=1), 1e-9)
    facing = np.abs((normals * rays).sum(1)) / ranges
    return geometry.sampled(mesh, count, rng, areas * (facing + .02) / ranges ** 2)[0]


def nearest_of_each(bins, ranges):
    """Indices of the nearest point of each bin."""
    order = np.argsort(ranges)
    return order[np.unique(bins[order], return_index=True)[1]]


def with_range_noise(points, eye, sigma, rng):
    rays = points - eye
    ranges = np.linalg.norm(rays, axis=1, keepdims=True)
    return points + rays / ranges * rng.normal(size=(len(points), 1)) * sigma


def scan_around(mesh, eye, count, rng, noise, low=-60, high=60, field=360, heading=0.,
                reach=np.inf):
    """A scanner that turns about the vertical; angles in degrees. The mesh is refined."""
    points = samples_as_seen(mesh, eye, 25 * count, rng)
    rays = points - eye
    ranges = np.linalg.norm(rays, axis=1)
    azimuth = (np.degrees(np.arctan2(rays[:, 1], rays[:, 0])) - heading + 180) % 360 - 180
    elevation = np.degrees(np.arcsin(rays[:, 2] / ranges))
    seen = (abs(azimuth) < field / 2) & (elevation > low) & (elevation < high)
    seen &= ranges < reach
    step = np.sqrt(field * (high - low) / count)
    bins = (np.floor(azimuth / step) * 100000 + np.floor(elevation / step))[seen]
    chosen = np.nonzero(seen)[0][nearest_of_each(bins, ranges[seen])]
    return with_range_noise(points[chosen], eye, noise, rng)


def depth_view(mesh, direction, count, rng, noise, distance=2.5):
    """A camera that looks at the origin along the direction, so many diagonals away."""
    ahead = direction / np.linalg.norm(direction)
    eye = -ahead * distance * geometry.diagonal(mesh[0])
    points = samples_as_seen(mesh, eye, 25 * count, rng)
    right = np.cross(ahead, [0, 0, 1.] if abs(ahead[2]) < .9 else [1., 0, 0])
    right /= np.linalg.norm(right)
    rays = points - eye
    depth = rays @ ahead
    across = np.c_[rays @ right, rays @ np.cross(ahead, right)] / depth[:, None]
    across -= across.min(0)
    step = np.sqrt(.6 * np.prod(np.ptp(across, axis=0)) / count)
    columns = np.floor(across / step).astype(int)
    chosen = nearest_of_each(columns[:, 0] * 100000 + columns[:, 1], depth)
    return with_range_noise(points[chosen], eye, noise, rng)


def kept_part(points, share, rng, direction=None):
    """The share of the points that is farthest in the direction, and the direction."""
    direction = rng.normal(size=3) if direction is None else direction
    along = points @ direction
    return points[along >= np.quantile(along, 1 - share)], direction


def denser_on_one_side(points, rng, ratio=30):
    """Fewer of the points, the fewer the farther in a random direction."""
    along = points @ rng.normal(size=3)
    where = (along - along.min()) / np.ptp(along)
    return points[rng.random(len(points)) < ratio ** -where]
