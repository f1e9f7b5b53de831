#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Replaces answers in a journal of pcl_kss_icp_multiview by wrong ones.

    evaluation/spoil_journal.py JOURNAL [--share 0.2] [--seed 1]

Of the pairs in it that were accepted, that share gets a random pose each, and confidence 1.
The program goes on from such a journal (DIR/journal.txt, kept from a run that was
interrupted) as from any other: how far do poses move? Prints how many pairs are wrong now.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

sys.dont_write_bytecode = True

import multiview


def random_pose(draw) -> list:
    pose = np.eye(4)
    pose[:3, :3] = multiview.random_rotation(draw)
    pose[:3, 3] = 10.0 * draw.normal(size=3)
    return pose.T.ravel().tolist()  # column by column


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("journal", type=pathlib.Path)
    parser.add_argument("--share", type=float, default=0.2)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    lines = arguments.journal.read_text().split("\n")
    accepted = []
    for number, line in enumerate(lines):
        job, tab, answer = line.partition("\t")
        if tab:
            answer = json.loads(answer)
            pair = answer.get("pair", {})
            if pair.get("poses") and pair["failure"][0] == 0 and pair["confidence"] > 0.0:
                accepted.append((number, job, answer))
    draw = np.random.default_rng(arguments.seed)
    wrong = int(arguments.share * len(accepted))
    for chosen in draw.permutation(len(accepted))[:wrong]:
        number, job, answer = accepted[chosen]
        pair = answer["pair"]
        pair["poses"] = [{**pair["poses"][0], "transformation": random_pose(draw)}]
        pair["confidence"], pair["ambiguous"] = 1.0, False
        lines[number] = f"{job}\t{json.dumps(answer)}"
    arguments.journal.write_text("\n".join(lines))
    print(f"{wrong} of {len(accepted)} accepted pairs are wrong now")


if __name__ == "__main__":
    main()
