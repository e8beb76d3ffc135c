"""Profiles swept along splines and helices."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
from OCP.BRepLib import BRepLib
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakePipeShell
from OCP.Geom import Geom_CylindricalSurface
from OCP.Geom2d import Geom2d_Line, Geom2d_TrimmedCurve
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Dir2d, gp_Lin2d, gp_Pnt, gp_Pnt2d, gp_Vec
from OCP.Standard import Standard_Failure

from ..curves import circle, closed_spline, polygon, spline, wire, wobbly_circle
from ..solids import UP, cut, cylinder, drill, fuse, posed
from ..trims import FRAME
from .registry import kind


def start_of(curve):
    point, tangent = gp_Pnt(), gp_Vec()
    curve.D1(curve.FirstParameter(), point, tangent)
    return gp_Ax2(point, gp_Dir(tangent))


def pipe(spine, profile, mode):
    """Returns the solid of a profile along a wire; `mode` as of `SetMode`."""
    maker = BRepOffsetAPI_MakePipeShell(spine)
    maker.SetMode(mode)
    maker.Add(profile)
    maker.Build()
    maker.MakeSolid()
    return maker.Shape()


def helix_wire(radius, turns, pitch):
    line = Geom2d_Line(gp_Lin2d(gp_Pnt2d(0, 0), gp_Dir2d(2 * math.pi, pitch)))
    length = turns * math.hypot(2 * math.pi, pitch)
    surface = Geom_CylindricalSurface(FRAME, radius)
    edge = BRepBuilderAPI_MakeEdge(Geom2d_TrimmedCurve(line, 0, length), surface).Edge()
    BRepLib.BuildCurves3d_s(edge)
    return BRepBuilderAPI_MakeWire(edge).Wire()


@kind
def sweep(n):
    through = [
        (0, 0, 0),
        (n.real("x1", 5, 15), n.real("y1", -10, 10), 15),
        (n.real("x2", 15, 25), n.real("y2", -10, 10), 30),
        (n.real("x3", 25, 40), n.real("y3", 0, 20), 40),
    ]
    curve = spline(through)
    frame = start_of(curve)
    if n.whole("k", 0, 1):
        profile = wire(gp_Circ(frame, n.real("r", 2, 4)))
    else:
        x, y = gp_Vec(frame.XDirection()), gp_Vec(frame.YDirection())
        corner = lambda a, b: frame.Location().Translated(x.Multiplied(a).Added(y.Multiplied(b)))
        profile = polygon([corner(a, b) for a, b in ((-3, -2), (3, -2), (2, 3), (-2, 2))])
    result = pipe(wire(curve), profile, n.whole("m", 0, 1) == 1)
    if n.whole("cut", 0, 1):
        result = cut(result, drill(n, "b", (n.real("bx", 8, 20), 0, n.real("bz", 15, 25)), n.real("br", 1, 3)))
    return posed(result, n)


@kind
def helix(n):
    """A thread, on its core or alone."""
    radius, turns, pitch = n.real("R", 8, 12), n.real("turns", 1.5, 3), n.real("pitch", 3, 5)
    corners = [(radius + a, 0, z) for a, z in ((-0.8, -1.1), (1.2, -0.1), (1.2, 0.1), (-0.8, 1.1))]
    result = pipe(helix_wire(radius, turns, pitch), polygon(corners), UP)
    if n.whole("fuse", 0, 2) == 0:
        result = fuse(result, cylinder((0, 0, -3), (0, 0, 1), radius - 0.3, turns * pitch + 6))
    return posed(result, n)


@kind
def helix_spring(n):
    radius, turns, pitch = n.real("R", 8, 12), n.real("turns", 1.2, 2.5), n.real("pitch", 4, 7)
    profile = wire(circle((radius, 0, 0), (0, 2 * math.pi * radius, pitch), n.real("r", 0.8, 1.6)))
    return posed(pipe(helix_wire(radius, turns, pitch), profile, True), n)


@kind
def ring_pipe(n):
    """A tube around a closed spline, as a solid where OpenCASCADE makes one."""
    heights = [n.real(f"sz{k}", -2, 2) for k in range(8)]
    curve = closed_spline([(x, y, z) for (x, y), z in zip(wobbly_circle(n, "s", 8, 20, 0.15), heights)])
    maker = BRepOffsetAPI_MakePipeShell(wire(curve))
    maker.SetMode(True)
    maker.Add(wire(gp_Circ(start_of(curve), n.real("r", 2, 4))))
    maker.Build()
    try:
        maker.MakeSolid()
    except Standard_Failure:
        pass
    return posed(maker.Shape(), n)
