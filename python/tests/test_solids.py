"""Clearances, gaps and fits with known answers."""

import numpy as np
import pytest
from boxes import box

import nurbs_hausdorff as nh


def test_clearance_of_boxes():
    apart = nh.clearance(box((0, 0, 0)), box((2, 3, 0)))
    # Along the diagonal of a gap of 1 by 2.
    assert apart.lower <= np.sqrt(5.0) <= apart.upper and apart.upper - apart.lower < 1e-5
    assert apart.converged and apart.overlap == nh.Overlap("none")
    assert np.linalg.norm(np.subtract(apart.witness.a.point, apart.witness.b.point)) < apart.upper + 1e-9
    for limit, expected in [(2.0, True), (2.5, False)]:
        assert nh.clearance(box((0, 0, 0)), box((2, 3, 0)), limit=limit).at_least is expected
    crossing = nh.clearance(box((0, 0, 0)), box((0.5, 0.5, 0.5)), limit=0.0)
    assert crossing.overlap.kind == "intersecting" and crossing.at_least is False
    assert all(0.5 < coordinate < 1.0 for coordinate in crossing.overlap.inside_both)
    inside = nh.clearance(box((0, 0, 0), (4, 4, 4)), box((1, 1, 1)))
    assert inside.overlap.kind == "contained" and inside.lower <= 1.0 <= inside.upper
    assert "clearance" in inside._repr_html_()
    moved = nh.clearance(box((0, 0, 0)), box((2, 0, 0)), transform=nh.Transform(translation=(0.5, 0, 0)))
    assert moved.lower <= 0.5 <= moved.upper


def test_gaps_list_the_pairs_of_faces():
    found = nh.gaps(box((0, 0, 0)), box((1.25, 0, 0)), below=0.5)
    nearest = found.pairs[0]
    assert found.complete and nearest.lower <= 0.25 <= nearest.upper
    # The face of A that looks at B is near five faces of B, all but the far one. Each of the four
    # beside it is near the one that looks at A, and near three beside that: all but the opposite.
    assert all(pair.lower <= 0.5 for pair in found.pairs) and len(found.pairs) == 5 + 4 * 4
    assert nh.gaps(box((0, 0, 0)), box((1.25, 0, 0)), below=0.2).pairs == ()


class Bar:
    """The interface of tqdm, with a total of its own."""

    total, n, parts = 10.0, 0.0, 0

    def update(self, n):
        assert n >= 0.0
        self.n, self.parts = self.n + n, self.parts + 1


def test_best_fit_finds_a_known_motion():
    turn = nh.Transform.from_matrix(
        [[0.96, -0.28, 0, 0.1], [0.28, 0.96, 0, -0.05], [0, 0, 1, 0.02], [0, 0, 0, 1]]
    )
    body = box((0, 0, 0), (3, 2, 1))
    moved = [
        {**one, "ctrl": one["ctrl"] @ turn.matrix()[:3, :3].T + turn.translation} for one in body
    ]
    bar = Bar()
    fit = nh.best_fit(body, moved, progress=bar)
    assert bar.total == 10.0 and bar.parts >= 1 and abs(bar.n - bar.total) < 1e-9
    assert fit.converged and fit.rms < 1e-8 < fit.rms_before
    assert np.allclose(fit.transform.matrix(), turn.matrix(), atol=1e-7)
    # A box lies on itself in four poses.
    assert len(fit.ambiguous) == 3 and fit.freedoms == 0 and fit.left_out.points.shape == (0, 3)
    assert nh.distance(body, moved, transform=fit.transform, symmetric=True).upper < 1e-5
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.best_fit(body, moved, tolerance=1.0, relative_tolerance=1.0)
    assert raised.value.code == "OPTION_INVALID"


