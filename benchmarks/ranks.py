#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many pairs per second pcl_kss_icp_batch registers as one process, and as two ranks of
mpirun with a core each: in turns, medians of both and of their ratio.

    benchmarks/ranks.py BUILD [PAIRS [POINTS [ROUNDS]]]       otherwise 60, 10000, 5
"""
import math
import os
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time


def lump(generator, points, bulge):
    """Points of a surface without any symmetry."""
    for _ in range(points):
        z, angle = generator.uniform(-1, 1), generator.uniform(0, 2 * math.pi)
        x, y = math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle)
        far = 1 + bulge * x * y + 0.4 * z ** 3 + 0.3 * x
        yield x * far, y * far, z * far


def turned(point, angle):
    x, y, z = point
    x, y = x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)
    y, z = y * math.cos(angle) - z * math.sin(angle), y * math.sin(angle) + z * math.cos(angle)
    return x + 3, y - 2, z


def write_pairs(folder, pairs, points):
    generator = random.Random(1)
    rows = ["source,target"]
    for i in range(pairs):
        for name, angle in ((f"s{i}.xyz", 0.0), (f"t{i}.xyz", 1.0 + i)):
            with open(folder / name, "w", encoding="ascii") as file:
                for point in lump(generator, points, 0.5 + 0.005 * i):
                    file.write("%.6f %.6f %.6f\n" % turned(point, angle))
        rows.append(f"s{i}.xyz,t{i}.xyz")
    (folder / "pairs.csv").write_text("\n".join(rows) + "\n", encoding="ascii")


def pairs_per_second(folder, pairs, command):
    start = time.monotonic()
    subprocess.run(command + ["pairs.csv", "--out", "out", "--restart", "--quiet", "--rigid",
                              "--device", "host", "--threads", "1"], cwd=folder, check=True)
    return pairs / (time.monotonic() - start)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    pairs, points, rounds = (int(word) for word in (sys.argv[2:] + ["60", "10000", "5"]
                                                    [len(sys.argv) - 2:]))
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    program = [str(build / "tools" / "pcl_kss_icp_batch")]
    one, two = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_pairs(folder, pairs, points)
        for _ in range(rounds):
            one.append(pairs_per_second(folder, pairs, program))
            two.append(pairs_per_second(folder, pairs, ["mpirun", "-n", "2"] + program))
            print(f"{one[-1]:.2f} and {two[-1]:.2f} pairs per second, {two[-1] / one[-1]:.2f}")
    ratio = statistics.median(b / a for a, b in zip(one, two))
    print(f"medians: {statistics.median(one):.2f} pairs per second by one process, "
          f"{statistics.median(two):.2f} by two ranks, {ratio:.2f} times as many")


if __name__ == "__main__":
    main()
