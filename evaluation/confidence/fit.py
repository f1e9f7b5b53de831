#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits the confidence on one part of the cases, checks it on the other.

usage: fit.py TABLE.csv [--explore] [--csv FILE] [--picture FILE]
TABLE.csv comes from run_cases.py. --explore: how well each feature tells right from wrong.
--csv, --picture: the checking part's poses with their confidence, and its diagram."""
import argparse
import csv

import numpy as np
from scipy.special import expit

import draw
import features
import logistic
import table

ROUNDS = 4   # of choosing the best pose of each case and fitting the chosen


def log_odds(columns, names, model):
    return model[0] + features.matrix(columns, names) @ model[1]


def best_poses(columns, odds):
    """The best pose of each case, with its log odds and the margin to the next."""
    first, second = table.best_of_each(columns, odds)
    best = table.chosen(columns, first)
    best["log odds"] = odds[first]
    best["margin"] = np.where(second < 0, 20., np.minimum(odds[first] - odds[second], 20))
    return best


def fit(columns, names):
    """The model of the fit part, and each case's best pose by it."""
    odds = -columns["rank"]
    for _ in range(ROUNDS):
        best = best_poses(columns, odds)
        part = table.chosen(best, best["split"] == "fit")
        model = logistic.fitted(features.matrix(part, names), part["right"] > 0,
                                table.equal_kinds(part["kind"]), features.signs(names))
        odds = log_odds(columns, names, model)
    return model, best_poses(columns, odds)


def figures(best, confidence):
    """The figures of one part in a line."""
    right = best["right"] > 0
    sure = confidence >= .99
    plain = sure & (best["margin"] > AMBIGUOUS)
    share = lambda which: f"{100 * which.mean():5.1f} %" if len(which) else "    -"
    return (f"area {logistic.area_under_roc(confidence, right):.4f}  wrong refused "
            f"{share(confidence[~right] < .5)}  right refused {share(confidence[right] < .5)}"
            f"  sure: {sure.sum()}, right {share(right[sure])}, not ambiguous: {plain.sum()},"
            f" right {share(right[plain])}")


AMBIGUOUS = .7   # poses whose log odds differ by less are equally good


def explore(columns):
    print("area under the ROC curve of the first pose by one feature, fit and check part:")
    parts = [best_poses(columns, -columns["rank"])]
    parts = [table.chosen(parts[0], parts[0]["split"] == split) for split in ("fit", "check")]
    for name, (sign, value) in features.FEATURES.items():
        areas = [logistic.area_under_roc(sign * value(part), part["right"] > 0)
                 for part in parts]
        print(f"  {name:20} {areas[0]:.4f} {areas[1]:.4f}")
    print("greedily, the next feature that improves the likelihood of the fit part most:")
    names = []
    while len(names) < 8:
        tried = {name: likelihood(fit(columns, names + [name])[1], "fit")
                 for name in features.FEATURES if name not in names}
        names.append(max(tried, key=tried.get))
        _, best = fit(columns, names)
        part = table.chosen(best, best["split"] == "check")
        print(f"  {names[-1]:20} {tried[names[-1]]:.4f} {likelihood(best, 'check'):.4f}  "
              + figures(part, expit(part["log odds"])))


def likelihood(best, split):
    part = table.chosen(best, best["split"] == split)
    right = part["right"] > 0
    weights = table.equal_kinds(part["kind"])
    return np.average(-np.logaddexp(0, np.where(right, -1, 1) * part["log odds"]),
                      weights=weights)


def by_kind(best, confidence):
    print("kind: cases, right, wrong accepted, right refused")
    for kind in np.unique(best["kind"]):
        of = best["kind"] == kind
        right, accepted = best["right"][of] > 0, confidence[of] >= .5
        print(f"  {kind:20} {of.sum():4} {right.sum():4} {(accepted & ~right).sum():4}"
              f" {(~accepted & right).sum():4}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table")
    parser.add_argument("--explore", action="store_true")
    parser.add_argument("--csv")
    parser.add_argument("--picture")
    options = parser.parse_args()
    columns, without = table.read(options.table)
    if options.explore:
        explore(columns)
    model, best = fit(columns, features.USED)
    print(len(best["case"]), "cases,", int(best["right"].sum()), "right;", without,
          "without any pose")
    for split in ("fit", "check"):
        part = table.chosen(best, best["split"] == split)
        print(split, figures(part, expit(part["log odds"])))
    by_kind(part, expit(part["log odds"]))
    print(f"constant {model[0]:.3f}")
    for name, slope in zip(features.USED, model[1]):
        print(f"{name:20} {slope:.3f}")
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["kind", "confidence", "right"])
            writer.writerows(sorted(
                (kind, f"{value:.4f}", int(right)) for kind, value, right in
                zip(part["kind"], expit(part["log odds"]), part["right"])))
    if options.picture:
        draw.draw(expit(part["log odds"]), part["right"] > 0, options.picture)


if __name__ == "__main__":
    main()
