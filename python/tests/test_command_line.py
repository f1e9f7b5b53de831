# SPDX-License-Identifier: BSD-3-Clause
"""python -m pcl_kss_icp on files of all kinds that have their library here."""
import json
import subprocess
import sys

import numpy as np
import pytest

import pcl_kss_icp
from conftest import Pair, degrees_between
from pcl_kss_icp.__main__ import main


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "pcl_kss_icp", *map(str, arguments)],
                          capture_output=True, text=True)


@pytest.fixture(scope="module")
def small():
    return Pair(number=1500, scale=1.0)


@pytest.fixture
def files(tmp_path, small):
    np.save(tmp_path / "a.npy", small.source)
    np.save(tmp_path / "b.npy", small.target)
    return tmp_path


def test_writes_all_it_is_asked_for(files, small):
    done = run(files / "a.npy", files / "b.npy", "--rigid", "--out", files / "c.npy",
               "--transform", files / "t.txt", "--report", files / "r.json")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("Transformation of SOURCE onto TARGET:\n")
    assert "Scale:    1\n" in done.stdout
    transformation = np.loadtxt(files / "t.txt")
    assert degrees_between(transformation, small.truth) < 0.2
    report = json.loads((files / "r.json").read_text())
    assert report["converged"] is True and report["alternatives"]
    assert report["inputs"]["source"]["file"] == str(files / "a.npy")
    assert np.array_equal(report["transformation"], transformation)
    expected = small.source @ transformation[:3, :3].T + transformation[:3, 3]
    assert np.allclose(np.load(files / "c.npy"), expected, atol=1e-12)


def test_exit_codes_and_messages(files, small):
    np.save(files / "other.npy", np.random.default_rng(1).random((1500, 3)))
    done = run(files / "a.npy", files / "other.npy", "--out", files / "c.npy",
               "--report", files / "r.json")
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr.startswith("pcl_kss_icp: not registered: ")
    assert not (files / "c.npy").exists()
    report = json.loads((files / "r.json").read_text())
    assert report["converged"] is False and report["cause"] == "no_fit"
    (files / "broken.txt").write_text("1 2 3\n4 5\n")
    (files / "noise.npy").write_bytes(b"noise")
    np.save(files / "two.npy", small.source[:, :2])
    for arguments, words in [
            ((files / "a.npy", files / "none.npy"), "none.npy"),
            ((files / "a.npy", files / "b.pcap"), "no such format is known"),
            ((files / "a.npy", files / "broken.txt"), "broken.txt"),
            ((files / "a.npy", files / "noise.npy"), "noise.npy"),
            ((files / "a.npy", files / "two.npy"), "two.npy: holds no rows of at least three"),
            ((files / "a.npy", files / "b.npy", "--out", files / "c.txt"), "written as .npy"),
            ((files / "a.npy", files / "b.npy", "--out", files / "no/c.npy"), "no folder"),
            ((files / "a.npy", files / "b.npy", "--mode", "all"), "mode 'all': use auto"),
            ((files / "a.npy", files / "b.npy", "--set", "sample_points=3"), "at least 20"),
            ((files / "a.npy", files / "b.npy", "--set", "points"), "there are mode"),
            ((files / "a.npy", files / "b.npy", "--device", "none such"), "none such"),
            ((files / "a.npy", files / "b.npy", "--guess", files / "a.npy"), "a.npy"),
            ((files / "a.npy",), "needs SOURCE and TARGET"),
            ((files / "a.npy", files / "b.npy", "--foo"), "--foo")]:
        done = run(*arguments)
        assert done.returncode == 2, arguments
        assert words in done.stderr and "Traceback" not in done.stderr


def test_missing_libraries_are_named(files, monkeypatch, capsys):
    for name, extension, package in [("laspy", "las", "laspy[lazrs]"),
                                     ("pye57", "e57", "pye57"),
                                     ("trimesh", "ply", "trimesh")]:
        monkeypatch.setitem(sys.modules, name, None)
        path = str(files / f"x.{extension}")
        assert main([path, str(files / "b.npy")]) == 2
        assert capsys.readouterr().err == (
            f"pcl_kss_icp: {path}: {name} reads such files and is not installed; "
            f"pip install '{package}' gets it\n")


