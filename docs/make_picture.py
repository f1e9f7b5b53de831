#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws two scans and what their registration makes of them (needs Debian's
python3-matplotlib and python3-pil).

usage: make_picture.py SOURCE TARGET TRANSFORM PICTURE
SOURCE and TARGET are binary PLY files of points with normals, as the demo's; TRANSFORM
holds 4x4 numbers.
x points to the right, y up, and z towards the viewer."""
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

ORANGE, BLUE = np.array([0.93, 0.55, 0.20]), np.array([0.30, 0.52, 0.80])


def read_scan(path):
    """Points and normals, n x 3 each."""
    with open(path, "rb") as file:
        header, rows = file.read().split(b"end_header\n", 1)
    names = [line.split()[2] for line in header.decode().splitlines()
             if line.startswith("property double")]
    values = np.frombuffer(rows, "<f8").reshape(-1, len(names))
    return [values[:, [names.index(name) for name in axes]]
            for axes in (("x", "y", "z"), ("nx", "ny", "nz"))]


def draw(axes, left, title, *scans):
    """Dot shaded points, the nearest to the viewer last; where they end at the right."""
    points = np.concatenate([scan for scan, _, _ in scans])
    normals = np.concatenate([normals for _, normals, _ in scans])
    colours = np.concatenate([np.tile(colour, (len(scan), 1)) for scan, _, colour in scans])
    low, high = points.min(axis=0), points.max(axis=0)
    points = points + [left - low[0], -(low[1] + high[1]) / 2, 0]
    light = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([0.4, 0.6, 0.7])
    shade = 0.35 + 0.65 * np.abs(normals @ light)
    order = np.argsort(points[:, 2])
    axes.scatter(points[order, 0], points[order, 1], s=2.5, linewidths=0,
                 c=np.clip(colours[order] * shade[order, None], 0, 1))
    right = left + high[0] - low[0]
    axes.annotate(title, ((left + right) / 2, 0), xycoords=("data", "axes fraction"),
                  ha="center", va="bottom", fontsize=12)
    return right


def main(source_path, target_path, transform_path, picture):
    source, source_normals = read_scan(source_path)
    target, target_normals = read_scan(target_path)
    transform = np.loadtxt(transform_path)
    linear = transform[:3, :3]
    aligned = source @ linear.T + transform[:3, 3]
    aligned_normals = source_normals @ linear.T / np.cbrt(np.linalg.det(linear))

    figure = plt.figure(figsize=(10, 3.2), dpi=150)
    axes = figure.add_axes([0, 0, 1, 1])
    gap = 0.15 * np.ptp(target[:, 0])
    right = draw(axes, 0, "source", (source, source_normals, ORANGE))
    right = draw(axes, right + gap, "target", (target, target_normals, BLUE))
    right = draw(axes, right + gap, "source placed upon target",
                 (aligned, aligned_normals, ORANGE), (target, target_normals, BLUE))
    height = max(np.ptp(points[:, 1]) for points in (source, target, aligned))
    axes.set_xlim(-gap / 2, right + gap / 2)
    axes.set_ylim(-0.65 * height, 0.52 * height)
    axes.set_aspect("equal")
    axes.axis("off")
    figure.savefig(picture, bbox_inches="tight", pad_inches=0.05)
    Image.open(picture).quantize(200, dither=Image.Dither.NONE).save(picture)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    main(*sys.argv[1:])