def test_poses_by_hand_and_the_least_zone():
    part, moved = box((0, 0, 0), (3, 2, 1)), box((0, 0, 5), (3, 2, 1))
    corners = np.array([[0, 0, 0], [3, 0, 0], [0, 2, 0]], float)
    pairs = [{"a": one, "b": one + [0, 0, 5]} for one in corners]
    # The first face is the floor, the second a wall beside it, the third the other one.
    datums = [{"a": {"face": {"index": i}}, "b": {"face": {"index": i}}} for i in range(3)]
    for given in ({"pairs": pairs}, {"datums": datums}, {"start": "boxes"}):
        fit = nh.best_fit(part, moved, norm="none", **given)
        assert np.allclose(fit.transform.translation, [0, 0, 5], atol=1e-9)
        assert fit.converged and fit.rms < 1e-9 and fit.zone is None and fit.ambiguous == ()
    assert nh.best_fit(part, moved, norm="none", datums=datums).taken == (3, 2, 1)
    # 0.1 longer: 0.05 at either end.
    longer = box((-0.05, 0, 5), (3.1, 2, 1))
    fit = nh.best_fit(longer, moved, norm="largest", start="given", zone_degrees=0.5, limit=0.04)
    assert fit.zone is not None and fit.zone.lower <= 0.05 <= fit.zone.upper
    assert fit.zone.passes is False and fit.zone.lower > 0.04
    # Points 0.1 before four faces, two by two opposite ones: stock of 0.1, and no more.
    scan = np.array([(-0.1, 1, 5.5), (3.1, 1, 5.5), (1.5, 1, 4.9), (1.5, 1, 6.1)])
    fit = nh.best_fit(scan, moved, norm="inside", start="given", zone_translation=0.1, limit=-0.2)
    assert fit.zone is not None and fit.zone.lower <= -0.1 <= fit.zone.upper
    assert fit.zone.passes is False and fit.zone.upper < -0.09


def test_a_fit_of_chosen_faces_and_within_a_distance():
    part, higher = box((0, 0, 0), (3, 2, 1)), box((0, 0, 0), (3, 2, 1.25))
    tops = [i for i, face in enumerate(higher) if np.min(np.asarray(face["ctrl"])[..., 2]) == 1.25]
    others = [i for i in range(6) if i not in tops]
    whole = nh.best_fit(part, higher, start="given")
    fit = nh.best_fit(part, higher, start="given", faces_of_a=np.array(others))
    assert len(tops) == 1 and whole.rms > 0.01 and fit.rms < 1e-8 and fit.counted == fit.samples
    assert np.allclose(fit.transform.translation, 0, atol=1e-7)
    # The top of the lower box is a quarter below the other, and its samples alone count.
    stays = nh.best_fit(part, higher, norm="none", faces_of_a=tops, faces_of_b=tops)
    assert abs(stays.rms - 0.25) < 0.01 and 0 < stays.counted < stays.samples == 256
    near = nh.best_fit(part, higher, norm="none", max_distance=0.1)
    assert near.rms < 1e-12 and near.counted < near.samples and near.left_out.beyond == 0.1
    assert np.all(near.left_out.points[:, 2] == 1)


def test_sides_of_a_box_and_of_an_open_one():
    closed = nh.model(box((0, 0, 0)))
    solid = closed.solid()
    assert solid.closed and solid.free_edges == ()
    assert [shell.faces for shell in solid.shells] == [(0, 1, 2, 3, 4, 5)]
    points = [(0.5, 0.5, 0.5), (2.0, 0.5, 0.5), (1.0, 0.5, 0.5), (np.nan, 0.0, 0.0)]
    assert closed.sides(points).tolist() == [-1, 1, 0, 0]
    opened = nh.model(box((0, 0, 0))[1:])
    edges = opened.solid().free_edges
    assert not opened.solid().closed and len(edges) == 4
    # The face that is missing lies in z = 0.
    assert {point[2] for edge in edges for point in (edge.start, edge.middle, edge.end)} == {0.0}
    assert opened.sides(points).tolist() == [0, 0, 0, 0]
    with pytest.raises(nh.NurbsHausdorffError, match=r"\(n, 3\)"):
        closed.sides([0.0, 0.0, 0.0])


def test_signed_distances_of_a_box_are_those_of_the_formula():
    part = box((-1, -1, -1), (2.0, 2.0, 2.0))
    for options in ({"resolution": 12}, {"spacing": 0.0625, "band": 0.25, "precision": "float32"}):
        found = nh.signed_distances(part, **options)
        assert found.values.dtype == options.get("precision", "float64") and found.values.ndim == 3
        indices = np.stack(np.indices(found.values.shape), axis=-1)
        excess = np.abs(found.origin + found.spacing * indices) - 1.0
        truth = np.linalg.norm(np.maximum(excess, 0.0), axis=-1) + np.minimum(excess.max(axis=-1), 0.0)
        decided = np.ones(found.values.shape, bool)
        decided[tuple(found.undecided.T)] = False
        within = np.abs(found.values) < found.band
        assert (np.abs(found.values - truth)[within & decided] <= found.bound + 1e-14).all()
        assert (np.abs(truth)[~within] >= found.band - found.bound - 1e-14).all()
        assert ((found.values < 0) == (truth < 0))[decided].all()
    assert found.measured < found.values.size
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.signed_distances(part[:5])
    assert raised.value.code == "NOT_CLOSED"
    with pytest.raises(TypeError):
        nh.signed_distances(part, counts=(2.5, 2, 2))
