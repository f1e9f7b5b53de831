#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how far the confidence is the share that is right (needs Debian's
python3-matplotlib and python3-pil).

usage: draw.py CASES.csv PICTURE
CASES.csv has the columns kind, confidence and right (0 or 1)."""
import csv
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

import logistic

ORANGE, BLUE = (0.93, 0.55, 0.20), (0.30, 0.52, 0.80)
EDGES = np.array([0, .02, .1, .25, .5, .75, .9, .98, 1])


def interval(right, count, z=1.96):
    """Wilson's interval of a share."""
    share, width = right / count, z * z / count
    middle = (share + width / 2) / (1 + width)
    half = z * np.sqrt(share * (1 - share) / count + width / (4 * count)) / (1 + width)
    return middle - half, middle + half


def reliability(axes, confidence, right):
    bins = np.clip(np.digitize(confidence, EDGES) - 1, 0, len(EDGES) - 2)
    axes.plot([0, 1], [0, 1], color="lightgrey", linewidth=1)
    for k in np.unique(bins):
        of = bins == k
        low, high = interval(right[of].sum(), of.sum())
        at = confidence[of].mean()
        axes.plot([at, at], [low, high], color=BLUE, linewidth=1)
        axes.plot(at, right[of].mean(), "o", color=BLUE, markersize=4)
        axes.annotate(str(of.sum()), (at, right[of].mean()), (5, -9), fontsize=7,
                      textcoords="offset points")
    axes.set_xlabel("confidence")
    axes.set_ylabel("share that is right")


def draw(confidence, right, picture):
    figure, (left, middle, curve) = plt.subplots(1, 3, figsize=(10.5, 3.3), dpi=150)
    reliability(left, confidence, right)
    bins = np.linspace(0, 1, 21)
    middle.hist([confidence[right], confidence[~right]], bins, color=[BLUE, ORANGE],
                label=[f"{right.sum()} right", f"{(~right).sum()} wrong"])
    middle.set_xlabel("confidence")
    middle.set_ylabel("results")
    middle.legend(frameon=False, loc="upper center")
    thresholds = np.r_[np.inf, np.unique(confidence)[::-1]]
    curve.plot([np.mean(confidence[~right] >= t) for t in thresholds],
               [np.mean(confidence[right] >= t) for t in thresholds], color=BLUE)
    curve.plot([0, 1], [0, 1], color="lightgrey", linewidth=1)
    curve.set_xlabel("share of wrong results accepted")
    curve.set_ylabel("share of right results accepted")
    area = logistic.area_under_roc(confidence, right)
    curve.set_title(f"area under the curve {area:.3f}", fontsize=10)
    figure.tight_layout()
    figure.savefig(picture)
    Image.open(picture).quantize(64, dither=Image.Dither.NONE).save(picture)


def main(cases_path, picture):
    with open(cases_path, newline="") as file:
        rows = list(csv.DictReader(file))
    draw(np.array([float(row["confidence"]) for row in rows]),
         np.array([row["right"] == "1" for row in rows]), picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
