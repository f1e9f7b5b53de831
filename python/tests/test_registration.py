# SPDX-License-Identifier: BSD-3-Clause
"""What register() makes of clouds."""
import pickle

import numpy as np
import pytest

import pcl_kss_icp
from conftest import Pair, bumpy_ball, degrees_between, pose_of


@pytest.fixture(scope="module")
def result(pair):
    return pcl_kss_icp.register(pair.source, pair.target)


def test_finds_the_pose(pair, result):
    assert result and result.converged is True
    assert pair.degrees_off(result) < 0.1
    assert result.scale == pytest.approx(1.3, rel=1e-3)
    assert np.abs(result.transformation - pair.truth).max() < 5e-3
    assert result.confidence > 0.9
    assert result.reason == "" and result.cause is None


def test_says_what_it_has_found(result):
    assert result.mode == "global"
    assert result.overlap == result.alternatives[0].overlap
    assert min(result.overlap) > 0.9
    assert np.array_equal(result.alternatives[0].transformation, result.transformation)
    assert result.alternatives[0].score > 1.4
    assert result.alternatives[0].evidence["source"]["explained"] > 0.8
    assert result.covariance.shape == (7, 7)
    assert np.all(np.linalg.eigvalsh(result.covariance) > 0)
    assert result.far_points == (0, 0)
    assert result.undetermined == 0 and result.ambiguous is False
    assert list(result.seconds)[-1] == "final ICP"
    assert all(seconds >= 0 for seconds in result.seconds.values())
    assert result.device
    assert "converged=True" in repr(result) and f"scale={result.scale:.6g}" in repr(result)


def test_truth_is_within_the_covariance(pair, result):
    apart = result.transformation[:3, :3] @ np.linalg.inv(pair.truth[:3, :3])
    scale = np.cbrt(np.linalg.det(apart))
    turn = 0.5 * (apart - apart.T) / scale
    middle = pair.source.mean(axis=0)
    shift = (result.transformation - pair.truth)[:3] @ np.append(middle, 1)
    error = np.concatenate([[turn[2, 1], turn[0, 2], turn[1, 0]], shift, [np.log(scale)]])
    distance = error @ np.linalg.solve(result.covariance, error)
    assert distance < 24.3  # of seven directions, chance exceeds it once in a thousand


def test_results_do_not_change(result):
    with pytest.raises(AttributeError):
        result.scale = 2.0
    with pytest.raises(ValueError):
        result.transformation[0, 0] = 2.0
    with pytest.raises(TypeError):
        result.seconds["search"] = 0.0
    with pytest.raises(TypeError):
        result.alternatives[0].evidence["source"]["near"] = 1.0
    again = pickle.loads(pickle.dumps(result))
    assert np.array_equal(again.transformation, result.transformation)
    assert again.alternatives[0].score == result.alternatives[0].score
    assert repr(again) == repr(result) and dict(again.seconds) == dict(result.seconds)
    with pytest.raises(ValueError):
        again.covariance[0, 0] = 2.0


def test_applies_to_points(pair, result):
    placed = result @ pair.source
    assert placed.shape == pair.source.shape
    assert np.allclose(placed, pair.source @ result.transformation[:3, :3].T
                       + result.transformation[:3, 3], atol=1e-12)
    assert np.array_equal(result.apply(pair.source[0]), (result @ pair.source[:1])[0])
    with_normals = result.apply(np.hstack([pair.source, np.tile([0, 0, 1], (4000, 1))]))
    assert np.allclose(np.linalg.norm(with_normals[:, 3:], axis=1), 1)
    with pytest.raises(ValueError, match="N x 3 numbers are needed"):
        result.apply(np.zeros((3, 4)))


def test_same_bits_again_and_on_any_number_of_threads(pair, result):
    for threads in 1, 2:
        again = pcl_kss_icp.register(pair.source, pair.target, threads=threads)
        assert np.array_equal(again.transformation, result.transformation)
    kept = pcl_kss_icp.Registration()
    for _ in range(2):
        again = kept.align(pair.source, pair.target)
        assert np.array_equal(again.transformation, result.transformation)
    assert again.confidence == result.confidence


