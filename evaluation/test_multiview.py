#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests of multiview.py, and of the scans that it judges poses of.

usage: test_multiview.py PCL_KSS_ICP_VIRTUAL_SCANS
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

import numpy as np

import multiview

PROGRAM = None


def pose(degrees: float, axis: int, translation) -> np.ndarray:
    """A turn about an axis of the frame, then a translation."""
    result = np.eye(4)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = [k for k in range(3) if k != axis]
    result[i, i] = result[j, j] = c
    result[i, j], result[j, i] = -s, s
    result[:3, 3] = translation
    return result


class Judged(unittest.TestCase):
    """Eight scans of a cup and four of a room, found as they are but in frames of their
    own, and what the tests then spoil."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        random = np.random.default_rng(1)
        self.truth, self.found = [], []
        for i in range(12):
            thing, group, radius = ("cup", 0, 0.1) if i < 8 else ("room", 1, 2.0)
            true = pose(40.0 * i, i % 3, random.normal(size=3))
            self.truth.append({"file": f"scan_{i:03}.pcd", "thing": thing, "name": str(i),
                               "centroid": list(random.normal(size=3)), "radius": radius,
                               "transformation": true.tolist()})
            frame = pose(70.0, group, [1.0, 2.0, 3.0])
            self.found.append({"file": f"/somewhere/scan_{i:03}.pcd", "group": group,
                               "transformation": (frame @ true).tolist()})

    def judge(self, pairs=None) -> dict:
        truth, poses = self.folder / "truth.json", self.folder / "poses.json"
        truth.write_text(json.dumps({"scans": self.truth}))
        poses.write_text(json.dumps({"scans": self.found}))
        if pairs is not None:
            (self.folder / "graph.json").write_text(json.dumps({"pairs": pairs}))
        return multiview.judge(poses, truth)

    def move(self, scan: int, motion: np.ndarray):
        """Move a scan about its centroid, in its own frame."""
        to_centroid = np.eye(4)
        to_centroid[:3, 3] = self.truth[scan]["centroid"]
        found = np.array(self.found[scan]["transformation"])
        self.found[scan]["transformation"] = (
            found @ to_centroid @ motion @ np.linalg.inv(to_centroid)).tolist()

    def ends(self, source: int, target: int) -> dict:
        """As graph.json has them, where scans count from 1."""
        return {"source": source + 1, "target": target + 1,
                "source_file": self.found[source]["file"],
                "target_file": self.found[target]["file"]}

    def pair(self, source: int, target: int, verdict: str, motion=np.eye(4)) -> dict:
        true = [np.array(self.truth[i]["transformation"]) for i in (source, target)]
        return {**self.ends(source, target), "verdict": verdict,
                "transformation": (np.linalg.inv(true[1]) @ true[0] @ motion).tolist()}

    def test_all_right(self):
        report = self.judge()
        self.assertEqual((report["right"], report["lost"]), (12, []))
        self.assertEqual([group["thing"] for group in report["groups"]], ["cup", "room"])
        for group in report["groups"]:
            self.assertTrue(group["pure"])
            self.assertLess(group["rotation_deg"]["largest"], 1e-5)
            self.assertLess(group["translation"]["largest"], 1e-7)

    def test_a_lost_scan_does_not_move_the_others(self):
        self.move(2, pose(0.0, 0, [0.3, 0.0, 0.0]))
        report = self.judge()
        self.assertEqual([scan["name"] for scan in report["lost"]], ["2"])
        cup = report["groups"][0]
        self.assertAlmostEqual(cup["translation"]["largest"], 0.3, 4)
        self.assertLess(cup["translation"]["median"], 1e-4)

    def test_a_turned_scan(self):
        self.move(3, pose(20.0, 1, [0.0, 0.0, 0.0]))
        report = self.judge()
        self.assertEqual([scan["name"] for scan in report["lost"]], ["3"])
        self.assertAlmostEqual(report["groups"][0]["rotation_deg"]["largest"], 20.0, 2)

    def test_a_group_that_is_not_pure(self):
        self.found[9]["group"] = 0
        report = self.judge()
        self.assertEqual([group["pure"] for group in report["groups"]], [False, True])
        self.assertEqual([scan["name"] for scan in report["lost"]], ["9"])
        self.assertIn("among scans of cup", report["lost"][0]["why"])

    def test_a_thing_in_two_groups(self):
        for i in (0, 1):
            self.found[i]["group"] = 2
        report = self.judge()
        self.assertEqual((report["right"], len(report["groups"])), (10, 3))
        self.assertIn("apart from most scans", report["lost"][0]["why"])

    def test_drift_is_seen_from_the_first_scan(self):
        for i in range(8):  # each a little farther along x than the truth
            self.truth[i]["centroid"] = [0.0, 0.0, 0.0]
            self.truth[i]["transformation"] = pose(0.0, 0, [float(i), 0.0, 0.0]).tolist()
            self.found[i]["transformation"] = pose(0.0, 0, [1.01 * i, 5.0, 0.0]).tolist()
        group = self.judge()["groups"][0]
        self.assertEqual((group["drift"]["first"], group["drift"]["name"]), ("0", "7"))
        self.assertAlmostEqual(group["drift"]["translation"], 0.07)
        self.assertLess(group["translation"]["largest"], 0.05)  # laid on by all of them

    def test_the_far_end_of_a_loop_need_not_be_the_farthest_scan(self):
        for i in range(8):
            around = pose(45.0 * i, 2, [0.0, 0.0, 0.0])
            self.truth[i]["centroid"] = [1.0, 0.0, 0.0]
            self.truth[i]["transformation"] = around.tolist()
            self.found[i]["transformation"] = (around @ pose(0.1 * i, 2, [0.0] * 3)).tolist()
        far = self.judge()["groups"][0]["drift"]  # the last one, beside the first
        self.assertEqual(far["name"], "7")
        self.assertAlmostEqual(far["rotation_deg"], 0.7)

    def test_scans_in_a_common_frame_need_no_transformation(self):
        for i in range(8, 12):
            room = self.found[8]["transformation"]
            self.found[i]["transformation"] = room
            del self.truth[i]["transformation"]
        self.assertEqual(self.judge()["right"], 12)
        self.found[9]["transformation"] = (pose(90.0, 0, [0.0] * 3) @ room).tolist()
        self.assertEqual(self.judge()["right"], 11)

    def test_a_scan_that_could_not_be_used(self):
        self.found[5].update(group=None, transformation=None)
        report = self.judge([self.pair(5, 6, "failed")])
        self.assertEqual(report["right"], 11)
        self.assertEqual([scan["why"] for scan in report["lost"]], ["it could not be used"])

    def test_kept_pairs(self):
        off = pose(90.0, 2, [0.0, 0.0, 0.0])
        pairs = self.judge([self.pair(0, 1, "kept"), self.pair(1, 2, "kept", off),
                            self.pair(0, 9, "kept"), self.pair(2, 3, "rejected"),
                            self.pair(3, 4, "rejected", off),
                            {**self.ends(4, 5), "verdict": "failed",
                             "transformation": None}])["pairs"]
        self.assertEqual([(pair["source"], pair["target"]) for pair in pairs["kept_wrong"]],
                         [("scan_001.pcd", "scan_002.pcd"), ("scan_000.pcd", "scan_009.pcd")])
        self.assertEqual(pairs["rejected_right"], 1)
        self.assertAlmostEqual(pairs["kept_right_share"], 1.0 / 3.0)
        self.assertEqual(pairs["verdicts"], {"kept": 3, "rejected": 2, "failed": 1})


def read_pcd(path: pathlib.Path) -> np.ndarray:
    """What the program writes: binary, x y z as floats."""
    header, _, data = path.read_bytes().partition(b"DATA binary\n")
    assert b"FIELDS x y z\n" in header and b"SIZE 4 4 4\n" in header, header
    return np.frombuffer(data, np.float32).reshape(-1, 3).astype(float)


def write(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True)


def placed(folder: pathlib.Path) -> dict:
    """The points of each scan where they really are, by thing and name."""
    return {(scan["thing"], scan["name"]): multiview.moved(
        np.array(scan["transformation"]), read_pcd(folder / scan["file"]))
        for scan in json.loads((folder / "truth.json").read_text())["scans"]}


class Scans(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_truth_puts_rooms_into_the_building(self):
        write("building", "--scans", 3, "--out", self.folder)
        scans = placed(self.folder)
        self.assertEqual(len(scans), 3)
        for points in scans.values():
            self.assertGreater(len(points), 50000)
            # floor and ceiling, which no other pose puts there
            self.assertAlmostEqual(points[:, 2].min(), 0.0, delta=0.02)
            self.assertAlmostEqual(points[:, 2].max(), 2.6, delta=0.02)

    def test_scans_are_in_frames_that_tell_nothing(self):
        write("turntable", "--scans", 2, "--out", self.folder)
        for scan in json.loads((self.folder / "truth.json").read_text())["scans"]:
            points = read_pcd(self.folder / scan["file"])
            self.assertTrue(np.allclose(points.mean(0), scan["centroid"], atol=1e-5))
            self.assertGreater(multiview.degrees(np.array(scan["transformation"])[:3, :3]), 1.0)

    def test_moved_scans_are_the_same_and_elsewhere(self):
        before, after = self.folder / "before", self.folder / "after"
        write("loop", "--scans", 3, "--out", before)
        write("moved", before / "truth.json", "--shuffle", "--out", after)
        old, new = placed(before), placed(after)
        self.assertEqual(sorted(old), sorted(new))
        for key in old:
            self.assertTrue(np.allclose(old[key], new[key], atol=1e-3))
        self.assertFalse(np.allclose(read_pcd(before / "scan_000.pcd")[:100],
                                     read_pcd(after / "scan_000.pcd")[:100], atol=0.1))

    def test_lidars_stay_level(self):
        write("loop", "--scans", 2, "--out", self.folder)
        for scan in json.loads((self.folder / "truth.json").read_text())["scans"]:
            self.assertGreater(scan["transformation"][2][2], 0.99)

    def test_a_bag_of_seven_things(self):
        write("bag", "--out", self.folder)
        things = [thing for thing, _ in placed(self.folder)]
        counts = {thing: things.count(thing) for thing in things}
        self.assertEqual(len(counts), 7)
        self.assertTrue(all(4 <= count <= 6 for count in counts.values()), counts)

    def test_the_rooms_of_a_bag_differ_in_size(self):
        write("bag", "--out", self.folder)
        ends = {}
        for (thing, _), points in placed(self.folder).items():
            if thing.startswith("room"):
                ends[thing] = np.maximum(ends.get(thing, 0.0), points.max(0))
        one, other = ends.values()
        self.assertTrue(np.all(np.abs(one - other) > 0.4), ends)

    def test_moved_scans_without_transformation_are_in_the_frame_of_their_thing(self):
        before, after = self.folder / "before", self.folder / "after"
        write("loop", "--scans", 2, "--turn", "none", "--out", before)
        truth = json.loads((before / "truth.json").read_text())
        for scan in truth["scans"]:
            del scan["transformation"]
        (before / "truth.json").write_text(json.dumps(truth))
        write("moved", before / "truth.json", "--out", after)
        new = placed(after)
        for scan in truth["scans"]:
            self.assertTrue(np.allclose(new[scan["thing"], scan["name"]],
                                        read_pcd(before / scan["file"]), atol=1e-3))

    def test_unknown_things_are_named(self):
        done = subprocess.run([PROGRAM, "castle", "--out", str(self.folder)],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn('"castle"', done.stderr)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
