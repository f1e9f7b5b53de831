#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws how well the score tells right results from wrong ones (needs Debian's
python3-matplotlib and python3-pil).

usage: plot_confidence.py CASES.csv PICTURE
CASES.csv has the columns kind, score and right (0 or 1)."""
import csv
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

ORANGE, BLUE = (0.93, 0.55, 0.20), (0.30, 0.52, 0.80)


def main(cases_path, picture):
    with open(cases_path, newline="") as file:
        rows = list(csv.DictReader(file))
    score = np.array([float(row["score"]) for row in rows])
    right = np.array([row["right"] == "1" for row in rows])

    # from the most demanding threshold to none
    thresholds = np.concatenate([[np.inf], np.sort(np.unique(score))[::-1]])
    accepted_right = [np.mean(score[right] >= t) for t in thresholds]
    accepted_wrong = [np.mean(score[~right] >= t) for t in thresholds]
    area = np.trapz(accepted_right, accepted_wrong)

    figure, (histogram, curve) = plt.subplots(1, 2, figsize=(9, 3.3), dpi=150)
    bins = np.arange(0, 1.81, 0.05)
    histogram.hist(score[right], bins, color=BLUE, label=f"{right.sum()} right")
    histogram.hist(score[~right], bins, color=ORANGE, label=f"{(~right).sum()} wrong")
    histogram.axvline(0.55, color="black", linewidth=1, label="confidence 0.5")
    histogram.set_xlabel("score of the overlap")
    histogram.set_ylabel("results")
    histogram.legend(frameon=False, loc="upper left")
    curve.plot(accepted_wrong, accepted_right, color=BLUE, marker=".")
    curve.plot([0, 1], [0, 1], color="lightgrey", linewidth=1)
    curve.set_xlabel("share of wrong results accepted")
    curve.set_ylabel("share of right results accepted")
    curve.set_title(f"area under the curve {area:.4f}", fontsize=10)
    figure.tight_layout()
    figure.savefig(picture)
    Image.open(picture).quantize(64, dither=Image.Dither.NONE).save(picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
