#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether pcl_kss_icp_batch keeps its word, on a list of many pairs.

    evaluation/batch_check.py BUILD [--pairs N] [--points N] [--threads N] [--seed N]

Registers N pairs (200), ten of which have a broken file, without interruption, and again
with an end by SIGKILL in the middle, after which the same command goes on. Both have to
leave the same bytes, all whole pairs have to be registered and all broken ones to have
failed, and ten pairs drawn at random have to have the numbers that pcl_kss_icp gives them.
Prints what it has checked; the exit status is 1 where something is not so.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

BROKEN = {"missing.xyz": None, "empty.xyz": b"", "words.xyz": b"this is no cloud\n",
          "cut.off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n", "cut.ply": b"ply\nformat ascii 1.0\n",
          "cut.pcd": b"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                     b"WIDTH 99\nHEIGHT 1\nPOINTS 99\nDATA binary\n1234"}
HOW = ["--rigid", "--device", "host"]


def lump(draw: random.Random, points: int, bulge: float):
    """Points of a surface without any symmetry."""
    for _ in range(points):
        z, angle = draw.uniform(-1.0, 1.0), draw.uniform(0.0, 2.0 * math.pi)
        round_ = math.sqrt(1.0 - z * z)
        x, y = round_ * math.cos(angle), round_ * math.sin(angle)
        far = 1.0 + bulge * x * y + 0.4 * z ** 3 + 0.3 * x
        yield x * far, y * far, z * far


def moved(point, angle: float):
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = point
    x, y = c * x - s * y, s * x + c * y
    return x + 3.0, c * y - s * z - 2.0, s * y + c * z


def write_pairs(folder: pathlib.Path, arguments) -> set:
    """The numbers of the pairs that are broken."""
    draw = random.Random(arguments.seed)
    for name, contents in BROKEN.items():
        if contents is not None:
            (folder / name).write_bytes(contents)
    broken = set(draw.sample(range(1, arguments.pairs + 1), 10))
    rows = ["source,target,name"]
    for i in range(1, arguments.pairs + 1):
        files = [f"source_{i}.xyz", f"target_{i}.xyz"]
        for file, angle in zip(files, (0.0, 1.0 + 0.1 * i)):
            with open(folder / file, "w", encoding="ascii") as cloud:
                for point in lump(draw, arguments.points, 0.4 + 0.2 * i / arguments.pairs):
                    cloud.write("%.6f %.6f %.6f\n" % moved(point, angle))
        if i in broken:
            files[draw.randrange(2)] = draw.choice(sorted(BROKEN))
        rows.append(",".join([*files, f"pair {i}"]))
    (folder / "pairs.csv").write_text("\n".join(rows) + "\n", encoding="ascii")
    return broken


class Batch:
    """Runs of the program on one list."""

    def __init__(self, folder: pathlib.Path, arguments):
        self.folder = folder
        self.command = [str(arguments.build.resolve() / "tools" / "pcl_kss_icp_batch"),
                        "pairs.csv", *HOW, "--threads", str(arguments.threads), "--quiet"]

    def start(self, out: str) -> subprocess.Popen:
        return subprocess.Popen([*self.command, "--out", out], cwd=self.folder)

    def done(self, out: str) -> int:
        """How many pairs the journal has."""
        if not (self.folder / out / "journal.jsonl").exists():
            return 0
        lines = self.journal(out).split(b"\n")[:-1]
        return sum(b'"status"' in line for line in lines)

    def journal(self, out: str) -> bytes:
        return (self.folder / out / "journal.jsonl").read_bytes()

    def results(self, out: str) -> list:
        return [(self.folder / out / name).read_bytes()
                for name in ("results.csv", "results.jsonl")]


class Checks:
    """What has been found out."""

    def __init__(self):
        self.failed = 0

    def __call__(self, holds: bool, what: str):
        print(("yes" if holds else "NO ") + "  " + what, flush=True)
        self.failed += not holds


def check_kill(batch: Batch, pairs: int, check: Checks):
    process = batch.start("killed")
    while process.poll() is None and batch.done("killed") < pairs // 2:
        time.sleep(0.01)
    process.kill()
    status, done = process.wait(), batch.done("killed")
    check(status == -signal.SIGKILL and pairs // 2 <= done < pairs,
          f"SIGKILL ends it when {done} of {pairs} pairs are done")
    check(not (batch.folder / "killed/results.csv").exists(), "no results are there then")
    before = batch.journal("killed")
    before = before[:before.rindex(b"\n") + 1]
    start = time.monotonic()
    check(batch.start("killed").wait() == 1,
          f"the same command does the others in {time.monotonic() - start:.1f} s")
    check(batch.journal("killed").startswith(before), "and none of those that were done")
    times = list(csv.DictReader(open(batch.folder / "killed/times.csv", newline="")))
    check(len(times) == pairs, "each pair has its line")


def check_single(batch: Batch, program: pathlib.Path, number: int, line: dict) -> bool:
    report = batch.folder / "single.json"
    report.unlink(missing_ok=True)
    subprocess.run([program, f"source_{number}.xyz", f"target_{number}.xyz", *HOW,
                    "--threads", "1", "--report", report.name], cwd=batch.folder,
                   check=True, stdout=subprocess.DEVNULL)
    single = json.loads(report.read_text())
    del single["seconds"]
    return single == {key: value for key, value in line.items()
                      if key not in ("number", "name", "status", "warnings")}


def check_all(folder: pathlib.Path, arguments) -> int:
    check = Checks()
    broken = write_pairs(folder, arguments)
    batch = Batch(folder, arguments)
    start = time.monotonic()
    check(batch.start("whole").wait() == 1,
          f"{arguments.pairs} pairs, {len(broken)} of them broken, are gone through")
    print(f"     in {time.monotonic() - start:.1f} s by {arguments.threads} threads")
    lines = [json.loads(line) for line in batch.results("whole")[1].splitlines()]
    check([line["number"] for line in lines] == list(range(1, arguments.pairs + 1)),
          "each pair has its line, in the order of the list")
    check({line["number"] for line in lines if line["status"] == "failed"} == broken,
          "those that are broken have failed, and no others")
    check(all(line["status"] == "registered" for line in lines
              if line["number"] not in broken), "all others are registered")
    check(all(line["reason"] for line in lines if line["status"] == "failed"),
          "failed ones have a reason")

    check_kill(batch, arguments.pairs, check)
    check(batch.results("whole") == batch.results("killed"),
          "the results have the same bytes as without interruption")

    whole = [number for number in range(1, arguments.pairs + 1) if number not in broken]
    drawn = sorted(random.Random(arguments.seed + 1).sample(whole, 10))
    program = arguments.build.resolve() / "tools" / "pcl_kss_icp"
    same = [check_single(batch, program, number, lines[number - 1]) for number in drawn]
    check(all(same), "pcl_kss_icp has the same numbers of pairs "
          + ", ".join(map(str, drawn)))
    return 1 if check.failed else 0


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--pairs", type=int, default=200, help="20 or more")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return check_all(pathlib.Path(folder), arguments)


if __name__ == "__main__":
    sys.exit(main())
