#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws two meshes and what their registration makes of them (needs matplotlib).

usage: make_picture.py SOURCE TARGET TRANSFORM PICTURE
SOURCE and TARGET are triangle meshes, .obj or .off; TRANSFORM holds 4x4 numbers.
x points to the right, y up, and z towards the viewer."""
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
import numpy as np
from PIL import Image

ORANGE, BLUE = np.array([0.93, 0.55, 0.20]), np.array([0.30, 0.52, 0.80])


def read_mesh(path):
    """The triangles of a mesh, n x 3 corners x 3 coordinates."""
    with open(path) as file:
        rows = [line.split() for line in file if line.strip()]
    if path.endswith(".obj"):
        points = [row[1:4] for row in rows if row[0] == "v"]
        faces = [[int(corner.split("/")[0]) - 1 for corner in row[1:4]]
                 for row in rows if row[0] == "f"]
    else:
        count = int(rows[1][0])
        points = [row[:3] for row in rows[2:2 + count]]
        faces = [[int(corner) for corner in row[1:4]] for row in rows[2 + count:]]
    return np.array(points, dtype=float)[np.array(faces)]


def draw(axes, left, title, *meshes):
    """Paint shaded triangles, the nearest to the viewer last; where they end at the
    right."""
    corners = np.concatenate([triangles for triangles, _ in meshes])
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    corners = corners + [left - low[0], -(low[1] + high[1]) / 2, 0]
    colours = np.concatenate([np.tile(colour, (len(triangles), 1))
                              for triangles, colour in meshes])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    light = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([0.4, 0.6, 0.7])
    shade = 0.35 + 0.65 * np.clip(normals @ light, 0, 1)
    seen = np.flatnonzero(normals[:, 2] > 0)
    order = seen[np.argsort(corners[seen, :, 2].mean(axis=1))]
    colours = np.clip(colours[order] * shade[order, None], 0, 1)
    axes.add_collection(PolyCollection(corners[order, :, :2], facecolors=colours,
                                       edgecolors=colours, linewidths=0.2))
    right = left + high[0] - low[0]
    axes.annotate(title, ((left + right) / 2, 0), xycoords=("data", "axes fraction"),
                  ha="center", va="bottom", fontsize=12)
    return right


def main(source_path, target_path, transform_path, picture):
    source, target = read_mesh(source_path), read_mesh(target_path)
    transform = np.loadtxt(transform_path)
    aligned = source @ transform[:3, :3].T + transform[:3, 3]

    figure = plt.figure(figsize=(10, 4.2), dpi=150)
    axes = figure.add_axes([0, 0, 1, 1])
    gap = 0.2 * np.ptp(target[..., 0])
    right = draw(axes, 0, "source", (source, ORANGE))
    right = draw(axes, right + gap, "target", (target, BLUE))
    right = draw(axes, right + gap, "source placed upon target", (aligned, ORANGE),
                 (target, BLUE))
    heights = [np.ptp(mesh[..., 1]) for mesh in (source, target)]
    axes.set_xlim(-gap / 2, right + gap / 2)
    axes.set_ylim(-0.6 * max(heights), 0.52 * max(heights))
    axes.set_aspect("equal")
    axes.axis("off")
    figure.savefig(picture, bbox_inches="tight", pad_inches=0.05)
    Image.open(picture).quantize(200, dither=Image.Dither.NONE).save(picture)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
