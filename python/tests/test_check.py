"""Assemblies of boxes, and a shaft in a bore: pairs of bodies with known answers."""

import math
import threading

import numpy as np
import pytest
from boxes import box

import nurbs_hausdorff as nh

TILT = nh.Transform.from_matrix(
    [[0.96, -0.28, 0, 3], [0.28, 0.96, 0, -2], [0, 0, 1, 0.5], [0, 0, 0, 1]]
)


def named(name, faces):
    return [{**face, "part": f"{name} / face {index}"} for index, face in enumerate(faces)]


def assembly(**parts):
    return {"surfaces": [face for name, faces in parts.items() for face in named(name, faces)]}


def holds(found, expected):
    return found.lower <= expected <= found.upper


def ruled(*circles):
    """A face between two circles of (radius, height), of quarters of degree 2."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    weights = [1.0 if index % 2 == 0 else math.sqrt(0.5) for index in range(9)]
    turn = TILT.matrix()

    def row(radius, height):
        points = [turn @ (radius * x, radius * y, height, 1.0) for x, y in corners]
        return [[*point[:3], weight] for point, weight in zip(points, weights, strict=True)]

    knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
    ctrl = np.array([row(*circle) for circle in circles])
    return {"degree": [1, 2], "knots_u": [0, 0, 1, 1], "knots_v": knots, "ctrl": ctrl}


def turned(*profile):
    """The body that a closed profile of (radius, height) sweeps about a tilted axis."""
    return [ruled(one, other) for one, other in zip(profile, [*profile[1:], profile[0]], strict=True)]


def shaft_in_bore(radius):
    """A shaft with a bore of 0.25 along it, in a ring with a bore of 1."""
    shaft = turned((0.25, -1.5), (0.25, 2.5), (radius, 2.5), (radius, -1.5))
    return assembly(housing=turned((1, 0), (1, 1), (2, 1), (2, 0)), shaft=shaft)


def test_boxes_clash_touch_and_come_near():
    found = nh.check(
        assembly(
            shaft=box((0, 0, 0)),
            hub=box((0.5, 0.25, 0.25), (1.5, 1.75, 1.75)),
            lid=box((0, 0, 2), (1, 1, 1)),
        ),
        below=1.5,
    )
    assert found.clean is False and found.pair_count == 3
    assert [(pair.a, pair.b, pair.state) for pair in found.pairs] == [
        ("shaft", "hub", "clash"), ("hub", "lid", "touching"), ("shaft", "lid", "near"),
    ]  # fmt: skip
    clash, _, near = found.pairs
    assert holds(clash.volume, 0.5 * 0.75 * 0.75) and holds(clash.depth, 0.5)
    assert clash.clearance == nh.Interval(0.0, 0.0)
    assert all(low < x < 1.0 for x, low in zip(clash.point, (0.5, 0.25, 0.25), strict=True))
    assert holds(near.clearance, 1.0) and near.clearance.width < 1e-5 and near.volume is None
    assert [(body.name, body.model, body.kind) for body in found.bodies] == [
        ("shaft", 0, "solid"), ("hub", 0, "solid"), ("lid", 0, "solid"),
    ]  # fmt: skip
    assert "shaft and hub" in found._repr_html_() and found.in_state("near") == (near,)


def test_models_are_checked_where_they_stand_by_rules(tmp_path):
    shaft, hub = box((0, 0, 0)), box((1.25, 0, 0))
    path = tmp_path / "hub.json"
    path.write_text(nh.model(hub).to_json())
    assert [body.name for body in nh.check(shaft, path).bodies] == ["model 1 / body 1", "hub / body 1"]
    for distance, clean in ((0.2, True), (0.3, False)):
        rules = {"at_least": [{"a": "pump/*", "b": "hub/*", "distance": distance}]}
        found = nh.check(shaft, path, names=["pump", "hub"], rules=rules)
        assert found.clean is clean and len(found.rules) == (not clean)
    rule = found.rules[0]
    assert rule.rule == "atLeast" and rule.broken and rule.distance == 0.3 and holds(rule.clearance, 0.25)
    same = nh.check(shaft, shaft, rules={"intended": [{"a": "**", "b": "**"}]})
    assert same.clean and same.pairs[0].state == "clash" and same.pairs[0].intended
    assert same.bodies[0].duplicates == (same.bodies[1].name,)
    refused = [
        {"rules": {"mustTouch": [{"a": "lid", "b": "**"}]}}, {"rules": {"most": []}}, {"below": -1.0},
        {"names": ["one"]}, {"max_seconds": 0.0},
    ]  # fmt: skip
    for options in refused:
        with pytest.raises(nh.NurbsHausdorffError):
            nh.check(shaft, hub, **options)


def test_a_shaft_in_a_bore_clashes_where_it_is_thicker():
    found = nh.check(shaft_in_bore(0.99), below=0.05)
    assert [pair.state for pair in found.pairs] == ["near"] and found.clean
    clearance = found.pairs[0].clearance
    # The weights of arcs are rounded.
    assert clearance.lower <= 0.01 + 1e-12 and clearance.upper >= 0.01 - 1e-12
    assert clearance.width < 1e-5
    thick = nh.check(shaft_in_bore(1.05)).pairs[0]
    assert thick.state == "clash" and holds(thick.volume, math.pi * (1.05**2 - 1))


def test_cancelling_and_an_end_of_time():
    cancel = threading.Event()
    cancel.set()
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.check(shaft_in_bore(0.99), cancel=cancel)
    assert raised.value.code == "CANCELLED"
    # Each clearance is bounded once, which does not tell a hundredth from nothing.
    hasty = nh.check(shaft_in_bore(0.99), max_seconds=1e-9)
    assert hasty.clean is None and holds(hasty.pairs[0].clearance, 0.01)


def test_assertions_name_what_clashes_and_where():
    apart = assembly(shaft=box((0, 0, 0)), hub=box((1.25, 0, 0)), lid=box((0, 0, 1)))
    nh.testing.assert_no_clashes(apart)
    nh.testing.assert_no_clashes(box((0, 0, 0)), box((1.25, 0, 0)), below=0.2)
    with pytest.raises(AssertionError, match=r"of 3 pairs: 2 near\nnear: shaft and hub: 0\.25"):
        nh.testing.assert_no_clashes(apart, below=0.3)
    clashing = assembly(shaft=box((0, 0, 0)), hub=box((0.75, 0, 0)))
    with pytest.raises(AssertionError, match=r"1 clash\nclash: shaft and hub: both have .* depth 0\.2"):
        nh.testing.assert_no_clashes(clashing)
    nh.testing.assert_no_clashes(clashing, rules={"intended": [{"a": "shaft", "b": "hub"}]})
    with pytest.raises(AssertionError, match="broken: lid must touch hub"):
        nh.testing.assert_no_clashes(apart, rules={"must_touch": [{"a": "lid", "b": "hub"}]})


def test_assertions_name_the_parts_that_moved():
    before = assembly(shaft=box((0, 0, 0)), hub=box((2, 0, 0)))
    nh.testing.assert_same_assembly(before, assembly(shaft=box((0, 0, 0)), hub=box((2, 0, 0.0005))))
    moved = assembly(shaft=box((0, 0, 0)), hub=box((2, 0, 5)))
    with pytest.raises(AssertionError, match="1 of 2 parts changed: hub moved by 5.000 along z"):
        nh.testing.assert_same_assembly(before, moved)
    more = assembly(shaft=box((0, 0, 0)), hub=box((2, 0, 0)), lid=box((9, 9, 9), (1, 2, 3)))
    with pytest.raises(AssertionError, match="lid added, at a limit of 0.001\nadded: lid"):
        nh.testing.assert_same_assembly(before, more)
    with pytest.raises(AssertionError, match="the only part is moved"):
        nh.testing.assert_same_assembly(box((0, 0, 0)), box((0, 3, 0)))
    summary = nh.diff(before, moved).parts_summary
    assert summary == "1 of 2 parts changed: hub moved by 5.000 along z"


TWO = assembly(a=box((0, 0, 0)), b=box((2, 0, 0)))


@pytest.mark.parametrize("rules", [[], "rules.json", {"intended": "shaft"}, {"intended": [["a", "b"]]}])
def test_rules_that_are_no_mappings_are_refused(rules):
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.check(TWO, rules=rules)
    assert raised.value.code in ("ARGUMENT_INVALID", "OPTION_INVALID")
