# SPDX-License-Identifier: BSD-3-Clause
"""Clouds in all the forms in which they come."""
from types import SimpleNamespace

import numpy as np
import pytest

import pcl_kss_icp
from pcl_kss_icp._clouds import cloud_of
from pcl_kss_icp._meshes import _is_closed, sampled

SAMPLES = 500


def test_all_arrays_give_the_same(pair):
    rows = pair.source[:600].astype(np.float32)
    target = pair.target[:600]
    expected = pcl_kss_icp.register(rows, target).transformation
    wide = np.zeros((600, 9), dtype=np.float32)
    wide[:, 2:5] = rows
    every_other = np.zeros((1200, 3))
    every_other[::2] = rows
    for form in (rows.astype(np.float64), rows.tolist(), np.asfortranarray(rows),
                 wide[:, 2:5], every_other[::2], rows[::-1][::-1], rows.astype(">f4"),
                 [tuple(row) for row in rows]):
        assert np.array_equal(expected, pcl_kss_icp.register(form, target).transformation)


def test_integers_are_numbers():
    points, _ = cloud_of(np.arange(12, dtype=np.uint8).reshape(4, 3), None, "source", SAMPLES)
    assert points.dtype == np.float64 and points[3, 2] == 11.0


@pytest.mark.parametrize("wrong, words", [
    (np.zeros((3, 5)), "source: N x 3 numbers are needed, or N x 6 with normals, not an "
                       "array of shape (3, 5)"),
    (np.zeros((3, 4)), "shape (3, 4)"),
    (np.zeros(3), "shape (3,)"),
    (np.zeros((2, 3, 3)), "shape (2, 3, 3)"),
    (np.float64(3), "source: an array of real numbers is needed"),
    ("points.ply", "source: an array of real numbers is needed"),
    (None, "source: an array of real numbers is needed"),
    ([[1, 2, 3], [1, 2]], "source: an array of real numbers is needed"),
    (np.zeros((3, 3), dtype=complex), "source: an array of real numbers is needed"),
    (object(), "source: an array of real numbers is needed"),
    (np.full((3, 3), "1"), "source: an array of real numbers is needed"),
    (np.full((3, 3), "1", dtype=object), "elements of type str"),
    (np.full((3, 3), True, dtype=object), "elements of type bool")])
def test_wrong_shapes_are_named(pair, wrong, words):
    with pytest.raises(ValueError) as raised:
        pcl_kss_icp.register(wrong, pair.target)
    assert words in str(raised.value) and "\n" not in str(raised.value)


def test_what_is_masked_is_left_out(pair):
    for kind in np.float32, np.int16:
        rows = np.ma.masked_equal(np.arange(12, dtype=kind).reshape(4, 3), 7)
        points, _ = cloud_of(rows, None, "source", SAMPLES)
        assert type(points) is np.ndarray
        assert np.isnan(points[2, 1]) and np.isfinite(points).sum() == 11
    far = np.ma.masked_greater(np.vstack([pair.source, [[1e9, 0, 0]]]), 1e6)
    assert pcl_kss_icp.register(far, pair.target).far_points == (0, 0)
    masked = np.ma.array(pair.source, mask=True)
    assert pcl_kss_icp.register(masked, pair.target).cause == "input"


def test_normals_need_as_many_as_points(pair):
    with pytest.raises(ValueError, match="source_normals: 4000 points need as many normals, "
                                         "not 3999"):
        pcl_kss_icp.register(pair.source, pair.target, source_normals=pair.source[1:])
    with pytest.raises(ValueError, match=r"target_normals: N x 3 numbers are needed"):
        pcl_kss_icp.register(pair.source, pair.target, target_normals=pair.source[:, :2])


def test_six_columns_have_normals():
    rows = np.arange(24.0).reshape(4, 6)
    points, normals = cloud_of(rows, None, "source", SAMPLES)
    assert np.array_equal(points, rows[:, :3]) and np.array_equal(normals, rows[:, 3:])
    points, normals = cloud_of(rows, rows[:, :3], "source", SAMPLES)
    assert np.array_equal(normals, rows[:, :3])  # those that are named go first
    assert points.flags.c_contiguous and normals.flags.c_contiguous


# As Open3D and trimesh have them; none of the two is needed.

def tetrahedron():
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    return corners, faces


class Tensor:
    def __init__(self, array):
        self.array = array

    def cpu(self):
        return self

    def numpy(self):
        return self.array

    def __len__(self):
        return len(self.array)


def test_open3d_clouds():
    rows = np.arange(12.0).reshape(4, 3)
    bare = SimpleNamespace(points=rows, normals=np.zeros((0, 3)), colors=[])
    points, normals = cloud_of(bare, None, "source", SAMPLES)
    assert np.array_equal(points, rows) and len(normals) == 0
    bare.normals = rows[::-1]
    assert np.array_equal(cloud_of(bare, None, "source", SAMPLES)[1], rows[::-1])
    tensors = SimpleNamespace(point={"positions": Tensor(rows.astype(np.float32))})
    assert np.array_equal(cloud_of(tensors, None, "source", SAMPLES)[0], rows)
    tensors.point["normals"] = Tensor(rows[::-1])
    assert np.array_equal(cloud_of(tensors, None, "source", SAMPLES)[1], rows[::-1])


