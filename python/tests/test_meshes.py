"""Meshes and points with known answers."""

import io
import pickle
import struct

import numpy as np
import pytest

import nurbs_hausdorff as nh
from square import CORNERS, TRIANGLES, contains, flat, refused


def stl():
    facets = b"".join(
        struct.pack("<12fH", 0, 0, 1, *CORNERS[triangle].ravel(), 0) for triangle in TRIANGLES
    )
    return bytes(80) + struct.pack("<I", len(TRIANGLES)) + facets


def test_meshes_and_points_at_either_side():
    mesh = nh.model((CORNERS, TRIANGLES))
    assert (mesh.kind, mesh.facet_count, mesh.mesh_report.joined_vertices) == ("mesh", 2, 0)
    points = nh.model(np.array([[0, 0, 5], [3, 0, 0]], float))
    assert (points.kind, points.facet_count, points.mesh_report) == ("points", 2, None)
    assert contains(nh.distance(mesh, flat(3.0), symmetric=True), 3.0)
    assert contains(nh.distance(flat(3.0), mesh), 3.0)
    to_mesh = nh.distance(points, mesh)
    assert contains(to_mesh, 5.0)
    assert to_mesh.witness.a.index == 0 and to_mesh.witness.b.triangle in (0, 1)
    assert sum(to_mesh.witness.b.barycentric) == pytest.approx(1.0)
    # From the farthest corner to the nearer point.
    assert contains(nh.distance(mesh, points), np.hypot(4.0, 1.0))
    found = nh.closest_points(mesh, [[0, 0, 2], [2, 0, 0]])
    assert np.allclose(found.distances, [2.0, 1.0])


def test_an_inscribed_polyhedron_has_the_sag_of_its_chords():
    count, radius = 12, 2.0
    angles = 2 * np.pi * np.arange(count) / count
    ring = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    vertices = np.vstack([np.insert(ring, 2, height, axis=1) for height in (0.0, 1.0)])
    here, there = np.arange(count), (np.arange(count) + 1) % count
    triangles = np.vstack(
        [np.stack([here, there, there + count], 1), np.stack([here, there + count, here + count], 1)]
    )
    # The cylinder as four rational quadratic arcs of 90 degrees.
    square = radius * np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]])
    weights = np.where(np.arange(9) % 2, np.sqrt(0.5), 1.0)
    ctrl = np.array([[[x, y, z, w] for z in (0.0, 1.0)] for (x, y), w in zip(square, weights, strict=True)])
    cylinder = {
        "degree": [2, 1],
        "knots_u": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
        "knots_v": [0, 0, 1, 1],
        "ctrl": ctrl,
    }
    sag = radius * (1 - np.cos(np.pi / count))
    mesh = (vertices, triangles)
    assert contains(nh.distance(mesh, cylinder), sag)
    assert contains(nh.distance(cylinder, mesh), sag)


def test_files_of_meshes_are_known_by_their_ending(tmp_path):
    path = tmp_path / "square.stl"
    path.write_bytes(stl())
    named = io.BytesIO(stl())
    named.name = str(path)
    for model in (nh.read(path), nh.read(stl(), format="stl"), nh.read(named)):
        assert (model.kind, model.facet_count) == ("mesh", 2)
        # Corners of an STL file stand in every triangle.
        assert model.mesh_report.joined_vertices == 2
    again = pickle.loads(pickle.dumps(nh.model((CORNERS, TRIANGLES))))
    assert again.facet_count == 2 and "2 triangles" in repr(again)
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.read(b"no mesh", format="stl")
    assert raised.value.code == "MESH_SYNTAX"


def test_wrong_arrays_are_refused():
    for part, code in [
        (np.zeros((3, 2)), "ARGUMENT_INVALID"),
        ((CORNERS, TRIANGLES + 0.5), "ARGUMENT_INVALID"),
        ((CORNERS, TRIANGLES - 1), "TRIANGLE_INDEX"),
        ((CORNERS, TRIANGLES + 2), "TRIANGLE_INDEX"),
        (np.full((1, 3), np.nan), "POINT_OUT_OF_RANGE"),
        (np.zeros((0, 3)), "NO_FACETS"),
    ]:
        with pytest.raises(nh.NurbsHausdorffError) as raised:
            nh.model(part)
        assert raised.value.code == code
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.model((CORNERS, TRIANGLES)).to_json()
    assert raised.value.code == "FACETS_UNSUPPORTED"


def test_meshes_of_trimesh_are_taken():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=2)
    assert nh.model(ball).facet_count == len(ball.faces)
    assert contains(nh.distance(trimesh.PointCloud([[0.0, 0.0, 4.0]]), flat(1.0)), 3.0)