def test_rigid_keeps_the_scale(rigid_pair):
    result = pcl_kss_icp.register(rigid_pair.source, rigid_pair.target, rigid=True)
    assert result and result.scale == pytest.approx(1.0, abs=1e-12)
    assert result.covariance.shape == (6, 6)
    assert rigid_pair.degrees_off(result) < 0.1


def test_rotation_axis(rigid_pair):
    turn = pose_of(np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), 1.0, (1, 2, 3))
    upright = bumpy_ball(4000, 2) @ turn[:3, :3].T + turn[:3, 3]
    result = pcl_kss_icp.register(rigid_pair.source, upright, rigid=True, rotation_axis="z")
    assert result and degrees_between(result.transformation, turn) < 0.1
    assert np.allclose(result.transformation[2, :3], [0, 0, 1], rtol=0, atol=1e-12)
    assert not result.covariance[:2].any() and not result.covariance[:, :2].any()
    assert np.all(np.diag(result.covariance)[2:] > 0)


def test_parts(rigid_pair):
    cut = rigid_pair.source[rigid_pair.source[:, 0] > -0.3]
    result = pcl_kss_icp.register(cut, rigid_pair.target, rigid=True)
    assert result and result.mode == "partial"
    assert rigid_pair.degrees_off(result) < 0.1


def test_double_precision_far_from_the_origin():
    near, far = Pair(scale=1.0), Pair(scale=1.0)
    far.source = far.source + [4.5e5, 5.4e6, 100.0]
    far.target = far.target + [-7.1e5, 1.2e6, -50.0]
    one = pcl_kss_icp.register(near.source, near.target, rigid=True)
    other = pcl_kss_icp.register(far.source, far.target, rigid=True)
    assert far.degrees_off(other) == pytest.approx(near.degrees_off(one), abs=2e-3)
    placed = other @ far.source - [-7.1e5, 1.2e6, -50.0]
    assert np.abs(placed - (one @ near.source)).max() < 1e-4


def test_guess_competes(pair):
    result = pcl_kss_icp.register(pair.source, pair.target, guess=pair.truth)
    assert result and pair.degrees_off(result) < 0.1
    with pytest.raises(ValueError, match="guess: 4 x 4 numbers"):
        pcl_kss_icp.register(pair.source, pair.target, guess=np.eye(3))
    skewed = np.diag([1.0, 2.0, 1.0, 1.0])
    result = pcl_kss_icp.register(pair.source, pair.target, guess=skewed)
    assert not result and result.cause == "input" and "guess" in result.reason


def test_failures_say_why(pair):
    result = pcl_kss_icp.register(pair.source, np.zeros((0, 3)))
    assert not result and result.cause == "input"
    assert result.reason.startswith("The target cloud determines no pose")
    assert result.alternatives == () and result.overlap == (0.0, 0.0)
    assert result.covariance is None
    assert result.mode is None
    assert np.array_equal(result.transformation, np.eye(4))
    mirrored = pcl_kss_icp.register(pair.source * [-1, 1, 1], pair.target)
    assert mirrored.cause == "no_fit" and "mirror image" in mirrored.reason
    other = pcl_kss_icp.register(pair.source, 2 * pair.target, rigid=True)
    assert other.cause == "no_fit" and "scale" in other.reason
    limited = pcl_kss_icp.register(pair.source, pair.target, time_limit=1e-3)
    assert limited.cause == "stopped" and "time limit" in limited.reason
    absent = pcl_kss_icp.register(pair.source, pair.target, device="no such device")
    assert absent.cause == "device"
    far = np.vstack([pair.source, [[1e9, 0, 0]]])
    assert pcl_kss_icp.register(far, pair.target).far_points == (1, 0)


