#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Registers the benchmark's pairs with KISS-Matcher, by one thread on one core.

usage: pcl_kss_icp_benchmark --write-clouds=clouds
       run_kiss_matcher.py [--repetitions N] [--only TEXT] clouds > kiss_matcher.json
       report.py results.json kiss_matcher.json > results.md

The results are laid out as Google Benchmark's: CPU and wall time of estimate(), some 0.3 us a
point of which reads Python's arrays, and the errors against the truth; a pair that is not
solved is an error. Where the package is missing,
this says so and gives an empty list."""
import argparse
import json
import os
import pathlib
import re
import sys
import time

# before the package is loaded, which asks when it makes its threads
os.environ["OMP_NUM_THREADS"] = "1"
os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
try:
    import kiss_matcher
    import numpy as np
except ImportError:
    print("KISS-Matcher is not installed: pip install kiss-matcher==1.0.2", file=sys.stderr)
    print(json.dumps({"benchmarks": []}))
    sys.exit(0)

# Edges of voxels. Streets: the package's default; 0.2, 0.5 and 1 m solve fewer. Rooms:
# 0.05 and 0.15 m solve fewer. Surface: a fiftieth of the diagonal, as for SAC-IA.
VOXELS = {"street": lambda _: 0.3, "room": lambda _: 0.1,
          "surface": lambda diagonal: diagonal / 50.0}
NAMES = {"street": "StreetKissMatcher/seed:", "room": "RoomKissMatcher/seed:",
         "surface": "KissMatcher/"}
LEAST_INLIERS = 5  # fewer, and the authors take a registration for failed


def read_cloud(path):
    """A PCD of the benchmark's."""
    head, data = path.read_bytes().split(b"DATA binary\n", 1)
    points = int(re.search(rb"POINTS (\d+)", head).group(1))
    return np.frombuffer(data, np.float32).reshape(points, 3)


def errors(pose, truth, source, diagonal):
    """Degrees between the rotations; centres apart, in percent of the diagonal."""
    turn = pose[:3, :3] @ truth[:3, :3].T
    # the sine of half of the angle, which small angles do not lose in rounding
    sine = np.linalg.norm(turn - np.eye(3)) / np.sqrt(8.0)
    degrees = np.degrees(2.0 * np.arcsin(min(1.0, sine)))
    center = np.append(source.mean(axis=0, dtype=float), 1.0)
    away = np.linalg.norm(((pose - truth) @ center)[:3])
    return degrees, 100.0 * away / diagonal


def register(source, target, voxel):
    """The pose, whether KISS-Matcher believes in it, CPU and wall seconds."""
    wall, cpu = time.perf_counter(), time.process_time()
    matcher = kiss_matcher.KISSMatcher(kiss_matcher.KISSMatcherConfig(voxel_size=voxel))
    solution = matcher.estimate(source, target)
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    pose = np.eye(4)
    pose[:3, :3] = np.asarray(solution.rotation)
    pose[:3, 3] = np.asarray(solution.translation).ravel()
    believed = solution.valid and matcher.get_num_final_inliers() >= LEAST_INLIERS
    return pose, believed, cpu, wall


def measure(folder, name, repetitions):
    """The runs of one pair."""
    kind, number = name.split("_")
    source, target = (read_cloud(folder / f"{name}_{side}.pcd")
                      for side in ("source", "target"))
    truth = np.loadtxt(folder / f"{name}_truth.txt")
    diagonal = float(np.linalg.norm(target.max(axis=0) - target.min(axis=0)))
    for index in range(repetitions):
        pose, believed, cpu, wall = register(source, target, VOXELS[kind](diagonal))
        degrees, percent = errors(pose, truth, source, diagonal)
        run = {"name": NAMES[kind] + number, "run_name": NAMES[kind] + number,
               "run_type": "iteration", "repetitions": repetitions,
               "repetition_index": index, "threads": 1, "iterations": 1,
               "real_time": 1e3 * wall, "cpu_time": 1e3 * cpu, "time_unit": "ms",
               "converged": float(believed), "error_degrees": degrees,
               "error_percent": percent, "source_points": float(len(source)),
               "target_points": float(len(target))}
        if degrees >= 5.0 or percent >= 5.0:
            run["error_occurred"] = True
            run["error_message"] = (f"not solved: {degrees:.6f} degrees, "
                                    f"{percent:.6f} % of the diagonal off")
        yield run


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--only", default="", help="of the pairs whose names contain this")
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    names = sorted(path.name[:-len("_truth.txt")]
                   for path in arguments.folder.glob("*_truth.txt"))
    runs = []
    for name in names:
        if arguments.only in name:
            # what comes once in a process is not a registration's
            runs += list(measure(arguments.folder, name, arguments.repetitions + 1))[1:]
            print(name, f"{runs[-1]['cpu_time']:.0f} ms",
                  f"{runs[-1]['error_degrees']:.3f} degrees", file=sys.stderr)
    print(json.dumps({"context": {"executable": "KISS-Matcher"}, "benchmarks": runs},
                     indent=1))


if __name__ == "__main__":
    main()
