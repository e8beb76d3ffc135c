"""Facts of bodies, overlaps and intervals with known answers."""

import math

import numpy as np
import pytest
from boxes import box

import nurbs_hausdorff as nh


def test_intervals_compare_where_that_is_decided():
    one = nh.Interval(1.0, 2.0)
    assert one.middle == 1.5 and 1.0 <= one.width <= 1.0 + 1e-15
    assert one.contains(1.0) and 2.0 in one and not one.contains(2.5)
    assert (one < 3) is True and (one < 1) is False and (one < 1.5) is None
    assert (one <= 2) is True and (one <= 0.5) is False and (one <= 1) is None
    assert (one > 0.5) is True and (one > 2) is False and (one > nh.Interval(0.0, 1.5)) is None
    assert (one >= nh.Interval(0.0, 1.0)) is True and (one >= 2.5) is False and (one >= 1.5) is None
    assert (one == 1.5) is None and (one == 2) is None and (one == 2.5) is False and one != "1.5"
    assert (nh.Interval(3.0, 3.0) == 3) is True and one == nh.Interval(1.0, 2.0) != nh.Interval(1.0, 3.0)
    assert len({one, nh.Interval(1.0, 2.0)}) == 1
    assert tuple(one) == (1.0, 2.0)


@pytest.mark.parametrize(
    ("lower", "upper", "text"),
    [
        (360.0 - 1.5e-7, 360.0 + 1.5e-7, "360.00000000 ± 2e-7"),
        (-12.34567 - 0.04, -12.34567 + 0.04, "-12.346 ± 5e-2"),
        (2.0, 2.0, "2.0"),
        (-math.inf, math.inf, "unknown"),
    ],
)
def test_intervals_are_written_with_digits_that_are_certain(lower, upper, text):
    assert repr(nh.Interval(lower, upper)) == text


def test_facts_of_a_box():
    model = nh.model(box((1.0, 2.0, 3.0), (2.0, 3.0, 4.0)))
    assert model.volume.contains(24.0) and model.volume.width < 1e-9
    assert model.area.contains(52.0)
    for found, expected in zip(model.extents, (2.0, 3.0, 4.0)):
        assert found.contains(expected)
    for found, expected in zip(model.centroid, (2.0, 3.5, 5.0)):
        assert found.contains(expected)
    assert model.inertia[0][0].contains(24.0 / 12.0 * (9.0 + 16.0))
    facts = model.facts()
    assert facts.volume == model.volume and "24.0" in facts._repr_html_()
    (body,) = model.bodies
    assert body.kind == "solid" and body.closed and body.faces == (0, 1, 2, 3, 4, 5)
    assert body.facts.volume.contains(24.0)
    sheet = nh.model(box((0, 0, 0))[:1])
    assert sheet.volume is None and sheet.facts().volume_unknown == "open"


def quarter(radius):
    """A quarter of the cylinder about z between the heights 0 and 3."""
    weight = math.sqrt(0.5)
    arc = [(radius, 0.0, 1.0), (radius, radius, weight), (0.0, radius, 1.0)]
    ctrl = np.array([[(x, y, height, w) for x, y, w in arc] for height in (0.0, 3.0)])
    knots = {"knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1]}
    return {"degree": [1, 2], **knots, "ctrl": ctrl}


def test_faces_have_forms_and_resized_ones_counterparts():
    box_forms = nh.model(box((1.0, 2.0, 3.0))).face_forms
    assert [form.kind for form in box_forms] == ["plane"] * 6
    assert box_forms[0].deviation < 1e-14 and box_forms[0].radius is None
    (form,) = nh.model([quarter(2.0)]).face_forms
    assert isinstance(form, nh.FaceForm) and form.kind == "cylinder"
    assert form.radius.contains(2.0) and form.radius.width < 1e-11
    assert abs(form.direction[2]) == pytest.approx(1.0) and form.point[:2] == pytest.approx((0, 0))
    found = nh.diff([quarter(2.0)], [quarter(2.5)], limit=0.1)
    became = found.faces_of_a[0].counterpart
    assert (became.face, became.change) == (0, "resized")
    assert became.radius.contains(2.0) and became.other_radius.contains(2.5)
    assert found.faces_of_b[0].counterpart.radius == became.other_radius
    same = nh.diff([quarter(2.0)], [quarter(2.0)])
    assert same.faces_of_a[0].counterpart is None
    assert nh.model([quarter(2.0)]).info()["faces"][0]["form"]["kind"] == "cylinder"


def test_overlap_of_boxes():
    found = nh.overlap(box((0, 0, 0)), box((0.5, 0.25, 0.5)))
    assert found.converged and found.volumes.intersection.contains(0.1875)
    assert found.volumes.union.contains(1.8125) and found.ratio.contains(0.1875 / 1.8125)
    assert found.volumes.only_a.contains(0.8125) and found.volumes.only_b.contains(0.8125)
    assert "ratio" in found._repr_html_()
    moved = nh.overlap(
        box((0, 0, 0)), box((3, 0, 0)), transform=nh.Transform(translation=(2.5, 0, 0)), tolerance=1e-2
    )
    assert moved.volumes.intersection.contains(0.5)
    opened = nh.overlap(box((0, 0, 0))[:5], box((0, 0, 0)))
    assert opened.volumes is None and opened.volumes_unknown == "a-open"


def test_results_say_what_may_be_wrong_with_units():
    found = nh.clearance(box((0, 0, 0)), box((0, 0, 0), (25.4, 25.4, 25.4)))
    assert "inches" in found.hint
    assert nh.clearance(box((0, 0, 0)), box((3, 0, 0))).hint is None
    assert np.isfinite(found.lower)
