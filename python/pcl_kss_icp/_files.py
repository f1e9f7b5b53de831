# SPDX-License-Identifier: BSD-3-Clause
"""Files by the libraries that read them: what is read is written by the same one, turned,
with all that the library keeps of it."""
from __future__ import annotations

import contextlib
import errno
import importlib
import itertools
import os
import re
import tempfile
from typing import Any, Dict, Iterator, List, Tuple, Type

import numpy as np
from numpy.typing import NDArray

from ._result import Result

Doubles = NDArray[np.float64]


class FileError(Exception):
    """What is wrong with a file, in one sentence that names it."""


def _library(name: str, path: str, package: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError:
        raise FileError(f"{path}: {name} reads such files and is not installed; "
                        f"pip install '{package}' gets it") from None


class File:
    """A cloud or mesh of a file, as its library holds it."""

    extensions: Tuple[str, ...] = ()

    def __init__(self, path: str) -> None:
        """Read."""
        raise NotImplementedError

    def cloud(self) -> Any:
        """What register() takes."""
        raise NotImplementedError

    def write(self, path: str, result: Result) -> None:
        """Write what the result makes of it."""
        raise NotImplementedError


def _unit_length(vectors: Doubles) -> bool:
    """Whether they are normals: nothing else has unit length in every row where it is known,
    and neither zeros nor NaN are."""
    lengths = np.linalg.norm(vectors, axis=1)
    is_known = np.isfinite(lengths) & (lengths > 0.0)
    return bool(is_known.any() and np.all(np.abs(lengths[is_known] - 1.0) <= 0.01))


class Columns(File):
    """Rows of numbers, x, y and z first, by numpy. Three that have unit length in every row,
    unknown ones aside, are normals; the other columns stay. What is written are doubles: at
    the place of the target single precision may have too few digits."""

    def _hold(self, path: str, rows: Any) -> None:
        if rows.ndim != 2 or rows.shape[1] < 3 or rows.dtype.kind not in "fiu":
            raise FileError(f"{path}: holds no rows of at least three numbers, but an array "
                            f"of {rows.dtype} of shape {rows.shape}")
        self._rows = rows
        self._has_normals = rows.shape[1] >= 6 and _unit_length(rows[:, 3:6])

    def cloud(self) -> Any:
        return self._rows[:, :6 if self._has_normals else 3]

    def _turned(self, result: Result) -> Any:
        rows = self._rows.astype(np.result_type(self._rows.dtype, np.float64))
        turned = result @ self.cloud()
        rows[:, :turned.shape[1]] = turned
        return rows


class ArrayFile(Columns):
    extensions = (".npy",)

    def __init__(self, path: str) -> None:
        self._hold(path, np.load(path, allow_pickle=False))

    def write(self, path: str, result: Result) -> None:
        with open(path, "wb") as file:  # np.save() itself would add to other names, as .NPY
            np.save(file, self._turned(result))


def _has_number(line: str) -> bool:
    """Whether a line, comments aside, says a number."""
    for field in re.split(r"[\s,]+", line.partition("#")[0]):
        with contextlib.suppress(ValueError):
            float(field)
            return True
    return False


class TextFile(Columns):
    """A first line without any number is a title, and stays."""

    extensions = (".txt", ".xyz", ".csv", ".asc")

    def __init__(self, path: str) -> None:
        with open(path, encoding="utf-8-sig") as file:
            first = file.readline()
            row = next(filter(_has_number, itertools.chain([first], file)), "")
        self._title = "" if _has_number(first) else first.rstrip("\n")
        self._delimiter = "," if "," in row.partition("#")[0] else None
        self._hold(path, np.loadtxt(path, delimiter=self._delimiter, ndmin=2,
                                    skiprows=1 if self._title else 0, encoding="utf-8-sig"))

    def write(self, path: str, result: Result) -> None:
        np.savetxt(path, self._turned(result), fmt="%.17g", header=self._title, comments="",
                   delimiter=self._delimiter or " ", encoding="utf-8")


class LasFile(File):
    """All that laspy keeps: attributes, and the scales of the coordinates; their offsets, too,
    unless the points no longer lie within reach of them."""

    extensions = (".las", ".laz")
    normals = (("nx", "ny", "nz"), ("NormalX", "NormalY", "NormalZ"),
               ("normal_x", "normal_y", "normal_z"))

    def __init__(self, path: str) -> None:
        laspy = _library("laspy", path, "laspy[lazrs]")
        self._las = laspy.read(path)
        names = set(self._las.point_format.dimension_names)
        self._normals = next((n for n in self.normals if names.issuperset(n)), ())

    def cloud(self) -> Any:
        columns = [self._las.x, self._las.y, self._las.z]
        columns += [self._las[name] for name in self._normals]
        return np.column_stack([np.asarray(column, dtype=np.float64) for column in columns])

    def write(self, path: str, result: Result) -> None:
        turned = result @ self.cloud()
        places = turned[:, :3]
        scales, offsets = self._las.header.scales, self._las.header.offsets
        if len(places) > 0:
            middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
            reach = np.abs(places - offsets).max(axis=0) / scales
            new = np.where(reach < 2**31 - 1, offsets, np.round(middle))
            if np.any(np.abs(places - new).max(axis=0) / scales >= 2**31 - 1):
                raise ValueError("the points lie too far apart for coordinates in steps of "
                                 f"{scales.min():g}")
            self._las.change_scaling(offsets=new)
        self._las.x, self._las.y, self._las.z = places.T
        for name, values in zip(self._normals, turned[:, 3:].T):
            self._las[name] = values
        self._las.write(path)


class E57File(File):
    """Scans in their own frames: only the poses of the frames change, and the coordinates
    where the scale does. pye57 holds no normals, and writes single precision, which suffices
    in the frame of a scan."""

    extensions = (".e57",)
    _places = ("cartesianX", "cartesianY", "cartesianZ")

    def __init__(self, path: str) -> None:
        pye57 = self._pye57 = _library("pye57", path, "pye57")
        with pye57.E57(path) as file:
            self._scans: List[Tuple[Dict[str, Any], Any, Any, Any]] = []
            for i in range(file.scan_count):
                header = file.get_header(i)
                data = file.read_scan_raw(i, ignore_unsupported_fields=True)
                if "cartesianX" not in data:
                    self._make_cartesian(data)
                has_pose = header.has_pose()
                turn = np.asarray(header.rotation if has_pose else [1.0, 0.0, 0.0, 0.0])
                shift = np.asarray(header.translation if has_pose else [0.0, 0.0, 0.0])
                name = (header["name"].value() if header.node.isDefined("name")
                        else f"Scan {i}")
                self._scans.append((data, turn, shift, name))
        if not self._scans:
            raise FileError(f"{path}: holds no points")

    @staticmethod
    def _make_cartesian(data: Dict[str, Any]) -> None:
        far, around, up = (data.pop(f"spherical{name}")
                           for name in ("Range", "Azimuth", "Elevation"))
        data["cartesianX"] = far * np.cos(up) * np.cos(around)
        data["cartesianY"] = far * np.cos(up) * np.sin(around)
        data["cartesianZ"] = far * np.sin(up)
        if "sphericalInvalidState" in data:
            data["cartesianInvalidState"] = data.pop("sphericalInvalidState")

    def _rows(self, data: Dict[str, Any]) -> Doubles:
        rows = np.column_stack([data[name] for name in self._places])
        if "cartesianInvalidState" in data:
            rows[data["cartesianInvalidState"] != 0] = np.nan
        return rows

    def cloud(self) -> Any:
        return np.concatenate([self._rows(data) @ _matrix_of(turn).T + shift
                               for data, turn, shift, _ in self._scans])

    def write(self, path: str, result: Result) -> None:
        linear = result.transformation[:3, :3]
        with self._pye57.E57(path, mode="w") as file:
            for data, turn, shift, name in self._scans:
                # about the middle, which single precision is fine around
                rows = self._rows(data)
                middle = np.nan_to_num(np.nanmean(rows, axis=0))
                local = np.nan_to_num(result.scale * (rows - middle))
                held = {**data, **dict(zip(self._places, local.T.copy()))}
                place = _matrix_of(turn) @ middle + shift
                file.write_scan_raw(held, name=name,
                                    rotation=_quaternion_of(linear / result.scale
                                                            @ _matrix_of(turn)),
                                    translation=result @ place)


def _matrix_of(quaternion: Doubles) -> Doubles:
    """The rotation of a quaternion, its real part first."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def _quaternion_of(rotation: Doubles) -> Doubles:
    """The inverse: the eigenvector of the largest eigenvalue of a symmetric matrix."""
    r = rotation
    k = np.array([
        [np.trace(r), r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
        [0, r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
        [0, 0, r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1]],
        [0, 0, 0, r[2, 2] - r[0, 0] - r[1, 1]]])
    _, vectors = np.linalg.eigh(k, UPLO="U")
    return np.asarray(vectors[:, -1], dtype=np.float64)


class MeshFile(File):
    """Meshes and point clouds by trimesh, with the colours and materials that it keeps; it
    writes coordinates in single precision."""

    extensions = (".ply", ".obj", ".stl", ".off", ".glb")

    def __init__(self, path: str) -> None:
        trimesh = _library("trimesh", path, "trimesh")
        self._held = trimesh.load(path, process=False)

    def cloud(self) -> Any:
        return self._held

    def write(self, path: str, result: Result) -> None:
        turned = self._held.copy()
        turned.apply_transform(result.transformation)
        stem, extension = os.path.splitext(os.path.basename(path))
        # trimesh's own name for it would be that of every mesh in the folder
        materials = {"mtl_name": f"{stem}.mtl"} if extension.lower() == ".obj" else {}
        turned.export(path, **materials)


KINDS: Tuple[Type[File], ...] = (ArrayFile, TextFile, LasFile, E57File, MeshFile)


def kind_of(path: str) -> Type[File]:
    """Who reads and writes a file."""
    extension = os.path.splitext(path)[1].lower()
    for kind in KINDS:
        if extension in kind.extensions:
            return kind
    known = ", ".join(e for kind in KINDS for e in kind.extensions)
    raise FileError(f"{path}: no such format is known; there are {known}")


@contextlib.contextmanager
def _named(path: str) -> Iterator[None]:
    """Whatever a library has to say about a file is said with the file's name."""
    try:
        yield
    except (FileError, MemoryError):
        raise
    except Exception as error:
        # one of the system's names a file by itself, perhaps a temporary one
        said = (error.strerror if isinstance(error, OSError) else None) or error
        raise FileError(f"{path}: {said}") from error


def read(path: str) -> File:
    """Read a file."""
    with _named(path):
        return kind_of(path)(path)


def check_format(source: str, out: str) -> None:
    """Refuse to write what has been read by another library."""
    kind = kind_of(source)
    if kind_of(out) is not kind:
        raise FileError(f"{out}: what comes from {source} is written as "
                        f"{' or '.join(kind.extensions)}")


@contextlib.contextmanager
def written(path: str) -> Iterator[str]:
    """A name to write a file by: it takes its place when all of it has been written, or not
    at all. What is no file, as a pipe, is written as it is."""
    with _named(path):
        if os.path.exists(path) and not os.path.isfile(path):
            yield path
            return
        if os.path.exists(path) and not os.access(path, os.W_OK):
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        # the file that a link leads to is replaced, not the link
        folder, name = os.path.split(os.path.realpath(path))
        with tempfile.TemporaryDirectory(prefix=".pcl_kss_icp.", dir=folder) as part:
            yield os.path.join(part, name)
            beside = set(os.listdir(part)) - {name}  # as the materials of .obj
            for each in (*beside, name):
                os.replace(os.path.join(part, each), os.path.join(folder, each))
