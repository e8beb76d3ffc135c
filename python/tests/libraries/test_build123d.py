"""Shapes of build123d, where it is installed: `pip install build123d pytest`.

Its version of OCP is not that of CadQuery: each is in an environment of its own.
"""

import pickle

import pytest

import nurbs_hausdorff as nh
from bored_plate import FAR, RADIUS, SHIFT, SIZE, is_score_of_a_moved_bore, named

b3d = pytest.importorskip("build123d")


def test_a_moved_bore_of_build123d_is_named_on_both_sides():
    def plate(x):
        return b3d.Box(*SIZE) - b3d.Pos(x, 0, 0) * b3d.Cylinder(RADIUS, SIZE[2])

    bored, moved = plate(5), plate(5 + SHIFT)
    nh.testing.assert_shapes_close(bored, plate(5))
    nh.testing.assert_shapes_close(moved, bored, limit=1.01 * SHIFT)
    with pytest.raises(AssertionError) as raised:
        nh.testing.assert_shapes_close(moved, bored, limit=1e-3)
    for part, side in ((moved, "actual"), (bored, "expected")):
        (bore,) = [i for i, face in enumerate(part.faces()) if face.geom_type == b3d.GeomType.CYLINDER]
        assert bore in named(str(raised.value), side)
    result = nh.distance(moved, bored, symmetric=True)
    assert result.lower <= SHIFT <= result.upper


def test_shapes_and_builders_of_build123d_are_read():
    with b3d.BuildPart() as builder:
        b3d.Box(*SIZE)
    for part in (b3d.Box(*SIZE), builder, b3d.Box(*SIZE).wrapped):
        model = nh.model(part)
        lower, upper = model.area
        assert model.face_count == 6 and lower <= 3800 <= upper and upper - lower < 1e-6
    assert pickle.loads(pickle.dumps(model)).kind == "brep"
    # Of different places: the shape's location counts.
    apart = nh.clearance(b3d.Box(1, 1, 1), b3d.Pos(3, 0, 0) * b3d.Box(1, 1, 1))
    assert apart.lower <= 2 <= apart.upper


def test_shapes_of_build123d_are_scored():
    def plate(x):
        return b3d.Box(*SIZE) - b3d.Pos(x, 0, 0) * b3d.Cylinder(RADIUS, SIZE[2])

    assert is_score_of_a_moved_bore(nh.score(plate(5 + FAR), plate(5), thresholds=[0.1]))
