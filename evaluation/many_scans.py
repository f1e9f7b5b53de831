#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What docs/multiview.md and the README claim of many scans, done again.

    evaluation/many_scans.py BUILD --out DIR [--data FOLDER] [--sets NAME...] [--threads N]

Makes sets of scans, lets pcl_kss_icp_multiview of the build find their poses, judges them
as multiview.py does, and prints a table. Real scans take part where FOLDER has them, as
multiview.py prepare wants them. DIR/NAME then holds the scans, model/ and run.json, which
has what multiview_cost.py needs. CPU seconds are of all threads, to the last file written.
The exit status is 1 where a scan is in a wrong place or group, or a wrong pair is kept.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

sys.dont_write_bytecode = True

import multiview

VIRTUAL = {"virtual_bag": ["bag"], "turntable": ["turntable"], "building": ["building"],
           "loop": ["loop", "--scans", "40"], "street": ["street"]}
REAL = ["bunny", "figurine", "bag", "mixed"]
COLUMNS = ["set", "scans", "things", "groups", "right", "rotation, degrees", "translation, m",
           "wrong pairs kept", "pairs tried", "CPU seconds"]


def make(name: str, arguments, folder: pathlib.Path):
    build = arguments.build
    program = build / "benchmarks" / "pcl_kss_icp_virtual_scans"
    seed = str(arguments.seed)
    if name in VIRTUAL:
        command = [program, *VIRTUAL[name], "--shuffle"]
    else:
        command = [sys.executable, pathlib.Path(__file__).with_name("multiview.py"),
                   "prepare", name, "--data", arguments.data, "--program", program]
    if subprocess.run([*command, "--seed", seed, "--out", folder]).returncode != 0:
        sys.exit(f"{name} could not be made")


def connect(program: pathlib.Path, folder: pathlib.Path, threads: int) -> dict:
    """Run the tool, and tell what it took."""
    scans = sorted(folder.glob("scan_*.pcd"))
    start = time.monotonic()
    process = subprocess.Popen([program, *scans, "--out", folder / "model", "--restart",
                                "--quiet", "--threads", str(threads)])
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):  # 1: not all scans are connected
        sys.exit(f"{program} has ended with {process.returncode} on {folder}")
    return {"scans": len(scans), "points": sum(map(points_in, scans)), "threads": threads,
            "cpu_seconds": usage.ru_utime + usage.ru_stime,
            "wall_seconds": time.monotonic() - start, "peak_kilobytes": usage.ru_maxrss}


def points_in(scan: pathlib.Path) -> int:
    with open(scan, "rb") as file:
        for line in file:
            if line.startswith(b"POINTS"):
                return int(line.split()[1])
    sys.exit(f"{scan} does not say how many points it has")


def row_of(name: str, run: dict, report: dict) -> list:
    placed = [group for group in report["groups"] if group["scans"] > 1]

    def largest(what: str) -> float:
        return max((group[what]["largest"] for group in placed), default=float("nan"))

    pairs = report["pairs"]
    return [name, run["scans"], report["things"], len(report["groups"]), report["right"],
            f"{largest('rotation_deg'):.3f}", f"{largest('translation'):.2g}",
            len(pairs["kept_wrong"]), sum(pairs["verdicts"].values()),
            f"{run['cpu_seconds']:.1f}"]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--data", type=pathlib.Path, help="real scans, see above")
    parser.add_argument("--sets", nargs="+", choices=[*VIRTUAL, *REAL], metavar="NAME",
                        help="some of " + ", ".join([*VIRTUAL, *REAL]))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    arguments = parser.parse_args()
    names = arguments.sets or [*VIRTUAL, *(REAL if arguments.data else [])]
    if arguments.data is None and any(name in REAL for name in names):
        parser.error("real scans need --data FOLDER")

    print("| " + " | ".join(COLUMNS) + " |\n|---" + "|---:" * (len(COLUMNS) - 1) + "|")
    all_right = True
    for name in names:
        folder = arguments.out / name
        make(name, arguments, folder)
        run = connect(arguments.build / "tools" / "pcl_kss_icp_multiview", folder,
                      arguments.threads)
        report = multiview.judge(folder / "model/poses.json", folder / "truth.json")
        (folder / "run.json").write_text(json.dumps({**run, "judged": report}, indent=1))
        print("| " + " | ".join(map(str, row_of(name, run, report))) + " |", flush=True)
        all_right &= report["right"] == report["scans"] and not report["pairs"]["kept_wrong"]
    return 0 if all_right else 1


if __name__ == "__main__":
    sys.exit(main())
