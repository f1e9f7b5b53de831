#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells whether build B is slower than build A: runs both benchmarks in turns on one core.

usage: compare.py [--filter REGEX] [--rounds N] [--threshold PERCENT] [--core N] A B

A and B are build folders, or the benchmark programs themselves. Every round starts both
programs, in turns the one or the other first, so that whatever else the machine does meets
both. The CPU time of a benchmark in a round is the least of its repetitions, which a busy
machine disturbs least; the table has the median over the rounds of B / A, and the range in
which that median lies with 95 %.

Exit status: 1 where all of that range is above the threshold, or where B does not solve a
pair that A solves; 2 where nothing could be compared; else 0."""
import argparse
import json
import os
import pathlib
import random
import statistics
import subprocess
import sys

PROGRAM = pathlib.Path("benchmarks") / "pcl_kss_icp_benchmark"  # of a build folder
FILTER = "^(Automatic/10000|AutomaticRigid/100000|(Street|Room)Rigid/seed:1)/"
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}


class NoResults(Exception):
    """A program that gave none."""


def program_of(path):
    return path / PROGRAM if path.is_dir() else path


def least(results):
    """The CPU time of each benchmark of one run, in ms; None where it failed."""
    runs = {}
    for run in results["benchmarks"]:
        if run["run_type"] == "iteration":
            name = "/".join(run["run_name"].split("/")[:2])
            runs.setdefault(name, []).append(run)
    return {name: None if any(run.get("error_occurred") for run in same) else
            min(run["cpu_time"] * MILLISECONDS[run["time_unit"]] for run in same)
            for name, same in runs.items()}


def measure(program, pattern):
    run = subprocess.run([program, f"--benchmark_filter={pattern}",
                          "--benchmark_format=json"], stdout=subprocess.PIPE,
                         stderr=subprocess.PIPE, text=True, check=False)
    if run.returncode != 0 or not run.stdout.strip():
        raise NoResults(f"{program}: {run.stderr.strip() or 'no results'}")
    return least(json.loads(run.stdout))


def rounds_of(programs, pattern, number):
    """For each round what A and what B took."""
    rounds = []
    for i in range(number):
        pair = [None, None]
        for which in ((0, 1), (1, 0))[i % 2]:
            pair[which] = measure(programs[which], pattern)
        rounds.append(pair)
        print(f"round {i + 1} of {number}", file=sys.stderr)
    return rounds


def range_of_median(values, draws=2000):
    """Between which values the median lies with 95 %, by bootstrap; the same for the same
    values."""
    draw = random.Random(1)
    medians_drawn = sorted(statistics.median(draw.choices(values, k=len(values)))
                           for _ in range(draws))
    return medians_drawn[int(0.025 * draws)], medians_drawn[int(0.975 * draws) - 1]


def compare(rounds, threshold):
    """(name, text of A, of B, of the ratio, of its range, verdict, whether it is bad) of
    each benchmark that both programs have."""
    for name in rounds[0][0]:
        if name not in rounds[0][1]:
            continue
        times = [[one[name] for one in build] for build in zip(*rounds)]
        failed = [None in build for build in times]
        if any(failed):
            texts = ["failed" if lost else f"{statistics.median(build):.4g}"
                     for lost, build in zip(failed, times)]
            worse = failed[1] and not failed[0]
            yield name, *texts, "", "", "FAILS" if worse else "", worse
            continue
        ratios = [b / a for a, b in zip(*times)]
        low, high = range_of_median(ratios)
        slower, faster = low > 1.0 + threshold, high < 1.0
        yield (name, *(f"{statistics.median(build):.4g}" for build in times),
               f"{statistics.median(ratios):.3f}", f"{low:.3f} to {high:.3f}",
               "SLOWER" if slower else "faster" if faster else "", slower)


def table(rows):
    head = ["benchmark", "A, ms", "B, ms", "B / A", "95 %", ""]
    lines = [head] + [list(row[:-1]) for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join("  ".join([line[0].ljust(widths[0])] +
                               [cell.rjust(width) for cell, width in
                                zip(line[1:], widths[1:])]).rstrip() for line in lines)


def main():
    parser = argparse.ArgumentParser(
        usage=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--filter", default=FILTER)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threshold", type=float, default=10.0, help="percent")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("builds", type=pathlib.Path, nargs=2)
    arguments = parser.parse_args()
    os.sched_setaffinity(0, {arguments.core})  # of the programs, too
    programs = [program_of(build) for build in arguments.builds]
    try:
        rows = list(compare(rounds_of(programs, arguments.filter, arguments.rounds),
                            arguments.threshold / 100.0))
    except (NoResults, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    if not rows:
        print("the two have no benchmark in common", file=sys.stderr)
        return 2
    print(table(rows))
    return 1 if any(row[-1] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
