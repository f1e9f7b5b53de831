# SPDX-License-Identifier: BSD-3-Clause
"""python -m pcl_kss_icp on files of all kinds that have their library here."""
import errno
import json
import os
import stat
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import pcl_kss_icp
from conftest import Pair, degrees_between
from pcl_kss_icp import __main__ as command_line
from pcl_kss_icp.__main__ import main
from pcl_kss_icp._files import FileError, read, written


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "pcl_kss_icp", *map(os.fspath, arguments)],
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
            ((files / "a.npy", files / "b.npy", "--confidence", "2"), "0 to 1"),
            ((files / "a.npy", files / "b.npy", "--device", b"\xff"), "device '"),
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
    rotation = np.loadtxt(files / "t.txt")[:3, :3]
    assert np.allclose(rows[:, 3:], normals @ rotation.T, atol=1e-5)
    # unknown ones, too
    rows = np.load(files / "a.npy")
    rows[7, 3:], rows[8, 3:] = 0.0, np.nan
    np.save(files / "a.npy", rows)
    done = run(files / "a.npy", files / "b.npy", "--rigid", "--out", files / "c.npy")
    assert done.returncode == 0, done.stderr
    known = np.delete(np.load(files / "c.npy"), [7, 8], axis=0)[:, 3:]
    assert np.allclose(known, np.delete(normals, [7, 8], axis=0) @ rotation.T, atol=1e-3)


@pytest.mark.parametrize("kind", [np.float16, np.float32])
def test_what_is_written_is_exact_far_away(files, small, kind):
    there = np.array([691000.0, 5335000.0, 500.0])
    np.save(files / "a.npy", small.source.astype(kind))
    np.save(files / "b.npy", small.target + there)
    done = run(files / "a.npy", files / "b.npy", "--rigid", "--out", files / "c.npy",
               "--transform", files / "t.txt")
    assert done.returncode == 0, done.stderr
    pose = np.loadtxt(files / "t.txt")
    placed = np.load(files / "a.npy").astype(float) @ pose[:3, :3].T + pose[:3, 3]
    assert np.allclose(np.load(files / "c.npy"), placed, rtol=0, atol=1e-8)


@pytest.mark.parametrize("before, delimiter, after", [
    ("", " ", ""), ("\ufeff", " ", ""), ("", " ", " # first"),
    ("# of a scan, turned\n", " ", ""), ("\ufeffx,y,z\n", ",", ""), ("\u00b5m\n\n", ",", ""), ("\n", " ", "")])
def test_text_keeps_its_first_point(files, small, before, delimiter, after):
    first, *others = [delimiter.join(map(repr, row)) for row in small.source.tolist()]
    text = before + "\n".join([first + after, *others])
    (files / "a.txt").write_text(text, encoding="utf-8")
    done = run(files / "a.txt", files / "b.npy", "--rigid", "--out", files / "c.txt",
               "--transform", files / "t.txt")
    assert done.returncode == 0, done.stderr
    title = before.strip("\ufeff").split("\n")[0]
    text = (files / "c.txt").read_text(encoding="utf-8")
    assert text.startswith(f"{title}\n") if title else text[0] in "-0123456789"
    pose = np.loadtxt(files / "t.txt")
    rows = np.loadtxt(text.splitlines()[1 if title else 0:],
                      delimiter=delimiter.strip() or None)
    assert np.allclose(rows, small.source @ pose[:3, :3].T + pose[:3, 3], atol=1e-9)


def test_first_lines_that_are_neither_title_nor_row_are_refused(files, small):
    np.savetxt(files / "a.txt", small.source, header="1500 points", comments="")
    done = run(files / "a.txt", files / "b.npy")
    assert done.returncode == 2 and done.stderr.startswith(f"pcl_kss_icp: {files / 'a.txt'}: ")


