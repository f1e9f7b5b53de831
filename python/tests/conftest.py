# SPDX-License-Identifier: BSD-3-Clause
"""Clouds for the tests."""
import numpy as np
import pytest


def bumpy_ball(number, seed):
    """Points of a ball every part of which is different, independent of another seed's."""
    unit = np.random.default_rng(seed).normal(size=(number, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    x, y, z = unit.T
    bumps = (0.25 * np.sin(3 * x + 1) * np.cos(2 * y) + 0.2 * np.sin(4 * y - 2 * z)
             + 0.15 * np.cos(5 * z + x) + 0.12 * np.sin(6 * x - 5 * y + 2 * z))
    return (1 + bumps)[:, None] * unit


def turned(seed):
    """A rotation by any angle."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)


def pose_of(rotation, scale, shift):
    pose = np.eye(4)
    pose[:3, :3] = scale * rotation
    pose[:3, 3] = shift
    return pose


def degrees_between(pose, truth):
    a, b = (p[:3, :3] / np.cbrt(np.linalg.det(p[:3, :3])) for p in (pose, truth))
    return np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(a - b) / np.sqrt(8), 0, 1)))


class Pair:
    """Two samplings of one thing, and the pose between them."""

    def __init__(self, number=4000, scale=1.3, shift=(1, 2, 3)):
        self.truth = pose_of(turned(5), scale, shift)
        self.source = bumpy_ball(number, 1)
        self.target = bumpy_ball(number, 2) @ self.truth[:3, :3].T + self.truth[:3, 3]

    def degrees_off(self, result):
        return degrees_between(result.transformation, self.truth)


@pytest.fixture(scope="session")
def pair():
    return Pair()


@pytest.fixture(scope="session")
def rigid_pair():
    return Pair(scale=1.0)
