"""Scores of boxes whose numbers have formulas."""

import numpy as np
import pytest

import nurbs_hausdorff as nh

TRIANGLES = [
    [0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
    [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5],
]  # fmt: skip


def box(x, y, z):
    corners = [[x * (k & 1), y * (k >> 1 & 1), z * (k >> 2)] for k in range(8)]
    return nh.model((np.array(corners, float), np.array(TRIANGLES, np.uint32)))


def holds(found, expected):
    return found.lower <= expected <= found.upper


def test_a_deeper_box_has_the_distances_of_the_formula():
    h = 0.5
    found = nh.score(box(2, 3, 4 + h), box(2, 3, 4), thresholds=[0.2, 1.0])
    assert holds(found.forward.mean, (6 * h + 5 * h * h) / (52 + 10 * h))
    assert holds(found.reverse.mean, (6 * h - 5 * h * h + 4 / 3 * h**3) / 52)
    assert holds(found.hausdorff.distance, h) and holds(found.volume.ratio, 4 / (4 + h))
    assert holds(found.centroid_distance, h / 2) and holds(found.extent_differences[2], h)
    precision = 1 - (6 + 10 * (h - 0.2)) / (52 + 10 * h)
    assert holds(found.thresholds[0].precision, precision) and holds(found.thresholds[1].f1, 1)
    at = found.thresholds[0]
    assert holds(at.normal_precision, precision) and holds(at.normal_recall, 1 - 6 / 52)
    assert at.normal_angle == 30 and at.normal_f1.upper < 1
    assert holds(at.edge_precision, 1 - (10 + 4 * (h - 0.2)) / 38)
    assert holds(at.edge_recall, 1 - (10 - 8 * 0.2) / 36) and at.edge_f1.upper < 1
    assert holds(found.edge_length.truth, 36) and found.edge_length.feature_angle == 30
    assert holds(found.candidate.valid, 1) and found.candidate.bodies == 1 and found.met is None
    assert found.placement.align == "none" and found.placement.fit is None and found.faces is None
    assert "hausdorff" in found._repr_html_()


def test_requirements_and_alignments():
    deep, truth = box(2, 3, 4.5), box(2, 3, 4)
    missed = nh.score(deep, truth, at_least={"volume_ratio": 0.9})
    assert missed.met is False and missed.ended_early and missed.hausdorff is None
    assert missed.requirements[0].number == "volumeRatio" and missed.requirements[0].at_least == 0.9
    assert nh.score(deep, truth, at_most={"hausdorff": 0.6}, limit=0.1).met is True
    wide = nh.score(deep, truth, normal_angle=90, feature_angle=91, thresholds=[0.6])
    assert wide.thresholds[0].normal_f1.lower > 0.99 and holds(wide.thresholds[0].edge_f1, 1)
    assert nh.score(deep, truth, at_least={"edge_f1": 0.99, "normal_f1": 0.99}).met is False
    boxed = nh.score(box(4, 6, 8), truth, align="box", at_least={"f1": 0.99})
    assert boxed.met is True and boxed.placement.scale == pytest.approx(0.5)
    turned = nh.score(box(3, 2, 4), truth, align="best-fit", relative_tolerance=1e-2)
    assert turned.placement.fit.converged and len(turned.placement.fit.ambiguous) == 3
    assert turned.hausdorff.distance.upper < 0.1
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.score(deep, truth, at_least={"f2": 1.0})
    assert raised.value.code == "OPTION_INVALID"