def test_files_take_their_place_at_once(files, small):
    (files / "c.part.npy").write_text("the user's")
    (files / "real.txt").write_text("before")
    (files / "t.txt").symlink_to("real.txt")
    outputs = ("--out", files / "c.NPY", "--transform", files / "t.txt", "--report",
               files / "r.json")
    assert run(files / "a.npy", files / "b.npy", "--rigid", *outputs).returncode == 0
    assert (files / "c.part.npy").read_text() == "the user's"
    assert sorted(os.listdir(files)) == ["a.npy", "b.npy", "c.NPY", "c.part.npy", "r.json",
                                         "real.txt", "t.txt"]
    assert (files / "t.txt").is_symlink() and np.loadtxt(files / "real.txt").shape == (4, 4)
    (files / "new").touch()
    assert {stat.S_IMODE((files / name).stat().st_mode) for name in (
        "c.NPY", "r.json", "real.txt")} == {stat.S_IMODE((files / "new").stat().st_mode)}
    # what is no file is written to
    done = run(files / "a.npy", files / "b.npy", "--quiet", "--transform", "/dev/stdout")
    assert (done.returncode, len(done.stdout.split())) == (0, 16)


def test_what_cannot_be_written_changes_nothing(files):
    path = files / "x.txt"
    path.write_text("before")
    with pytest.raises(FileError, match="x.txt: No space left on device$"):
        with written(str(path)) as part:
            with open(part, "w") as file:
                file.write("half")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), part)
    assert path.read_text() == "before" and "x.txt" in os.listdir(files)
    assert len(os.listdir(files)) == 3
    with pytest.raises(FileError, match="Is a directory"):
        with written(str(files)) as part, open(part, "w"):
            pass


def test_options(files, capsys):
    seen = {}

    def register(*_, **settings):
        seen.update(settings)
        raise RuntimeError("of a driver\n")

    def settings_of(*options):
        seen.clear()
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(command_line, "register", register)
            assert main([*options, str(files / "a.npy"), str(files / "b.npy")]) == 2
        # not 1, which would say that the clouds do not fit
        assert capsys.readouterr().err == "pcl_kss_icp: RuntimeError: of a driver \n"
        return {key: value for key, value in seen.items()
                if (key, value) not in {"guess": None, "samples": 10000,
                                        "max_iterations": 300}.items()}

    assert settings_of() == {}
    assert settings_of("--confidence", "0") == {"confidence": 0.0}
    assert settings_of("--time-limit", "0", "--rigid") == {"time_limit": 0.0, "rigid": True}
    assert settings_of("--upright", "--quiet") == {"rotation_axis": "z"}
    assert settings_of("--upright", "y") == {"rotation_axis": "y"}
    assert settings_of("--upright") == {"rotation_axis": "z"}  # files follow
    for name in "--max-iterations", "--iterations":
        assert settings_of(name, "7") == {"max_iterations": 7}
    assert "--iterations" not in run("--help").stdout.split()


def test_options_may_stand_anywhere(files):
    for options in (["--rigid", files / "a.npy", "--quiet", files / "b.npy"],
                    [files / "a.npy", files / "b.npy", "--quiet", "--upright"]):
        done = run(*options)
        assert done.returncode < 2 and "usage" not in done.stderr, done.stderr


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


def test_materials_have_the_name_of_their_mesh(files):
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("PIL")  # which trimesh needs for them
    (files / "a.mtl").write_text("newmtl red\nKd 1 0 0\n")
    (files / "a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\n"
        "f 1/1 2/2 3/3\n")
    (files / "material.mtl").write_text("the user's")
    with written(str(files / "c.obj")) as part:
        read(str(files / "a.obj")).write(part, SimpleNamespace(transformation=np.eye(4)))
    assert (files / "material.mtl").read_text() == "the user's"
    assert "mtllib c.mtl" in (files / "c.obj").read_text()
    colours = trimesh.load(files / "c.obj").visual.material.diffuse
    assert np.array_equal(colours[:3], [255, 0, 0])


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
