#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Registers the cases of make_cases.py: a table of all poses found, with their evidence.

usage: run_cases.py CASES TABLE.csv [--program "pcl_kss_icp"] [--jobs N] [--only KIND,...]
A row for each alternative of each report: the case, whether the pose is right, and every
number that the report gives for it. A case without any pose has a row of rank -1."""
import argparse
import csv
import json
import multiprocessing.pool
import os
import pathlib
import shlex
import subprocess
import tempfile

import numpy as np

import judge

FIRST = ["case", "kind", "split", "objects", "scaling", "registered", "confidence",
         "ambiguous", "rank", "right", "right_pose", "degrees", "shift", "scale_error"]


def numbers(found, prefix=""):
    """All numbers in nested objects and lists, by name; transformations are left out."""
    named = {}
    for name, value in found.items() if isinstance(found, dict) else enumerate(found):
        if name == "transformation" or isinstance(value, str) or value is None:
            continue
        if isinstance(value, (dict, list)):
            short = "" if name == "evidence" else f"{prefix}{name}_"
            named.update(numbers(value, short))
        else:
            named[f"{prefix}{name}"] = float(value)
    return named


def register(folder, program):
    """The rows of a case."""
    meta = json.loads((folder / "meta.json").read_text())
    with tempfile.TemporaryDirectory() as scratch:
        report_path = os.path.join(scratch, "report.json")
        command = program + [folder / "source.pcd", folder / "target.pcd", "--report",
                             report_path, "--quiet"] + ["--rigid"] * meta["rigid"]
        done = subprocess.run(command, check=False, stderr=subprocess.PIPE)
        if done.returncode not in (0, 1):
            raise RuntimeError(f"{folder}: {done.returncode} {done.stderr.decode()}")
        with open(report_path) as file:
            report = json.load(file)
    surfaces = folder / "surfaces.npz"
    surfaces = dict(np.load(surfaces)) if surfaces.exists() else None
    start = {"case": folder.name, "kind": meta["kind"], "split": meta["split"],
             "objects": "+".join(meta["objects"]), "scaling": meta["scaling"],
             "registered": int(done.returncode == 0),
             "confidence": report.get("confidence"),
             "ambiguous": int(bool(report.get("ambiguous")))}
    rows = []
    for rank, found in enumerate(report.get("alternatives") or []):
        pose = np.array(found["transformation"], float)
        rows.append({**start, "rank": rank, **judge.verdict(meta, surfaces, pose),
                     **numbers(found)})
    return rows or [{**start, "rank": -1, "right": 0, "right_pose": 0}]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("--program", default="pcl_kss_icp")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    folders = sorted(folder for folder in options.cases.iterdir() if not options.only or
                     folder.name.rsplit("-", 1)[0] in options.only.split(","))
    program = shlex.split(options.program)
    with multiprocessing.pool.ThreadPool(options.jobs) as pool:
        rows = [row for rows in pool.imap(lambda folder: register(folder, program), folders)
                for row in rows]
    columns = list(dict.fromkeys(FIRST + [name for row in rows for name in row]))
    with open(options.table, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(len(folders), "cases,", len(rows), "poses")


if __name__ == "__main__":
    main()
