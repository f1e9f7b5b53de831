#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fits what src/multiview goes by where it tells right pairs from wrong ones.

    evaluation/fit_many_scans.py DIR...

DIR holds sets of scans that evaluation/many_scans.py has made and had connected; virtual
ones, since others are for checks. Prints what was measured and the constants that follow,
beside those that the code has. Each set counts as much as any other.

An alignment of two scans is right or wrong; what the code says of it is, as a logarithm of
odds, the pair's own plus what ways by third scans say that agree with it, less the best
alternative: see consensus.h. The constants are those by which the odds of the best
alignment of each pair are likeliest, given which of them are right. Each set counts twice:
as it is, and with a fifth of its accepted pairs replaced by random poses of confidence 1,
since a sure pair may be wrong where there are things that these sets have none of.
"""
import argparse
import collections
import itertools
import json
import math
import pathlib
import re
import sys

import numpy as np

sys.dont_write_bytecode = True

import multiview

SOURCES = pathlib.Path(__file__).resolve().parents[1] / "src/multiview"


def constant(name: str) -> float:
    """What the code has."""
    for file in SOURCES.iterdir():
        found = re.search(rf"\b{name} = ([0-9.]+)[,;]", file.read_text())
        if found:
            return float(found[1])
    sys.exit(f"{SOURCES} has no {name}")


LEAST_PROBABLE, AGREEING = constant("least_probable"), constant("agreeing_share")
WAYS = int(constant("most_of_detours"))


# --- what pairs say --------------------------------------------------------------------

class Candidate:
    """A pose of a pair, of the scan b in the frame of the scan a."""

    def __init__(self, a, b, pose, alone, scans):
        self.a, self.b, self.pose, self.alone = a, b, pose, alone
        self.right = is_right(scans, a, b, pose)


def is_right(scans, a, b, pose) -> bool:
    if scans[a].thing != scans[b].thing:
        return False
    true = np.linalg.inv(scans[a].true) @ scans[b].true
    return scans[b].tolerates(scans[b].errors(pose, true))


def displacement(scan, one: np.ndarray, other: np.ndarray) -> float:
    """How far apart two poses place a scan, root mean square over its points."""
    apart = np.linalg.norm(multiview.moved(one, scan.landmarks())
                           - multiview.moved(other, scan.landmarks()), axis=1)
    return math.sqrt(np.mean(apart ** 2))


class Set:
    def __init__(self, folder: pathlib.Path, is_spoilt: bool):
        self.name = f"{folder.parent.name}/{folder.name}"
        self.is_spoilt = is_spoilt
        scans = multiview.read_scans(folder / "model/poses.json", folder / "truth.json")
        self.scans = scans
        number = {scan.file: i for i, scan in enumerate(scans)}
        self.pairs = collections.defaultdict(list)
        self.accepted = []  # of each pair that is: whether it is right
        self.with_pose = 0
        for pair in json.loads((folder / "model/graph.json").read_text())["pairs"]:
            if pair["of_groups"] or not pair["poses"]:
                continue
            self.with_pose += 1
            source, target = (number[pathlib.PurePath(pair[end]).name]
                              for end in ("source_file", "target_file"))
            odds = np.array([pose["log_odds"] for pose in pair["poses"]])
            shares = np.exp(np.minimum(odds - odds[0], 0.0))
            for share, pose in zip(shares / shares.sum(), pair["poses"]):
                T = np.array(pose["transformation"])
                a, b = target, source
                if a > b:
                    a, b, T = b, a, np.linalg.inv(T)
                self.pairs[a, b].append(
                    Candidate(a, b, T, pair["confidence"] * share, scans))
            if pair["verdict"] in ("kept", "rejected") and not pair["ambiguous"]:
                self.accepted.append(self.pairs[min(source, target), max(source, target)][0])
        if is_spoilt:
            self.spoil()

    def spoil(self):
        draw = np.random.default_rng(1)
        for number in draw.permutation(len(self.accepted))[:len(self.accepted) // 5]:
            a, b = self.accepted[number].a, self.accepted[number].b
            pose = np.eye(4)
            pose[:3, :3] = multiview.random_rotation(draw)
            place = self.scans[a].centroid + self.scans[a].radius * draw.normal(size=3)
            pose[:3, 3] = place - pose[:3, :3] @ self.scans[b].centroid
            self.pairs[a, b] = [Candidate(a, b, pose, 1.0, self.scans)]

    def radius(self, a: int, b: int) -> float:
        return min(self.scans[a].radius, self.scans[b].radius)

    def between(self, a: int, b: int) -> list:
        """What leads from the scan b to the scan a."""
        if a < b:
            return [(c.alone, c.pose) for c in self.pairs.get((a, b), [])]
        return [(c.alone, np.linalg.inv(c.pose)) for c in self.pairs.get((b, a), [])]

    def ways(self, a: int, b: int) -> list:
        """Ways from b to a by a third scan: the scan, how probable alone, the pose."""
        likeliest = lambda those: sorted(those, key=lambda one: -one[0])[:WAYS]
        ways = []
        for c in range(len(self.scans)):
            if c in (a, b):
                continue
            for one, other in itertools.product(likeliest(self.between(a, c)),
                                                likeliest(self.between(c, b))):
                if min(one[0], other[0]) >= LEAST_PROBABLE:
                    ways.append((c, min(one[0], other[0]), one[1] @ other[1]))
        return ways

    def observations(self) -> list:
        """Of each pair: its candidates, the ways that agree with each, and which of these
        and of the ways are alternatives to each."""
        observed = []
        for (a, b), candidates in sorted(self.pairs.items()):
            candidates = [c for c in candidates if c.alone >= LEAST_PROBABLE]
            if not candidates:
                continue
            ways = self.ways(a, b)
            near = AGREEING * self.radius(a, b)
            far = 2.0 * AGREEING * self.scans[b].radius
            agree = np.array([[displacement(self.scans[b], c.pose, way[2]) <= far
                               for way in ways] for c in candidates], bool)
            agree = agree.reshape(len(candidates), len(ways))
            same = np.array([[displacement(self.scans[b], c.pose, d.pose) <= near
                              for d in candidates] for c in candidates])
            observed.append((candidates, ways, agree, same))
        return observed


# --- what the code makes of it ---------------------------------------------------------

def log_odds(probability):
    return np.log(probability / (1.0 - probability))


def shifted(alone: float, surest: float, shift: float) -> float:
    odds = log_odds(min(alone, surest)) + shift
    return 1.0 / (1.0 + math.exp(-odds))


def gain(agreeing: float, chance: float, unsure: float, sure: float) -> float:
    say = min(max((agreeing - unsure) / (sure - unsure), 0.0), 1.0)
    return say * math.log((agreeing + (1.0 - agreeing) * chance) / chance)


def base_shift(scans: int, pairs: int, partners: float, usual: float) -> float:
    right = partners / 2.0 * scans
    return 0.0 if pairs <= right else min(0.0, math.log(right / (pairs - right)) - usual)


def likelihood(a_set: Set, observed: list, constants: dict) -> float:
    """The mean logarithm of how probable it was that best alignments are what they are."""
    shift = base_shift(len(a_set.scans), a_set.with_pose, constants["partners_that_fit"],
                       constants["usual_log_odds"])
    surest = constants["surest"]
    gains = [constants[name] for name in ("chance", "unsure", "sure")]
    total = 0.0
    for candidates, ways, agree, same in observed:
        chances = [shifted(way[1], surest, shift) for way in ways]
        odds = []
        for i, candidate in enumerate(candidates):
            thirds = collections.defaultdict(float)
            for way, chance, agrees in zip(ways, chances, agree[i]):
                if agrees:
                    thirds[way[0]] = max(thirds[way[0]], chance)
            odds.append(log_odds(shifted(candidate.alone, surest, shift))
                        + sum(gain(third, *gains) for third in thirds.values()))
        best = int(np.argmax(odds))
        rivals = [odds[i] for i in range(len(candidates)) if not same[best][i]]
        rivals += [log_odds(chance) for chance, agrees in zip(chances, agree[best])
                   if not agrees]
        said = odds[best] - np.log1p(math.exp(max(rivals))) if rivals else odds[best]
        sign = 1.0 if candidates[best].right else -1.0
        total -= np.logaddexp(0.0, -sign * said)
    return total / len(observed)


# --- the report ------------------------------------------------------------------------

def tell_agreement(sets: dict):
    """How often ways agree with right alignments, and with wrong ones."""
    print("ways by a third scan that agree, by how probable they are alone:\n"
          "                 with right alignments   with wrong ones   ratio's logarithm")
    edges = [LEAST_PROBABLE, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.01]
    for low, high in zip(edges, edges[1:]):
        shares = {True: [], False: []}
        for a_set, observed in sets.items():
            if a_set.is_spoilt:
                continue
            counts = {True: [0, 0], False: [0, 0]}
            for candidates, ways, agree, _ in observed:
                for i, candidate in enumerate(candidates):
                    for j, way in enumerate(ways):
                        if low <= way[1] < high:
                            counts[candidate.right][0] += agree[i][j]
                            counts[candidate.right][1] += 1
            for right, (agreeing, all_of_them) in counts.items():
                if all_of_them >= 20:
                    shares[right].append(agreeing / all_of_them)
        right, wrong = (float(np.mean(shares[key])) if shares[key] else math.nan
                        for key in (True, False))
        ratio = math.log(right / wrong) if right > 0.0 and wrong > 0.0 else math.nan
        print(f"  {low:4.2f} to {min(high, 1.0):4.2f}   {right:20.3f} {wrong:17.3f} {ratio:19.2f}")


def tell_sets(sets: dict):
    print("\nset: scans, right partners of a scan, accepted pairs that are right, errors of "
          "right poses as shares of the radius (median, 95 %)")
    for a_set in sets:
        if a_set.is_spoilt:
            continue
        right = [c for those in a_set.pairs.values() for c in those if c.right]
        partners = 2.0 * len({(c.a, c.b) for c in right}) / len(a_set.scans)
        errors = [displacement(a_set.scans[c.b], c.pose,
                               np.linalg.inv(a_set.scans[c.a].true) @ a_set.scans[c.b].true)
                  / a_set.radius(c.a, c.b) for c in right]
        accepted = a_set.accepted
        print(f"  {a_set.name}: {len(a_set.scans)}, {partners:.1f}, "
              f"{sum(c.right for c in accepted)} of {len(accepted)}, "
              f"{np.median(errors):.3f}, {np.quantile(errors, 0.95):.3f}")


def fit(sets: dict, have: dict) -> dict:
    """One constant after the other, until none gets better."""
    grids = {"chance": [0.01, 0.02, 0.03, 0.05, 0.08, 0.12, 0.2],
             "unsure": [0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3],
             "sure": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8],
             "surest": [0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98],
             "partners_that_fit": [2.0, 3.0, 4.0, 5.0, 6.0, 8.0]}

    def quality(constants: dict) -> float:
        if constants["unsure"] >= constants["sure"]:
            return -math.inf
        return float(np.mean([likelihood(a_set, observed, constants)
                              for a_set, observed in sets.items()]))

    best, quality_of_best = dict(have), quality(have)
    print(f"\nmean log-likelihood of what the code has: {quality_of_best:.4f}")
    while True:
        before = quality_of_best
        for name, grid in grids.items():
            for value in grid:
                found = quality({**best, name: value})
                if found > quality_of_best + 1e-4:
                    best, quality_of_best = {**best, name: value}, found
        if quality_of_best <= before:
            break
    print(f"of the best: {quality_of_best:.4f}")
    for name, grid in grids.items():
        around = {value: quality({**best, name: value}) for value in grid}
        print(f"  {name}: {best[name]} (the code has {have[name]}); "
              + ", ".join(f"{value}: {found:.3f}" for value, found in around.items()
                          if math.isfinite(found)))
    return best


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, metavar="DIR")
    folders = [folder.parent for root in parser.parse_args().folders
               for folder in sorted(root.glob("**/truth.json"))
               if (folder.parent / "model/graph.json").exists()]
    if not folders:
        sys.exit("there are no sets that have been connected")
    sets = {a_set: a_set.observations() for a_set in (
        Set(folder, is_spoilt) for folder in folders for is_spoilt in (False, True))}
    tell_agreement(sets)
    tell_sets(sets)
    fit(sets, {name: constant(name) for name in (
        "chance", "unsure", "sure", "surest", "partners_that_fit", "usual_log_odds")})


if __name__ == "__main__":
    main()
