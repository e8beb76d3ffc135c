"""Distances with known answers."""

import pickle

import numpy as np
import pytest

import nurbs_hausdorff as nh


def square(height):
    """The unit square at a height."""
    ctrl = np.array([[[0, 0, height], [0, 1, height]], [[1, 0, height], [1, 1, height]]], float)
    return {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": ctrl}


def test_distance_of_parallel_squares():
    result = nh.distance(square(0.0), square(3.0), symmetric=True)
    assert result.lower <= 3.0 <= result.upper and result.upper - result.lower < 1e-5
    assert result.converged and nh.distance(square(0.0), square(3.0), limit=2.0).within is False


def test_closest_points_and_field():
    found = nh.closest_points(square(0.0), [[0.5, 0.5, 2.0], [2.0, 0.5, 0.0]])
    assert np.all(np.abs(found.distances - [2.0, 1.0]) <= found.bounds + 1e-12)
    assert np.allclose(found.feet, [[0.5, 0.5, 0.0], [1.0, 0.5, 0.0]])
    near = nh.closest_points(square(0.0), [[0.5, 0.5, 2.0], [2.0, 0.5, 0.0]], sign_tolerance=1.5)
    assert np.allclose(near.distances, [2.0, 1.0]) and near.signed[1] == 0 and abs(near.signed[0]) == 2
    assert near.decided_on_gpu == 0
    # With a GPU that is no software, or without.
    anywhere = nh.closest_points(square(0.0), [[0.5, 0.5, 2.0], [2.0, 0.5, 0.0]], backend="auto")
    assert np.all(np.abs(anywhere.distances - [2.0, 1.0]) <= anywhere.bounds + 1e-12)
    field = nh.field(square(0.0), square(3.0), samples=4)
    assert np.allclose(field.flat("distances"), 3.0) and field.parts[0].points.shape == (4, 4, 3)


def test_maps_have_the_deviation_at_each_vertex_within_what_is_known():
    maps = nh.deviation_maps(square(0.0), square(3.0), of="both")
    for found, height in ((maps.a, 0.0), (maps.b, 3.0)):
        assert np.allclose(found.distances, 3.0) and np.all(found.vertices[:, 2] == height)
        assert found.triangles.max() < len(found.vertices) and set(found.faces) == {0}
        assert np.allclose(found.feet[:, 2], 3.0 - height)
        assert np.all(np.abs(found.signed[np.isfinite(found.signed)]) == found.distances[0])
    assert nh.deviation_maps(square(0.0), square(3.0)).b is None
    # Of corners 2 beside the other square, which no bound below that may hide.
    tilted = square(0.0)
    tilted["ctrl"] = tilted["ctrl"] + np.array([[[0.0, 0, 0]], [[0, 0, 2.0]]])
    for known in (nh.diff(tilted, square(0.0)), nh.distance(tilted, square(0.0), symmetric=True)):
        found = nh.deviation_maps(tilted, square(0.0), known=known).a
        upper = known.faces_of_a[0].upper if isinstance(known, nh.DiffResult) else known.forward.upper
        assert 2.0 - 1e-6 < found.distances.max() <= upper


def test_assertion_names_the_faces():
    nh.testing.assert_shapes_close(square(0.0), square(0.0005))
    with pytest.raises(AssertionError, match="actual face 0(.|\n)*expected face 0"):
        nh.testing.assert_shapes_close(square(0.0), square(0.01))


def test_errors_and_pickle():
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.distance(square(0.0), square(1.0), tolerance=-1.0)
    assert pickle.loads(pickle.dumps(raised.value)).code == "OPTION_OUT_OF_RANGE"
    model = pickle.loads(pickle.dumps(nh.model(square(1.0))))
    assert model.bounding_box.tolist() == [[0, 0, 1], [1, 1, 1]]