def test_normals_matter(pair):
    number = 1500  # of a plate, whose sides only normals tell apart
    random = np.random.default_rng(3)

    def plate(points, sign):
        flat = np.column_stack([points[:, 0], 0.4 * points[:, 1] * (1 + points[:, 0]),
                                np.zeros(len(points))])
        return np.hstack([flat, np.tile([0.0, 0.0, sign], (len(points), 1))])

    one, other = (plate(random.random((number, 2)), 1.0) for _ in range(2))
    with_normals = pcl_kss_icp.register(one, other, rigid=True)
    assert with_normals.transformation[2, 2] > 0.99
    turned_over = other.copy()
    turned_over[:, 3:] *= -1
    result = pcl_kss_icp.register(one, turned_over, rigid=True)
    assert result.transformation[2, 2] < -0.99
    apart = pcl_kss_icp.register(one[:, :3], turned_over[:, :3], rigid=True,
                                 source_normals=one[:, 3:],
                                 target_normals=turned_over[:, 3:])
    assert np.array_equal(apart.transformation, result.transformation)


def test_settings_are_those_of_the_table(pair):
    assert pcl_kss_icp.SETTINGS["sample_points"].default == 2000
    for name, setting in pcl_kss_icp.SETTINGS.items():
        pcl_kss_icp.Registration(**{name: setting.default})
        assert name in pcl_kss_icp.register.__doc__
    for wrong, words in [
            ({"threads": -1}, "threads -1: use a whole number, at least 0 threads."),
            ({"threads": True}, "threads True: use a whole number"),
            ({"threads": 1.5}, "threads 1.5: use a whole number"),
            ({"mode": "all"}, "mode 'all': use auto, global, partial, overlap or scene."),
            ({"sample_points": 19}, "sample_points 19: use a whole number, at least 20"),
            ({"confidence": 1.5}, "minimum_confidence 1.5: use a number, 0 to 1"),
            ({"confidence": float("nan")}, "minimum_confidence nan"),
            ({"time_limit": "long"}, "time_limit 'long': use a number"),
            ({"clean": 3}, "clean 3: use True or False"),
            ({"device": 3}, "device 3: use auto, host or a device's name"),
            ({"device": "\udcff"}, r"device '\udcff': use auto, host or a device's name"),
            ({"mode": "\udcff"}, r"mode '\udcff': use auto"),
            ({"scale_range": (2, 1)}, "use a smallest of at least 0"),
            ({"scale_range": 2}, "scale_range 2: use the smallest and the largest"),
            ({"max_iterations": 0}, "max_iterations 0"),
            ({"max_iterations": 1.5}, "max_iterations 1.5"),
            ({"max_iterations": True}, "max_iterations True"),
            ({"samples": 0}, "samples 0"),
            ({"samples": 1.5}, "samples 1.5: use a whole number, at least 1 points")]:
        with pytest.raises(ValueError) as raised:
            pcl_kss_icp.register(pair.source, pair.target, **wrong)
        assert words in str(raised.value)
    with pytest.raises(TypeError, match="no setting 'treads'; there are mode"):
        pcl_kss_icp.register(pair.source, pair.target, treads=2)
    with pytest.raises(TypeError, match=r"no setting '\\udcff'; there are mode"):
        pcl_kss_icp.register(pair.source, pair.target, **{"\udcff": 2})
    with pytest.raises(ValueError, match="estimate_scale is set twice"):
        pcl_kss_icp.register(pair.source, pair.target, rigid=True, estimate_scale=True)


def test_settings_are_heeded(pair):
    result = pcl_kss_icp.register(pair.source, pair.target, scale_range=(1.31, 2.0))
    assert not result or result.scale >= 1.31
    sure = pcl_kss_icp.register(pair.source, pair.target, confidence=1.0)
    assert not sure and sure.cause == "no_fit"
    host = pcl_kss_icp.register(pair.source, pair.target, device="host")
    assert host and host.device == "host"
    moving = pcl_kss_icp.register(pair.source, pair.target, max_iterations=1)
    assert moving.iterations <= 1


def test_different_things_are_refused():
    random = np.random.default_rng(1)
    result = pcl_kss_icp.register(bumpy_ball(2000, 1), random.random((2000, 3)))
    assert not result and result.cause == "no_fit" and result.reason
    assert "converged=False" in repr(result)
