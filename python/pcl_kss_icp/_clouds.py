# SPDX-License-Identifier: BSD-3-Clause
"""Clouds in whatever form they come: arrays, lists, objects of Open3D and of trimesh, which
are known by what they have, so that neither needs to be installed."""
from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from ._meshes import sampled

Points = NDArray[np.float64]
Normals = NDArray[np.float32]

NO_NORMALS: Normals = np.empty((0, 3), dtype=np.float32)
NO_NORMALS.setflags(write=False)

# as in arrays of their own; but float() takes them
_NO_NUMBERS = (str, bytes, bool, np.bool_)


def numbers_of(value: Any, name: str) -> Points:
    """Numbers as an array of doubles; what is masked is NaN."""
    try:
        if hasattr(value, "cpu"):  # of Open3D's or PyTorch's tensors
            value = value.cpu().numpy()
        is_masked = isinstance(value, np.ma.MaskedArray)
        array: Any = value if is_masked else np.asarray(value)
        if array.ndim == 0 or array.dtype.kind not in "fiuO":
            raise TypeError(f"this is {array.dtype}")
        kinds = set(map(type, array.flat)) if array.dtype.kind == "O" else set()
        for kind in kinds:
            if issubclass(kind, _NO_NUMBERS):
                raise TypeError(f"this has elements of type {kind.__name__}")
        doubles = array.astype(np.float64, copy=False)
        points: Points = doubles.filled(np.nan) if is_masked else doubles
        return points
    except (TypeError, ValueError, RuntimeError) as error:
        raise ValueError(f"{name}: an array of real numbers is needed; {error}.") from None


def _rows_of(value: Any, name: str, columns: Tuple[int, ...]) -> Points:
    rows = numbers_of(value, name)
    if rows.ndim == 1 and rows.size == 0:
        rows = rows.reshape(0, 3)
    if rows.ndim != 2 or rows.shape[1] not in columns:
        wanted = "N x 3 numbers are needed"
        if 6 in columns:
            wanted += ", or N x 6 with normals"
        raise ValueError(f"{name}: {wanted}, not an array of shape {rows.shape}.")
    return rows


def _tensors_of(cloud: Any, kind: str, name: str = "positions") -> Any:
    """A map of Open3D's tensors; None: there is none with that name."""
    tensors = getattr(cloud, kind, None)
    has_any = tensors is not None and hasattr(tensors, "__contains__") and name in tensors
    return tensors if has_any else None


def _corners_and_faces(cloud: Any) -> Optional[Tuple[Any, Any]]:
    """Of a mesh; None: it is none, or has no faces."""
    corners, faces = getattr(cloud, "vertices", None), None
    for name in "faces", "triangles":  # trimesh.Trimesh, open3d.geometry.TriangleMesh
        faces = getattr(cloud, name, None) if faces is None else faces
    tensors = _tensors_of(cloud, "vertex")
    if tensors is not None:  # open3d.t.geometry.TriangleMesh
        corners = tensors["positions"]
        triangles = _tensors_of(cloud, "triangle", "indices")
        faces = triangles["indices"] if triangles is not None else None
    return (corners, faces) if faces is not None and len(faces) > 0 else None


def _points_and_normals(cloud: Any, name: str, samples: int) -> Tuple[Any, Any]:
    """What an object holds; normals are None where it has none."""
    if hasattr(cloud, "geometry"):  # trimesh.Scene
        if hasattr(cloud, "to_geometry"):
            cloud = cloud.to_geometry()
        elif hasattr(cloud, "dump"):  # of old versions
            cloud = cloud.dump(concatenate=True)
    mesh = _corners_and_faces(cloud)
    if mesh is not None:
        return sampled(numbers_of(mesh[0], name),
                       numbers_of(mesh[1], name).astype(np.int64), samples)
    tensors = _tensors_of(cloud, "point")
    if tensors is not None:  # open3d.t.geometry.PointCloud
        return tensors["positions"], tensors["normals"] if "normals" in tensors else None
    if hasattr(cloud, "points") and hasattr(cloud, "normals"):  # open3d.geometry.PointCloud
        return cloud.points, cloud.normals if len(cloud.normals) > 0 else None
    if hasattr(cloud, "vertices"):  # trimesh.PointCloud
        return cloud.vertices, None
    return cloud, None


def cloud_of(cloud: Any, normals: Any, name: str, samples: int) -> Tuple[Points, Normals]:
    """Points, and a normal for each or none at all, without gaps."""
    points, own_normals = _points_and_normals(cloud, name, samples)
    if normals is None:
        normals = own_normals
    rows = _rows_of(points, name, (3, 6))
    if normals is None and rows.shape[1] == 6:
        normals = rows[:, 3:]
    held = np.ascontiguousarray(rows[:, :3])
    if normals is None:
        return held, NO_NORMALS
    normal_rows = _rows_of(normals, f"{name}_normals", (3,))
    if len(normal_rows) != len(held):
        raise ValueError(f"{name}_normals: {len(held)} points need as many normals, "
                         f"not {len(normal_rows)}.")
    with np.errstate(over="ignore"):
        return held, np.ascontiguousarray(normal_rows, dtype=np.float32)
