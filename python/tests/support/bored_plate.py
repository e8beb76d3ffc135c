"""A plate with a bore, whose moved copies have distances and scores by formula."""

import math

#: A plate of 40 x 30 x 10 with a bore of radius 4 through it, and how far that is moved.
SIZE, RADIUS, SHIFT = (40.0, 30.0, 10.0), 4.0, 0.01

#: How far the bore of a scored plate is moved.
FAR = 0.5


def ratio_of_moved_bores():
    """The volume of the intersection of two plates with moved bores over that of their union."""
    disc = math.pi * RADIUS**2
    both = 2 * RADIUS**2 * math.acos(FAR / 2 / RADIUS) - FAR / 2 * math.sqrt(4 * RADIUS**2 - FAR**2)
    plate = SIZE[0] * SIZE[1]
    return (plate - (2 * disc - both)) / (plate - both)


def holds(found, expected):
    return found.lower <= expected <= found.upper


def is_score_of_a_moved_bore(found):
    """Whether the numbers of a plate with a moved bore are those of the formulas."""
    assert found.converged and holds(found.candidate.valid, 1) and found.candidate.bodies == 1
    assert holds(found.hausdorff.distance, FAR) and holds(found.volume.ratio, 1)
    assert holds(found.iou, ratio_of_moved_bores()) and found.iou.upper - found.iou.lower < 5e-3
    length = 4 * sum(SIZE) + 2 * 2 * math.pi * RADIUS
    assert holds(found.edge_length.candidate, length) and holds(found.edge_length.truth, length)
    assert found.thresholds[0].f1.upper < 1 and found.thresholds[0].edge_f1.upper < 1
    return True


def named(message, side):
    """The faces of one side that a failed assertion names."""
    lines = (line.split(f"changed: {side} face ") for line in message.splitlines())
    return {int(line[1].split()[0].rstrip(":")) for line in lines if len(line) == 2}
