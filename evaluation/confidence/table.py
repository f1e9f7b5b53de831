# SPDX-License-Identifier: BSD-3-Clause
"""The table of run_cases.py, by columns."""
import csv

import numpy as np

TEXT = ("case", "kind", "split", "objects", "scaling")


def read(path):
    """Columns of the poses found, and how many cases had none."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    found = [row for row in rows if row["rank"] != "-1"]
    columns = {name: np.array([row[name] for row in found]) if name in TEXT else
               np.array([float(row[name] or "nan") for row in found])
               for name in rows[0]}
    return columns, len(rows) - len(found)


def chosen(columns, rows):
    return {name: column[rows] for name, column in columns.items()}


def best_of_each(columns, score):
    """Rows of each case's best pose, and of its next best or -1."""
    order = np.lexsort((-score, columns["case"]))
    starts = np.nonzero(np.r_[True, columns["case"][order][1:] != columns["case"][order][:-1]])
    starts = starts[0]
    sizes = np.diff(np.r_[starts, len(order)])
    seconds = np.where(sizes > 1, order[np.minimum(starts + 1, len(order) - 1)], -1)
    return order[starts], seconds


def equal_kinds(kinds):
    """Weights that give each kind the same say."""
    names, index, counts = np.unique(kinds, return_inverse=True, return_counts=True)
    return (len(kinds) / (len(names) * counts))[index]
