#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Registers two clouds in Python.

    examples/08_python.py [SOURCE.npy TARGET.npy]      otherwise clouds of its own

The package is installed by `pip install .`; see docs/python.md.
"""
import sys

import numpy as np

import pcl_kss_icp


def lump(number, seed):
    """Points of a bumpy ball, independent of those of another seed."""
    unit = np.random.default_rng(seed).normal(size=(number, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    x, y, z = unit.T
    bumps = 0.25 * np.sin(3 * x + 1) * np.cos(2 * y) + 0.2 * np.sin(4 * y - 2 * z)
    return (1 + bumps + 0.15 * np.cos(5 * z + x))[:, None] * unit


if len(sys.argv) == 3:
    source, target = np.load(sys.argv[1]), np.load(sys.argv[2])
else:
    quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    source = lump(5000, 1)
    target = 2.5 * lump(5000, 2) @ quarter.T + [10, 20, 30]

result = pcl_kss_icp.register(source, target)
if not result:
    sys.exit(f"not registered: {result.reason}")

print(result)
print(np.array_str(result.transformation, precision=4, suppress_small=True))
if result.covariance is not None:
    degrees = np.degrees(np.sqrt(np.diag(result.covariance)[:3]))
    print("standard deviation of the rotation, in degrees:", degrees.round(4))
np.save("placed.npy", result @ source)
