#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What pcl_kss_icp_multiview costs, and what thousands of scans would.

    evaluation/multiview_cost.py RUNS... [--benchmark FILE] [--cores N] [--partners N]
                                 [--scans N...]

RUNS are folders that many_scans.py has left, with times.json and run.json, done by one
thread on a machine that did nothing else. FILE is what
pcl_kss_icp_multiview_benchmark --benchmark_format=json has printed: what the process that
knows all scans does for each two of them. Prints the cost of each piece of work, set by
set, and the work, the memory and the time of more scans like those.

The numbers of pairs are those that src/multiview/pair_choice.cpp chooses at most; of what
follows (thorough pairs, steps of the refinement) as many for each scan as the largest runs
had. Work on scans and pairs is shared by all cores; what is done for each two of all scans
is that of one process.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

KINDS = {  # of work: the stages that do it
    "scans": ["scans"], "quick pairs": ["pairs"], "thorough pairs": ["pairs of groups"],
    "pairs of groups": ["groups", "scales of groups"],
    "steps of refinement": ["joint refinement"]}
# As src/multiview and src/scans have them.
ALL_PAIRS = 25
BYTES_OF_RESEMBLANCE = 4
EACH_TWO = {"Resemblances": 1, "DistantOverlaps": 10}  # how often; refinement has ten steps
BYTES_OF_DESCRIPTION = 0.056e6  # as pcl_kss_icp_multiview_benchmark counts them
# Of the texts that the journal has of a scan and of a pair.
JOURNAL_OF_SCAN, JOURNAL_OF_PAIR = 330e3, 1.4e3


class Run:
    """What a run took, stage by stage, and how much work it was."""

    def __init__(self, folder: pathlib.Path):
        run = json.loads((folder / "run.json").read_text())
        times = json.loads((folder / "model/times.json").read_text())
        if run["threads"] != 1:
            sys.exit(f"{folder}: was done by {run['threads']} threads; repeat it with one")
        self.name, self.scans = folder.name, run["scans"]
        self.points = run["points"] / run["scans"]
        self.counts = times["tasks"]
        self.seconds = {}
        for stage in times["stages"]:
            self.seconds[stage["stage"]] = (self.seconds.get(stage["stage"], 0.0)
                                            + stage["seconds"])
        self.rest = times["seconds"] - sum(self.seconds.values())

    def of(self, kind: str):
        """Seconds, and pieces of work."""
        return (sum(self.seconds.get(stage, 0.0) for stage in KINDS[kind]),
                self.counts.get(kind, 0))


