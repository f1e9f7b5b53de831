# SPDX-License-Identifier: BSD-3-Clause
"""Whether a pose is right."""
import numpy as np
from scipy.spatial import cKDTree

import geometry

SCALE = .05   # relative error that is still right


def errors(meta, pose):
    """Degrees, shift of the source's centroid, relative error of scale."""
    right = np.array(meta["pose"])
    scale, true_scale = (np.cbrt(np.linalg.det(m[:3, :3])) for m in (pose, right))
    cosine = (np.trace(pose[:3, :3] @ right[:3, :3].T) / (scale * true_scale) - 1) / 2
    centroid = np.array(meta["centroid"])
    shift = np.linalg.norm(geometry.moved(pose - right, centroid))
    return (np.degrees(np.arccos(np.clip(cosine, -1, 1))), shift,
            abs(scale / true_scale - 1))


def distances(probes, points, normals):
    """How far the probes are from the surface through points with normals."""
    apart, nearest = cKDTree(points).query(probes)
    plane = np.abs(((probes - points[nearest]) * normals[nearest]).sum(1))
    return np.where(apart < .03 * geometry.diagonal(points), plane, apart)


def coincide(surfaces, pose, slack):
    """Whether all of the source's surface lies on the target's, and the reverse."""
    placed = geometry.moved(pose, surfaces["source"].astype(float))
    points, normals = surfaces["target"].astype(float), surfaces["normals"].astype(float)
    limit = slack * geometry.diagonal(points)
    if np.quantile(distances(placed, points, normals), .97) > limit:
        return False
    back = cKDTree(placed).query(points[::10])[0]
    return np.quantile(back, .97) < limit + .04 * geometry.diagonal(points)


def verdict(meta, surfaces, pose):
    """Columns of the table: right, by the pose alone, and the errors."""
    degrees, shift, scale = errors(meta, pose)
    by_pose = not meta["foreign"] and degrees < meta["degrees"] and \
        shift < meta["length"] and scale < SCALE
    right = by_pose or (surfaces is not None and coincide(surfaces, pose, meta["slack"]))
    return {"right": int(right), "right_pose": int(by_pose), "degrees": round(degrees, 3),
            "shift": round(shift / meta["length"], 4), "scale_error": round(scale, 5)}
