#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Registers the cases of make_cases.py: a table of all poses found, with their evidence.

usage: run_cases.py CASES OUT [--program "pcl_kss_icp"] [--jobs N] [--only KIND,...]
       [--share X] [--guide] [--judge]
OUT gets the reports and table.csv. Reports that are there are kept, so that a run that
was stopped goes on; --judge makes the table of them alone.
A row for each alternative of each report: the case, whether the pose is right, and every
number that the report gives for it. A case without any pose has a row of rank -1.
--share: the first cases of each kind, that part of them. --guide: those that have a right
pose alone, with that as the guess: what evidence is worth must not depend on who finds it."""
import argparse
import csv
import json
import multiprocessing.pool
import pathlib
import shlex
import subprocess

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


def register(folder, report_path, program, guide):
    """Has the report of a case written, unless it is there."""
    if report_path.exists():
        return
    written = report_path.with_suffix(".part")
    meta = json.loads((folder / "meta.json").read_text())
    if guide:
        guess = report_path.with_suffix(".guess")
        np.savetxt(guess, meta["pose"])
        program = program + ["--guess", guess]
    command = program + [folder / "source.pcd", folder / "target.pcd", "--report",
                         written, "--quiet"] + ["--rigid"] * meta["rigid"]
    done = subprocess.run(command, check=False, stderr=subprocess.PIPE)
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{folder}: {done.returncode} {done.stderr.decode()}")
    written.rename(report_path)


def judged(folder, report_path):
    """The rows of a case."""
    meta = json.loads((folder / "meta.json").read_text())
    report = json.loads(report_path.read_text())
    surfaces = folder / "surfaces.npz"
    surfaces = dict(np.load(surfaces)) if surfaces.exists() else None
    start = {"case": report_path.stem, "kind": meta["kind"], "split": meta["split"],
             "objects": "+".join(meta["objects"]), "scaling": meta["scaling"],
             "registered": int(report["converged"]),
             "confidence": report.get("confidence"),
             "ambiguous": int(bool(report.get("ambiguous")))}
    rows = []
    for rank, found in enumerate(report.get("alternatives") or []):
        pose = np.array(found["transformation"], float)
        rows.append({**start, "rank": rank, **judge.verdict(meta, surfaces, pose),
                     **numbers(found)})
    return rows or [{**start, "rank": -1, "right": 0, "right_pose": 0}]


def some_of_each(cases, only, share):
    """The folders of the first cases of each kind, the first of all kinds first."""
    kinds = {}
    for folder in sorted(cases.iterdir()):
        kinds.setdefault(folder.name.rsplit("-", 1)[0], []).append(folder)
    some = [folder for kind, folders in kinds.items() if not only or kind in only.split(",")
            for folder in folders[:round(share * len(folders))]]
    return sorted(some, key=lambda folder: folder.name.rsplit("-", 1)[::-1])


def has_pose(folder):
    return not json.loads((folder / "meta.json").read_text())["foreign"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--program", default="pcl_kss_icp")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="")
    parser.add_argument("--share", type=float, default=1.)
    parser.add_argument("--guide", action="store_true")
    parser.add_argument("--judge", action="store_true")
    options = parser.parse_args()
    folders = some_of_each(options.cases, options.only, options.share)
    program = shlex.split(options.program)
    options.out.mkdir(parents=True, exist_ok=True)
    if options.guide:
        folders = [folder for folder in folders if has_pose(folder)]
    ending = "-guided" if options.guide else ""
    pairs = [(folder, options.out / f"{folder.name}{ending}.json") for folder in folders]
    if not options.judge:
        with multiprocessing.pool.ThreadPool(options.jobs) as pool:
            pool.starmap(lambda *pair: register(*pair, program, options.guide), pairs, 1)
    rows = [row for pair in pairs if pair[1].exists() for row in judged(*pair)]
    columns = list(dict.fromkeys(FIRST + [name for row in rows for name in row]))
    with open(options.out / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    print(len(folders), "cases,", len(rows), "poses")


if __name__ == "__main__":
    main()
