# SPDX-License-Identifier: BSD-3-Clause
"""What the confidence is a function of: features of a pose's evidence, the sign that each
coefficient must have, and the features that the library uses: to choose among the poses
of a pair, and to tell whether the best one is right, where it does not count against it
that scans share no more than a part."""
import numpy as np


def least(c, name):
    return np.minimum(c["source_" + name], c["target_" + name])


def most(c, name):
    return np.maximum(c["source_" + name], c["target_" + name])


def sum_of_logs(c, name, small):
    return np.log((c["source_" + name] + small) * (c["target_" + name] + small)) / 2


FEATURES = {   # name: (sign, function of the columns)
    "best worst": (1, lambda c: np.log(most(c, "worst") + .005)),
    "least worst": (1, lambda c: np.log(least(c, "worst") + .01)),
    "mean worst": (1, lambda c: sum_of_logs(c, "worst", .003)),
    "consistent": (1, lambda c: np.log(least(c, "consistent") + .02)),
    "best consistent": (1, lambda c: np.log(most(c, "consistent") + .02)),
    "mean consistent": (1, lambda c: sum_of_logs(c, "consistent", .02)),
    "least explained": (1, lambda c: np.log(least(c, "explained") + .01)),
    "best explained": (1, lambda c: np.log(most(c, "explained") + .01)),
    "mean explained": (1, lambda c: sum_of_logs(c, "explained", .01)),
    "least near": (1, lambda c: np.log(least(c, "near") + .01)),
    "explained of near": (1, lambda c: np.log(
        np.minimum(c["source_explained"] / (c["source_near"] + .01),
                   c["target_explained"] / (c["target_near"] + .01)) + .02)),
    "residual": (-1, lambda c: np.minimum(c["residual"], 3)),
    "noise": (-1, lambda c: np.minimum(c["noise"], 2)),
    "reach": (-1, lambda c: np.log(c["reach"] + 1e-3)),
    "points": (1, lambda c: np.log(least(c, "points") + 10)),
    "free scale": (-1, lambda c: (c["scaling"] != "rigid").astype(float)),
    "score": (1, lambda c: c["score"]),
}
RANKING = ["best worst", "mean consistent", "residual", "score"]
USED = ["best consistent", "mean consistent", "residual", "score"]
FARTHEST = 8   # a margin beyond counts as this


def matrix(columns, names):
    return np.column_stack([FEATURES[name][1](columns) for name in names])


def signs(names):
    return [FEATURES[name][0] for name in names]


def with_margin(values, margin):
    """What the confidence of a case's best pose is a function of."""
    return np.column_stack([values, np.log1p(np.minimum(margin, FARTHEST))])
