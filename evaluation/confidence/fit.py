#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits the confidence on one part of the cases, checks it on the other.

usage: fit.py TABLE.csv... [--explore] [--csv FILE] [--picture FILE]
Tables come from run_cases.py. --explore: how well each feature tells right from wrong.
--csv, --picture: the checking part's poses with their confidence, and its diagram."""
import argparse
import csv

import numpy as np
from scipy.special import expit

import draw
import features
import logistic
import table

ROUNDS = 5   # of choosing the best pose of each case and fitting the chosen
ALIKE = .7   # poses whose log odds differ by less are equally good


def log_odds(columns, names, model):
    return model[0] + features.matrix(columns, names) @ model[1]


def best_poses(columns, rank):
    """The best pose of each case, its margin, and whether it is right or one that is
    equally good."""
    first, margin, right = table.best_of_each(columns, rank, ALIKE)
    best = table.chosen(columns, first)
    best.update({"margin": margin, "right itself": best["right"] > 0, "right": right})
    return best


def fit(columns, names=None):
    """The models of a pose's log odds, which rank the poses of a case, and of those of the
    best one to be right; and each case's best pose. All from the fit part; with the names
    as features of both models, unless they are left out."""
    ranking, used = names or features.RANKING, names or features.USED
    rank = -columns["rank"]
    for _ in range(ROUNDS):
        best = best_poses(columns, rank)
        pose = fitted(best, features.matrix(best, ranking), features.signs(ranking))
        rank = log_odds(columns, ranking, pose)
    best = best_poses(columns, rank)
    values = features.with_margin(features.matrix(best, used), best["margin"])
    model = fitted(best, values, features.signs(used) + [1])
    best["final"] = model[0] + values @ model[1]
    best["confidence"] = expit(best["final"])
    return pose, model, best


def fitted(best, values, signs):
    part = best["split"] == "fit"
    right = best["right"][part]
    return logistic.fitted(values[part], right, table.equal_says(best["kind"][part], right),
                           signs)


def percent(which):
    return f"{100 * which.mean():5.1f} %" if len(which) else "    -"


def figures(best):
    """The figures of one part in a line."""
    confidence = best["confidence"]
    right, alone = best["right"], best["margin"] >= ALIKE
    sure = confidence >= .99
    return (f"area {logistic.area_under_roc(confidence, right):.4f}  wrong refused "
            f"{percent(confidence[~right] < .5)}  right refused "
            f"{percent(confidence[right] < .5)}  sure {sure.sum()}, right "
            f"{percent(right[sure])}; and not ambiguous {(sure & alone).sum()}, right "
            f"{percent(best['right itself'][sure & alone])}; wrong and not ambiguous "
            f"{((confidence >= .5) & alone & ~right).sum()}")


def of_part(best, split):
    return table.chosen(best, best["split"] == split)


def likelihood(part, confidence):
    """The mean logarithm of the probability that was given to what is so."""
    given = np.where(part["right"], confidence, 1 - confidence)
    return np.average(np.log(np.maximum(given, 1e-3)),
                      weights=table.equal_says(part["kind"], part["right"]))


def explore(columns):
    print("area under the ROC curve of the first pose by one feature, fit and check part:")
    first = best_poses(columns, -columns["rank"])
    for name, (sign, value) in features.FEATURES.items():
        areas = [logistic.area_under_roc(sign * value(part), part["right"])
                 for part in (of_part(first, "fit"), of_part(first, "check"))]
        print(f"  {name:20} {areas[0]:.4f} {areas[1]:.4f}")
    print("greedily, the next feature that improves the likelihood of the fit part most:")
    names = []
    while len(names) < 7:
        tried = {}
        for name in set(features.FEATURES) - set(names):
            part = of_part(fit(columns, names + [name])[2], "fit")
            tried[name] = likelihood(part, part["confidence"])
        names.append(max(tried, key=tried.get))
        part = of_part(fit(columns, names)[2], "check")
        print(f"  {names[-1]:20} {tried[names[-1]]:.4f} "
              f"{likelihood(part, part['confidence']):.4f}  " + figures(part))


def calibration(best):
    """Whether the likelihood gains from calibration on top."""
    fitting, checking = of_part(best, "fit"), of_part(best, "check")
    curve = logistic.never_falling(fitting["final"], fitting["right"], table.equal_says(
        fitting["kind"], fitting["right"]))
    print("log likelihood of the check part, and with an isotonic calibration on top:",
          *(f"{likelihood(checking, confidence):.4f}" for confidence in (
              checking["confidence"], curve(checking["final"]))))


def by_kind(best):
    print("kind: cases, right, wrong accepted, wrong accepted and not ambiguous, right refused")
    for kind in np.unique(best["kind"]):
        part = table.chosen(best, best["kind"] == kind)
        right, accepted = part["right"], part["confidence"] >= .5
        print(f"  {kind:20} {len(right):4} {right.sum():4} {(accepted & ~right).sum():4}"
              f" {(accepted & ~right & (part['margin'] >= ALIKE)).sum():4}"
              f" {(~accepted & right).sum():4}")


def reliability(part):
    print("confidence: cases, mean confidence, share right")
    for low, high in zip(draw.EDGES[:-1], draw.EDGES[1:]):
        of = (part["confidence"] >= low) & (part["confidence"] < high)
        if of.any():
            print(f"  {low:.2f} to {high:.2f} {of.sum():5} {part['confidence'][of].mean():.3f}"
                  f" {part['right'][of].mean():.3f}")


def print_constants(pose, model):
    print(f"log odds of a pose: {pose[0]:.3f}",
          *(f"{slope:+.3f} [{name}]" for name, slope in zip(features.RANKING, pose[1])))
    print(f"log odds of the best: {model[0]:.3f}",
          *(f"{slope:+.3f} [{name}]" for name, slope in zip(
              features.USED + [f"log(1 + min(margin, {features.FARTHEST}))"], model[1])))


def write_csv(part, path):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["kind", "confidence", "right"])
        writer.writerows(sorted(
            (kind, f"{value:.4f}", int(right)) for kind, value, right in
            zip(part["kind"], part["confidence"], part["right"])))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tables", nargs="+")
    parser.add_argument("--explore", action="store_true")
    parser.add_argument("--csv")
    parser.add_argument("--picture")
    options = parser.parse_args()
    columns, without = table.read(*options.tables)
    if options.explore:
        explore(columns)
    pose, model, best = fit(columns)
    print(len(best["case"]), "cases,", int(best["right"].sum()), "right;", without,
          "without any pose")
    for split in ("fit", "check"):
        print(split, figures(of_part(best, split)))
    part = of_part(best, "check")
    by_kind(part)
    reliability(part)
    calibration(best)
    print_constants(pose, model)
    if options.csv:
        write_csv(part, options.csv)
    if options.picture:
        draw.draw(part["confidence"], part["right"], options.picture)


if __name__ == "__main__":
    main()
