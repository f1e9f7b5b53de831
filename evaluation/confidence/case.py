# SPDX-License-Identifier: BSD-3-Clause
"""A pair of clouds with what is known of it, and its folder."""
import dataclasses
import json
import zlib

import numpy as np

import geometry


def split_of(name):
    """The part that an object belongs to."""
    return ("fit", "check")[zlib.crc32(name.encode()) % 2]


@dataclasses.dataclass
class Case:
    """\
    source, target: points in one frame, where the right pose is the identity
    objects: what they show
    foreign: no pose is right, but for one that lays all of one surface on the other
    tolerance: degrees, and the share of the source's diagonal that its centroid may be off
    slack: how near all of one surface is to the other when laid on it, as such a share
    surfaces: meshes of all that source and target show parts of, so that the equal poses
        of symmetric objects count; none where the pose alone tells
    scaling: rigid (scale 1, told to the program), metric (1, not told), any (not 1)"""
    source: np.ndarray
    target: np.ndarray
    objects: list
    foreign: bool = False
    tolerance: tuple = (4., .03)
    slack: float = .008
    surfaces: tuple = ()
    scaling: str = ""


def random_scaling(rng):
    return str(rng.choice(["rigid", "metric", "any"], p=[.35, .3, .35]))


def far_frame(case, rng):
    """The source turned, shifted, and scaled unless that is ruled out: (frame, right pose)."""
    scale = np.exp(rng.uniform(np.log(.8), np.log(1.25))) if case.scaling == "any" else 1.
    shift = rng.uniform(-1, 1, 3) * geometry.diagonal(case.target)
    frame = geometry.similarity(geometry.random_rotation(rng), shift, scale)
    return frame, np.linalg.inv(frame)


def write_pcd(path, points):
    points = np.ascontiguousarray(points, "<f4")
    header = ("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
              f"COUNT 1 1 1\nWIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
              f"POINTS {len(points)}\nDATA binary\n")
    path.write_bytes(header.encode() + points.tobytes())


def write(folder, kind, split, case, rng):
    """Writes source.pcd, target.pcd, meta.json and, with surfaces, surfaces.npz."""
    case.scaling = case.scaling or random_scaling(rng)
    frame, pose = far_frame(case, rng)
    folder.mkdir(parents=True, exist_ok=True)
    source = geometry.moved(frame, case.source)
    write_pcd(folder / "source.pcd", rng.permutation(source))
    write_pcd(folder / "target.pcd", rng.permutation(case.target))
    reach = geometry.diagonal(case.source)
    (folder / "meta.json").write_text(json.dumps({
        "kind": kind, "split": split, "objects": case.objects, "foreign": case.foreign,
        "rigid": case.scaling == "rigid", "scaling": case.scaling,
        "pose": pose.tolist(), "degrees": case.tolerance[0],
        "length": case.tolerance[1] * reach, "slack": case.slack, "centroid": source.mean(0).tolist()}))
    if case.surfaces:
        probes = geometry.sampled(case.surfaces[0], 1500, rng)[0]
        points, faces = geometry.sampled(case.surfaces[1], 15000, rng)
        normals = geometry.face_normals(case.surfaces[1])[0][faces]
        np.savez(folder / "surfaces.npz", source=geometry.moved(frame, probes).astype("f4"),
                 target=points.astype("f4"), normals=normals.astype("f4"))
