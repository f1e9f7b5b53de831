# SPDX-License-Identifier: BSD-3-Clause
"""The table of run_cases.py, by columns."""
import csv

import numpy as np

SMALL_OBJECT = .6   # what is smaller than so much of the other cloud may be one
BLURRED = 1 / 3      # how near counts as near, by the object: beyond, a scene is blurred

TEXT = ("case", "kind", "split", "objects", "scaling")


def read(*paths):
    """Columns of the poses found, and how many cases had none."""
    rows = []
    for path in paths:
        with open(path, newline="") as file:
            rows += csv.DictReader(file)
    found = [row for row in rows if row["rank"] != "-1"]
    columns = {name: np.array([row[name] for row in found]) if name in TEXT else
               np.array([float(row[name] or "nan") for row in found])
               for name in rows[0]}
    return with_scenes(columns), len(rows) - len(found)


def with_scenes(columns):
    """Of an object in a scene only what its own points say counts, twice, as witnessesOf()
    in src/surfaces/confidence.cpp has it. Tables made before poses had a size show none."""
    size = columns.get("size", np.ones(len(columns["rank"])))
    size = np.where(size > 0, size, 1)
    seen = (np.minimum(size, 1 / size) < SMALL_OBJECT) & (columns["reach"] <= BLURRED)
    for object_, scene, own, small in (("source", "target", "overlap_0", size < 1),
                                       ("target", "source", "overlap_1", size > 1)):
        rows = seen & small
        both = np.maximum(columns["overlap_0"] + columns["overlap_1"], 1e-9)
        columns["score"] = np.where(rows, columns["score"] * 2 * columns[own] / both,
                                    columns["score"])
        for name in ("near", "explained", "worst", "consistent", "points"):
            columns[f"{scene}_{name}"] = np.where(rows, columns[f"{object_}_{name}"],
                                                  columns[f"{scene}_{name}"])
    return columns


def chosen(columns, rows):
    return {name: column[rows] for name, column in columns.items()}


def best_of_each(columns, score, alike):
    """Of each case the row of the best pose, how much better it is than the next, and
    whether it is right or any pose that is worse by less than alike."""
    order = np.lexsort((-score, columns["case"]))
    cases = columns["case"][order]
    starts = np.nonzero(np.r_[True, cases[1:] != cases[:-1]])[0]
    sizes = np.diff(np.r_[starts, len(order)])
    first = order[starts]
    following = order[np.minimum(starts + 1, len(order) - 1)]
    margin = np.where(sizes > 1, score[first] - score[following], np.inf)
    near = np.repeat(score[first], sizes) - score[order] < alike
    right = np.logical_or.reduceat(near & (columns["right"][order] > 0), starts)
    return first, margin, right


def equal_says(kinds, right):
    """Weights: each kind has the same say, and right and wrong ones together have."""
    base = np.char.replace(kinds.astype(str), "other_", "")
    names, index, counts = np.unique(base, return_inverse=True, return_counts=True)
    weights = (len(kinds) / (len(names) * counts))[index]
    for _ in range(20):
        for of in (right, ~right):
            weights[of] *= len(kinds) / 2 / weights[of].sum()
        sums = np.bincount(index, weights)
        weights *= (len(kinds) / len(names) / sums)[index]
    return weights