class GradientTensor(Tensor):
    def numpy(self):
        raise RuntimeError("Can't call numpy() on Tensor that requires grad.")


def test_tensors_that_give_no_array_are_named(pair):
    with pytest.raises(ValueError, match="target: an array of real .* requires grad"):
        pcl_kss_icp.register(pair.source, GradientTensor(pair.target))


def test_trimesh_clouds():
    rows = np.arange(12.0).reshape(4, 3)
    assert np.array_equal(cloud_of(SimpleNamespace(vertices=rows), None, "source", SAMPLES)[0],
                          rows)


def test_meshes_are_sampled():
    corners, faces = tetrahedron()
    meshes = [SimpleNamespace(vertices=corners, faces=faces),
              SimpleNamespace(vertices=corners, triangles=faces, vertex_normals=[]),
              SimpleNamespace(vertex={"positions": Tensor(corners)},
                              triangle={"indices": Tensor(faces)})]
    expected = sampled(corners, faces, SAMPLES)
    for mesh in meshes:
        points, normals = cloud_of(mesh, None, "source", SAMPLES)
        assert points.shape == normals.shape == (SAMPLES, 3)
        assert np.array_equal(points, expected[0])
        assert np.allclose(normals, expected[1], atol=1e-7)


def test_scenes_of_all_versions():
    corners, faces = tetrahedron()
    mesh = SimpleNamespace(vertices=corners, faces=faces)
    expected, _ = cloud_of(mesh, None, "source", SAMPLES)
    for scene in (SimpleNamespace(geometry={"it": mesh}, to_geometry=lambda: mesh),
                  SimpleNamespace(geometry={"it": mesh}, dump=lambda concatenate: mesh)):
        assert np.array_equal(cloud_of(scene, None, "source", SAMPLES)[0], expected)


def test_real_trimesh(pair):
    trimesh = pytest.importorskip("trimesh")
    points, normals = cloud_of(trimesh.creation.box(), None, "source", SAMPLES)
    assert np.allclose(np.abs(points).max(axis=1), 0.5)
    assert np.all(np.einsum("ij,ij->i", points, normals) > 0.49)
    scene = trimesh.Scene([trimesh.creation.box()])
    assert np.array_equal(cloud_of(scene, None, "source", SAMPLES)[0], points)
    cloud = trimesh.PointCloud(pair.source)
    assert np.array_equal(cloud_of(cloud, None, "source", SAMPLES)[0], pair.source)


def test_samples_are_even_and_normals_point_outwards():
    corners, faces = tetrahedron()
    points, normals = sampled(corners, faces, 20000)
    on = [np.isclose(points[:, i], 0.0) for i in (2, 1, 0)]
    on.append(np.isclose(points.sum(axis=1), 1.0))
    assert np.all(np.sum(on, axis=0) >= 1)
    share = np.array([side.mean() for side in on])
    assert np.allclose(share, np.array([0.5, 0.5, 0.5, np.sqrt(3) / 2]) / (1.5 + np.sqrt(.75)),
                       atol=0.02)
    assert np.allclose(points[on[0]].mean(axis=0), [1 / 3, 1 / 3, 0], atol=0.02)
    inside = np.full(3, 0.1)
    assert np.all(np.einsum("ij,ij->i", points - inside, normals) > 0)
    # wound inside out, and as a soup of triangles
    for wound in faces[:, ::-1], faces:
        soup = corners[wound].reshape(-1, 3)
        turned, out = sampled(soup, np.arange(12).reshape(4, 3), SAMPLES)
        assert np.all(np.einsum("ij,ij->i", turned - inside, out) > 0)
    assert np.array_equal(sampled(corners, faces, 100)[0], sampled(corners, faces, 100)[0])


def test_what_is_closed():
    _, faces = tetrahedron()
    assert _is_closed(faces) and _is_closed(faces[:, ::-1])
    assert not _is_closed(faces[1:])
    assert not _is_closed(np.vstack([faces, faces]))
    disagreeing = faces.copy()
    disagreeing[2] = disagreeing[2, ::-1]
    assert not _is_closed(disagreeing)


def test_faces_without_area_and_wrong_ones():
    corners, faces = tetrahedron()
    points, normals = sampled(corners, np.array([[0, 0, 1]]), SAMPLES)
    assert np.array_equal(points, corners) and normals is None
    with pytest.raises(ValueError, match="has faces that name others"):
        sampled(corners, faces + 1, SAMPLES)
    with pytest.raises(ValueError, match="N x 3 vertices and M x 3 faces"):
        sampled(corners, faces[:, :2], SAMPLES)