def print_table(head: list, rows: list):
    print("| " + " | ".join(head) + " |\n|---" + "|---:" * (len(head) - 1) + "|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def milliseconds(seconds: float, count: int) -> str:
    return f"{1e3 * seconds / count:.1f} ({count})" if count else ""


def pooled(runs: list, kind: str) -> float:
    """Seconds for one piece of work."""
    seconds, counts = np.sum([run.of(kind) for run in runs], axis=0)
    return seconds / counts if counts else 0.0


def preparation(runs: list):
    """Seconds of a scan, as what it costs anyway and what each point adds."""
    points = np.array([run.points for run in runs])
    seconds = np.array([run.of("scans")[0] / run.scans for run in runs])
    if len(runs) < 2 or np.ptp(points) < 0.1 * points.mean():
        return float(seconds.mean()), 0.0
    slope, base = np.polyfit(points, seconds, 1)
    # other things differ, too: no fit is better than one that cannot be
    return (float(base), float(slope)) if slope > 0.0 and base > 0.0 else (
        float(seconds.mean()), 0.0)


def each_two(benchmark: pathlib.Path, runs: list) -> dict:
    """Seconds for each two scans."""
    if benchmark is None:
        asked = [run for run in runs if "resemblances" in run.seconds]
        two = sum(run.scans * (run.scans - 1) / 2 for run in asked)
        return {"Resemblances": sum(run.seconds["resemblances"] for run in asked) / two
                if two else float("nan")}
    measured = json.loads(benchmark.read_text())["benchmarks"]
    return {entry["name"]: 1.0 / entry["items_per_second"] for entry in measured
            if entry["name"] in EACH_TWO}


def predicted(scans: int, arguments, runs: list, cost: dict) -> dict:
    large = [run for run in runs if run.scans > ALL_PAIRS] or runs
    total = sum(run.scans for run in large)
    per_scan = {kind: sum(run.of(kind)[1] for run in large) / total for kind in KINDS}
    per_scan["scans"] = 1.0
    per_scan["quick pairs"] = arguments.partners + 1 if scans > ALL_PAIRS else (scans - 1) / 2
    base, slope = preparation(runs)
    points = np.mean([run.points for run in runs])
    work = {kind: scans * per_scan[kind] * pooled(runs, kind) for kind in KINDS}
    work["scans"] = scans * (base + slope * points)
    two = scans * (scans - 1) / 2
    return {"shared": work, "shared seconds": sum(work.values()) / arguments.cores,
            "alone": {name: two * EACH_TWO[name] * seconds for name, seconds in cost.items()},
            "descriptions": BYTES_OF_DESCRIPTION * scans,
            "matrix": BYTES_OF_RESEMBLANCE * scans ** 2,
            "journal": scans * (JOURNAL_OF_SCAN
                                + JOURNAL_OF_PAIR * sum(per_scan[kind] for kind in KINDS
                                                        if kind != "scans"))}


def time_text(seconds: float) -> str:
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.3g} {unit}"
    return f"{seconds:.3g} s"


def size_text(size: float) -> str:
    for unit, length in (("GB", 1e9), ("MB", 1e6)):
        if size >= length:
            return f"{size / length:.3g} {unit}"
    return f"{size / 1e3:.3g} kB"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    parser.add_argument("--benchmark", type=pathlib.Path)
    parser.add_argument("--cores", type=int, default=1)
    parser.add_argument("--partners", type=int, default=8)
    parser.add_argument("--scans", type=int, nargs="+", default=[1000, 100000])
    arguments = parser.parse_args()
    runs = [Run(folder) for folder in arguments.runs]
    cost = each_two(arguments.benchmark, runs)

    print("Milliseconds for a piece of work (and how many there were):\n")
    print_table(["set", "points of each scan", *KINDS, "the rest, s in all"],
                [[run.name, f"{run.points:.0f}",
                  *(milliseconds(*run.of(kind)) for kind in KINDS),
                  f"{run.rest:.2f}"] for run in runs])
    base, slope = preparation(runs)
    print(f"A scan takes {1e3 * base:.1f} ms and {1e6 * slope:.2f} microseconds for each of "
          "its points; "
          + ", ".join(f"one of the {kind} {1e3 * pooled(runs, kind):.1f} ms"
                      for kind in list(KINDS)[1:] if pooled(runs, kind) > 0.0) + ".")
    print("Each two of all scans take " + ", ".join(
        f"{1e6 * seconds:.3g} microseconds ({name})" for name, seconds in cost.items()) + ".\n")

    guesses = [predicted(scans, arguments, runs, cost) for scans in arguments.scans]
    rows = [[kind] + [time_text(guess["shared"][kind]) for guess in guesses] for kind in KINDS]
    rows.append(["all these" if arguments.cores == 1 else f"all these, by {arguments.cores} cores"]
                + [time_text(guess["shared seconds"]) for guess in guesses])
    rows += [[f"{name}, by one process"] + [time_text(guess["alone"][name]) for guess in guesses]
             for name in cost]
    rows.append(["memory of the resemblances"] + [size_text(g["matrix"]) for g in guesses])
    rows.append(["memory of descriptions"] + [size_text(g["descriptions"]) for g in guesses])
    rows.append(["journal, on disk"] + [size_text(g["journal"]) for g in guesses])
    print_table(["CPU time, one core", *(f"{scans:,} scans" for scans in arguments.scans)], rows)


if __name__ == "__main__":
    main()
