"""Profiles turned about the z axis, with poles and without."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
from OCP.gp import gp_Ax2, gp_Dir, gp_Elips, gp_Pnt

from ..curves import circle, closed_spline, plane_face, segment, spline, vase, wire, wobbly_circle
from ..solids import Z_AXIS, cut, cylinder, posed
from .registry import kind

# Distance from the axis of the closed profiles whose radii are not drawn.
RING = 18


def turned(boundary, *angle):
    return BRepPrimAPI_MakeRevol(plane_face(boundary), Z_AXIS, *angle).Shape()


def turned_vase(n):
    curve = vase(n)
    start, end = curve.StartPoint(), curve.EndPoint()
    boundary = BRepBuilderAPI_MakeWire(
        BRepBuilderAPI_MakeEdge(curve).Edge(),
        segment(end.Coord(), (0, 0, 35)),
        segment((0, 0, 35), (0, 0, 0)),
        segment((0, 0, 0), start.Coord()),
    ).Wire()
    result = turned(boundary) if n.whole("full", 0, 1) else turned(boundary, n.real("ang", 1, 5))
    angle = n.real("ba", -0.5, 0.5)
    direction = (math.cos(angle), math.sin(angle), n.real("bt", -0.3, 0.3))
    return posed(cut(result, cylinder((0, 0, n.real("bz", 10, 25)), direction, n.real("br", 1.5, 4), 60)), n)


@kind
def revolve_spline(n):
    return turned_vase(n)


@kind
def revolve_pole(n):
    """Both ends of the profile on the axis."""
    through = [
        (0, 0, 0),
        (n.real("r1", 5, 9), 0, n.real("z1", 0, 2)),
        (n.real("r2", 8, 12), 0, 12),
        (n.real("r3", 4, 8), 0, 22),
        (0, 0, n.real("z4", 24, 28)),
    ]
    edge = BRepBuilderAPI_MakeEdge(spline(through)).Edge()
    body = turned(BRepBuilderAPI_MakeWire(edge, segment(through[4], through[0])).Wire())
    start, tilt = (n.real("bx", -2, 2), n.real("by", -2, 2), -5), n.real("bd", -0.2, 0.2)
    return posed(cut(body, cylinder(start, (tilt, 0.1, 1), n.real("br", 1, 3), n.real("bl", 15, 50))), n)


@kind
def revolve_circle(n):
    return posed(turned(wire(circle((n.real("R", 12, 20), 0, 0), (0, 1, 0), n.real("r", 2, 6)))), n)


@kind
def revolve_ellipse(n):
    frame = gp_Ax2(gp_Pnt(n.real("R", 12, 20), 0, 0), gp_Dir(0, 1, 0))
    return posed(turned(wire(gp_Elips(frame, n.real("A", 5, 7), n.real("B", 2, 4)))), n)


@kind
def revolve_closed_spline(n):
    profile = [(RING + x, 0, y) for x, y in wobbly_circle(n, "c", 7, 5, 0.15)]
    result = turned(wire(closed_spline(profile)))
    if n.whole("cut", 0, 1):
        result = cut(result, cylinder((RING, 0, 0), (n.real("dx", -1, 1), 1, 0.8), n.real("br", 0.5, 2), 20))
    return posed(result, n)