def test_settings_by_name(files):
    done = run(files / "a.npy", files / "b.npy", "--set", "estimate_scale=false",
               "--set", "sample_points=500", "--set", "density=paper", "--quiet",
               "--transform", files / "t.txt")
    assert (done.returncode, done.stdout) == (0, "")
    again = run(files / "a.npy", files / "b.npy", "--rigid", "--guess", files / "t.txt")
    assert again.returncode == 0


def test_text_keeps_its_columns_and_its_title(files, small):
    more = np.arange(1500.0)[:, None]
    np.savetxt(files / "a.csv", np.hstack([small.source, more]), delimiter=",",
               header="x,y,z,time", comments="", fmt="%.17g")
    np.savetxt(files / "b.txt", small.target, fmt="%.17g")
    done = run(files / "a.csv", files / "b.txt", "--rigid", "--out", files / "c.csv")
    assert done.returncode == 0, done.stderr
    assert (files / "c.csv").read_text().startswith("x,y,z,time\n")
    rows = np.loadtxt(files / "c.csv", delimiter=",", skiprows=1)
    assert np.array_equal(rows[:, 3:], more)
    expected = np.linalg.norm(rows[:, :3] - (small.source @ small.truth[:3, :3].T
                                             + small.truth[:3, 3]), axis=1)
    assert expected.max() < 0.02


def test_normals_are_turned(files, small):
    normals = small.source / np.linalg.norm(small.source, axis=1, keepdims=True)
    np.save(files / "a.npy", np.hstack([small.source, normals]).astype(np.float32))
    done = run(files / "a.npy", files / "b.npy", "--rigid", "--out", files / "c.npy",
               "--transform", files / "t.txt")
    assert done.returncode == 0, done.stderr
    rows = np.load(files / "c.npy")
    assert rows.dtype == np.float32
    rotation = np.loadtxt(files / "t.txt")[:3, :3]
    assert np.allclose(rows[:, 3:], normals @ rotation.T, atol=1e-5)


def las_of(laspy, points, path, offsets):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 1e-4), np.array(offsets, dtype=float)
    header.add_extra_dim(laspy.ExtraBytesParams(name="reflectance", type=np.float32))
    las = laspy.LasData(header)
    las.x, las.y, las.z = points.T
    las.intensity = np.arange(len(points)) % 65536
    las.gps_time = np.linspace(0, 1, len(points))
    las.reflectance = np.linspace(-1, 0, len(points))
    las.classification = np.arange(len(points)) % 7
    las.write(path)


@pytest.mark.parametrize("extension", ["las", "laz"])
def test_las_keeps_attributes_and_is_exact_far_away(files, small, extension):
    laspy = pytest.importorskip("laspy")
    if extension == "laz":
        pytest.importorskip("lazrs")
    here, there = np.array([691000.0, 5335000.0, 500.0]), np.array([452000.0, 5411000.0, 100.0])
    las_of(laspy, small.source + here, files / f"a.{extension}", here)
    las_of(laspy, small.target + there, files / "b.las", there)
    done = run(files / f"a.{extension}", files / "b.las", "--rigid",
               "--out", files / f"c.{extension}", "--transform", files / "t.txt")
    assert done.returncode == 0, done.stderr
    before, after = (laspy.read(files / f"{name}.{extension}") for name in "ac")
    for name in ("intensity", "gps_time", "reflectance", "classification"):
        assert np.array_equal(before[name], after[name]), name
    assert np.array_equal(after.header.scales, before.header.scales)
    assert after.header.point_format == before.header.point_format
    pose = np.loadtxt(files / "t.txt")
    expected = before.xyz @ pose[:3, :3].T + pose[:3, 3]
    # half a step, and the digits that doubles have left there
    assert np.abs(after.xyz - expected).max() < 0.6e-4
    truth = (small.source @ small.truth[:3, :3].T + small.truth[:3, 3]) + there
    assert np.abs(after.xyz - truth).max() < 0.02
    assert np.allclose(after.header.maxs, after.xyz.max(axis=0), atol=1e-3)
    # what lies within reach of its offsets keeps them
    las_of(laspy, small.target + here, files / "near.las", here)
    done = run(files / f"a.{extension}", files / "near.las", "--rigid",
               "--out", files / f"d.{extension}")
    assert done.returncode == 0, done.stderr
    assert np.array_equal(laspy.read(files / f"d.{extension}").header.offsets, here)


