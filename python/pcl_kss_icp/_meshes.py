# SPDX-License-Identifier: BSD-3-Clause
"""Points that stand for a mesh."""
from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
from numpy.typing import NDArray

Doubles = NDArray[np.float64]
Indices = NDArray[np.int64]


def _numbered(corners: Doubles) -> Indices:
    """A number for each corner: points with the same coordinates are one."""
    order = np.lexsort(corners.T)
    rows = corners[order]
    is_new = np.any(rows[1:] != rows[:-1], axis=1)
    numbers = np.empty(len(corners), dtype=np.int64)
    numbers[order] = np.concatenate([[0], np.cumsum(is_new)])
    return numbers


def _is_closed(faces: Indices) -> bool:
    """Whether two faces share each edge, and run along it opposite ways: the mesh has an
    inside, and its faces agree about it."""
    begin, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    edges = np.minimum(begin, end) * (faces.max() + 1) + np.maximum(begin, end)
    order = np.argsort(edges)
    edges, ways = edges[order], (begin < end)[order]
    if len(edges) % 2 or np.any(edges[::2] != edges[1::2]):
        return False
    are_pairs = np.all(edges[2::2] != edges[1:-1:2])
    return bool(are_pairs and np.all(ways[::2] != ways[1::2]))


def sampled(corners: Doubles, faces: Indices,
            number: int) -> Tuple[Doubles, Optional[Doubles]]:
    """Points spread evenly over the faces, the same ones at every call, and the normals of
    their faces, which point out of what is closed.

    corners: N x 3; faces: M x 3, rows of corners. Where the faces have no area, the corners
    stand for the mesh, without normals.
    """
    if corners.ndim != 2 or corners.shape[1] != 3 or faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError("A mesh is N x 3 vertices and M x 3 faces, not arrays of shapes "
                         f"{corners.shape} and {faces.shape}.")
    if faces.min() < 0 or faces.max() >= len(corners):
        raise ValueError(f"A mesh of {len(corners)} vertices has faces that name others.")
    a, b, c = (corners[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    areas = 0.5 * np.linalg.norm(across, axis=1)
    areas[~np.isfinite(areas)] = 0.0
    if not areas.sum() > 0.0:
        return corners, None
    random = np.random.default_rng(0)
    drawn = random.choice(len(faces), size=number, p=areas / areas.sum())
    u = np.sqrt(random.random((number, 1)))  # makes it even over a triangle
    v = random.random((number, 1))
    points = (1.0 - u) * a[drawn] + u * (1.0 - v) * b[drawn] + u * v * c[drawn]
    normals = across[drawn] / np.linalg.norm(across[drawn], axis=1, keepdims=True)
    if _is_closed(_numbered(corners)[faces]):
        middle = points.mean(axis=0)
        volume = np.einsum("ij,ij->", a - middle, np.cross(b - middle, c - middle))
        if volume < 0.0:
            normals = -normals
    return points, normals
