#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes pairs of clouds of which it is known which poses are right.

usage: make_cases.py MODELS OUT [--seed N] [--share X] [--jobs N]
       [--only KIND,...]
MODELS is what models.py has filled. --share: that part of the cases of each kind."""
import argparse
import functools
import multiprocessing
import pathlib
import zlib

import numpy as np

import case
import models
import of_objects
import of_places
import world

# kind: cases with a right pose, cases without
KINDS = {
    "whole": (40, 30), "large": (6, 4), "noisy": (50, 26), "one_sided": (16, 4),
    "uneven": (20, 8), "sparse": (40, 24), "stray": (26, 10), "cut": (50, 30),
    "both_cut": (70, 34), "one_view": (56, 26), "two_views": (70, 34), "distorted": (60, 30),
    "on_table": (30, 16), "panel_skin": (44, 10), "as_built": (60, 30),
    "two_sides": (24, 12), "symmetric": (34, 14), "similar": (44, 50),
    "scale_free": (44, 16), "mirror": (0, 34), "small_on_big": (0, 28),
    "room": (70, 34), "corridor": (26, 10), "street": (60, 28), "in_room": (30, 30)}


def tasks(share, only=""):
    return [(kind, foreign, number) for kind, counts in KINDS.items()
            if not only or kind in only.split(",") for foreign, count in enumerate(counts)
            for number in range(round(share * count))]


@functools.lru_cache(None)
def the_world(folder, split):
    return world.World(models.all_models(folder), split)


def make(task, folder, out, seed):
    kind, foreign, number = task
    rng = np.random.default_rng([seed, zlib.crc32(kind.encode()), foreign, number])
    split = ("fit", "check")[number % 2]
    build = getattr(of_objects, kind, None) or getattr(of_places, kind)
    made = build(the_world(folder, split), rng, bool(foreign))
    name = ("other_" if foreign and kind not in ("mirror", "small_on_big") else "") + kind
    case.write(out / f"{name}-{number:03}", name, split, made, rng)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--share", type=float, default=1.)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    one = functools.partial(make, folder=options.models, out=options.out, seed=options.seed)
    todo = tasks(options.share, options.only)
    with multiprocessing.Pool(options.jobs) as pool:
        for _ in pool.imap_unordered(one, todo, 8):
            pass
    print(len(todo), "cases")


if __name__ == "__main__":
    main()