def test_e57_keeps_attributes(files, small):
    pye57 = pytest.importorskip("pye57")
    colours = {f"color{name}": np.arange(1500, dtype=np.uint8) % 251
               for name in ("Red", "Green", "Blue")}
    half = 750
    quaternion = np.array([0.5, 0.5, 0.5, 0.5])  # x to y to z to x
    own = np.roll(small.source[half:] - [10, 20, 30], -1, axis=1)
    with pye57.E57(str(files / "a.e57"), mode="w") as file:
        for rows, part, pose in [
                (small.source[:half], slice(half), {}),
                (own, slice(half, None), {"rotation": quaternion,
                                          "translation": np.array([10.0, 20, 30])})]:
            data = {f"cartesian{axis}": rows[:, i].copy() for i, axis in enumerate("XYZ")}
            data["intensity"] = np.linspace(0, 1, half)
            data.update((name, values[part]) for name, values in colours.items())
            file.write_scan_raw(data, name=f"scan at {len(file.data3d)}", **pose)
    done = run(files / "a.e57", files / "b.npy", "--out", files / "c.e57", "--transform",
               files / "t.txt")
    assert done.returncode == 0, done.stderr
    pose = np.loadtxt(files / "t.txt")
    assert degrees_between(pose, small.truth) < 0.2
    with pye57.E57(str(files / "c.e57")) as file:
        scans = [file.read_scan(i, intensity=True, colors=True, ignore_missing_fields=True)
                 for i in range(file.scan_count)]
        names = [file.get_header(i)["name"].value() for i in range(file.scan_count)]
    assert names == ["scan at 0", "scan at 1"]
    placed = np.concatenate([np.column_stack([scan[f"cartesian{axis}"] for axis in "XYZ"])
                             for scan in scans])
    assert np.allclose(placed, small.source @ pose[:3, :3].T + pose[:3, 3], atol=1e-5)
    for name, values in colours.items():
        assert np.array_equal(np.concatenate([scan[name] for scan in scans]), values)
    assert np.allclose(scans[1]["intensity"], np.linspace(0, 1, half), atol=1e-6)


@pytest.mark.parametrize("extension", ["ply", "obj", "stl", "off", "glb"])
def test_meshes_by_trimesh(files, extension):
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.util.concatenate([
        trimesh.creation.box((2, 1, 0.5)),
        trimesh.creation.box((0.4, 0.4, 2), trimesh.transformations.translation_matrix(
            [0.7, 0.2, 0.9])),
        trimesh.creation.icosphere(radius=0.4).apply_translation([-0.8, 0.3, 0.5])])
    truth = Pair(scale=1.0).truth
    mesh.export(files / f"a.{extension}")
    np.save(files / "b.npy", trimesh.sample.sample_surface(
        mesh.copy().apply_transform(truth), 4000, seed=1)[0])
    done = run(files / f"a.{extension}", files / "b.npy", "--rigid", "--out",
               files / f"c.{extension}", "--transform", files / "t.txt")
    assert done.returncode == 0, done.stderr
    pose = np.loadtxt(files / "t.txt")
    assert degrees_between(pose, truth) < 1.0
    placed = trimesh.load(files / f"c.{extension}", process=False)
    whole = placed.to_geometry() if hasattr(placed, "to_geometry") else placed
    assert len(whole.faces) == len(mesh.faces)
    expected = mesh.copy().apply_transform(pose)
    assert np.allclose(whole.bounds, expected.bounds, atol=1e-4)


def test_points_by_trimesh_keep_colours(files, small):
    trimesh = pytest.importorskip("trimesh")
    colours = np.column_stack([np.arange(1500) % 256] * 3 + [np.full(1500, 255)])
    trimesh.PointCloud(small.source, colors=colours.astype(np.uint8)).export(files / "a.ply")
    done = run(files / "a.ply", files / "b.npy", "--rigid", "--out", files / "c.ply")
    assert done.returncode == 0, done.stderr
    placed = trimesh.load(files / "c.ply", process=False)
    assert np.array_equal(placed.colors[:, :3], colours[:, :3])
    assert len(placed.vertices) == 1500


def test_version_and_devices():
    assert run("--version").stdout == f"pcl_kss_icp {pcl_kss_icp.__version__}\n"
    assert run("--list-devices").stdout.split("\n")[:-1] == (pcl_kss_icp.device_names() or [""])
