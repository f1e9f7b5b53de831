#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what benchmarks/compare.py says of times that are known."""
import pathlib
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks"))
import compare  # noqa: E402


def rounds(factor, noise, number=7):
    """Rounds of a benchmark that takes B so many times as long as A; the machine's load
    swings between the rounds."""
    draw = random.Random(5)

    def time(load):
        return 100.0 * load * draw.uniform(1.0 - noise, 1.0 + noise)
    return [({"X/1": time(load)}, {"X/1": factor * time(load)})
            for load in (draw.uniform(1.0, 2.0) for _ in range(number))]


def verdict(rounds_measured):
    (name, _, _, _, _, word, bad), = compare.compare(rounds_measured, 0.1)
    assert name == "X/1" and bad == (word in ("SLOWER", "FAILS")), (name, word, bad)
    return word


def results(*runs):
    return {"benchmarks": [
        {"run_type": kind, "run_name": "X/1/repeats:3", "cpu_time": time, "time_unit": "s",
         **({"error_occurred": True} if error else {})} for kind, time, error in runs]}


expectations = [
    ("least of the repetitions, in ms, aggregates aside", {"X/1": 1000.0},
     compare.least(results(("iteration", 1, 0), ("iteration", 2, 0), ("iteration", 9, 0),
                             ("aggregate", 50, 0)))),
    ("one failure is one", {"X/1": None},
     compare.least(results(("iteration", 1, 0), ("iteration", 2, 1)))),
    ("30 % slower", "SLOWER", verdict(rounds(1.3, 0.03))),
    ("5 % slower is within the threshold", "", verdict(rounds(1.05, 0.01))),
    ("12 % slower is within the noise", "", verdict(rounds(1.12, 0.15))),
    ("faster", "faster", verdict(rounds(0.7, 0.03))),
    ("B fails", "FAILS", verdict([({"X/1": 1.0}, {"X/1": None})])),
    ("A fails", "", verdict([({"X/1": None}, {"X/1": 1.0})])),
    ("nothing in common", [], list(compare.compare([({"X/1": 1.0}, {"Y/1": 1.0})], 0.1))),
    ("all values alike", (1.5, 1.5), compare.range_of_median([1.5] * 4)),
]
wrong = [f"{what}: {found!r} instead of {expected!r}"
         for what, expected, found in expectations if found != expected]
print("\n".join(wrong), end="\n" if wrong else "")
sys.exit(bool(wrong))