def test_statistics_are_intervals():
    def holds(found, expected):
        return found.lower <= expected <= found.upper

    slope = nh.model((CORNERS + [0, 0, 2] + CORNERS[:, [1, 2, 0]] * [0, 0, 1], TRIANGLES))
    found = nh.statistics(slope, flat(0.0), limit=1.5, percentiles=[0.25])
    assert found.converged and found.over == "area"
    assert holds(found.mean, 2.0) and holds(found.rms, np.sqrt(13 / 3))
    assert holds(found.percentiles[0.25], 1.5) and holds(found.beyond.part, 0.75) and found.beyond.limit == 1.5
    points = np.array([[0, 0, 1], [0.5, 0.5, 2], [1, 1, 6]], float)
    counted = nh.statistics(points, flat(0.0))
    assert counted.over == "count" and holds(counted.mean, 3.0) and counted.beyond is None


def test_arrays_that_would_lose_something_are_refused():
    points = np.zeros((2, 3))
    for part, found in [
        (points + 1j, "complex128"),
        ((CORNERS + 1j, TRIANGLES), "complex128"),
        (np.ma.masked_array(points, mask=[[True, False, False], [False] * 3]), "1 masked"),
        (np.array([["1", "2", "3"]]), "real numbers"),
        (np.array([[2**53 + 1, 0, 0]]), "2**53"),
        ([[0, 0, 0], [1, 0]], "points"),
    ]:
        error = refused(part)
        assert error.code == "ARGUMENT_INVALID" and found in str(error), (part, str(error))
    assert nh.model(np.ma.masked_array(points)).facet_count == 2


def test_points_are_taken_of_anything_with_rows():
    class Rows:
        def __array__(self, dtype=None, copy=None):
            return np.array([[0, 0, 5], [3, 0, 0]])

    for part in (Rows(), [[0, 0, 5], [3, 0, 0]], ((0, 0, 5), (3, 0, 0)), np.array([[0, 0, 5], [3, 0, 0]])):
        model = nh.model(part)
        assert model.kind == "points" and contains(nh.distance(model, flat(1.0)), 4.0)
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"id": [1, 2], "X": [0, 3], "Z": [5.0, 0.0], "Y": [0, 0]})
    assert contains(nh.distance(nh.model(frame), flat(1.0)), 4.0)
    assert "(2, 2)" in str(refused(frame[["X", "Y"]]))


def test_scenes_and_paths_of_trimesh():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=1)
    scene = trimesh.Scene()
    for height in (0.0, 7.0):
        scene.add_geometry(ball, transform=trimesh.transformations.translation_matrix([0, 0, height]))
    model = nh.model(scene)
    assert model.facet_count == 2 * len(ball.faces)
    assert model.bounding_box[1, 2] == pytest.approx(8.0)
    path = trimesh.path.Path3D([trimesh.path.entities.Line([0, 1])], vertices=CORNERS)
    assert "no surface" in str(refused(path))


def test_matrices_off_a_motion_are_refused():
    scaled = np.diag([1 + 9e-6] * 3 + [1.0])
    for matrix, code in [
        (scaled, "TRANSFORM_NOT_RIGID"),
        (np.eye(4) + 0j, "ARGUMENT_INVALID"),
        (np.full((4, 4), np.nan), "TRANSFORM_NOT_RIGID"),
    ]:
        with pytest.raises(nh.NurbsHausdorffError) as raised:
            nh.Transform.from_matrix(matrix)
        assert raised.value.code == code
    assert nh.Transform.from_matrix(scaled, tolerance=1e-5).rotation == pytest.approx((0, 0, 0, 1))
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]
    chain = np.linalg.matrix_power(turn, 50)
    assert np.allclose(nh.Transform.from_matrix(chain).matrix(), chain, rtol=0, atol=1e-13)


def test_buffers_beside_a_gltf_are_read(tmp_path):
    positions = np.array(CORNERS[:3], dtype=np.float32)
    (tmp_path / "a b.bin").write_bytes(positions.tobytes())
    path = tmp_path / "triangle.gltf"
    path.write_text(
        '{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],'
        '"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],'
        '"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "a%20b.bin"}]}'
    )
    model = nh.read(path)
    assert (model.facet_count, model.unit) == (1, 1.0)
    assert pickle.loads(pickle.dumps(model)).facet_count == 1
    (tmp_path / "a b.bin").unlink()
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.read(path)
    assert raised.value.code == "FILE_UNREADABLE"
    assert nh.read(b"OFF\n1 0 0\n1 2 3\n").kind == "points", "known by its content"
