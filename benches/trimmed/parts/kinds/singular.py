"""Surfaces without a normal somewhere, loops that touch, and edges that bound nothing."""

from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.Geom import (
    Geom_BezierSurface,
    Geom_BSplineCurve,
    Geom_Plane,
    Geom_SurfaceOfLinearExtrusion,
    Geom_SurfaceOfRevolution,
    Geom_ToroidalSurface,
)
from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt
from OCP.TopAbs import TopAbs_INTERNAL
from OCP.TopoDS import TopoDS

from ..curves import circle, integers, net, plane_face, points, polygon, reals, segment, wire
from ..solids import ORIGIN, UP, box, cone, cut, cylinder, posed
from ..trims import FRAME, blob, loops, trimmed
from .registry import kind


@kind
def spindle(n):
    """A torus that meets itself: the tube is thicker than the ring."""
    surface = Geom_ToroidalSurface(FRAME, n.real("R", 3, 6), n.real("r", 7, 9))
    return posed(trimmed(surface, loops(n, (n.real("u0", 0.5, 1.5), n.real("u1", 3, 5)), (-1, 1), 1)), n)


@kind
def folded(n):
    """A control net that folds: the normal vanishes along curves."""
    moved = lambda name, place: place + n.real(name, -6, 6)
    rows = [[(moved(f"x{i}{j}", i * 4), moved(f"y{i}{j}", j * 4), n.real(f"z{i}{j}", -6, 6)) for j in range(5)] for i in range(5)]
    return posed(trimmed(Geom_BezierSurface(net(rows)), loops(n, (0.02, 0.98), (0.02, 0.98), 2)), n)


@kind
def degenerate_side(n):
    """A Bézier patch with one side collapsed to a point, whole or trimmed."""
    rows = [[(i * 8, (j - 1.5) * 6 * i / 3, n.real(f"z{i}{j}", -5, 5) * i / 3) for j in range(4)] for i in range(4)]
    surface = Geom_BezierSurface(net(rows))
    if n.whole("k", 0, 1):
        return posed(trimmed(surface, [blob(n, "o", (0.5, 0.5), (0.37, 0.37), 9, 0.25)]), n)
    return posed(BRepBuilderAPI_MakeFace(surface, 1e-6).Face(), n)


@kind
def cone_apex_cut(n):
    """A cone cut at its apex or through it."""
    body = cone((0, 0, 0), (0, 0, 1), n.real("r", 8, 12), 0, 20)
    if n.whole("k", 0, 1):
        start = (n.real("x", -1, 1) * n.whole("off", 0, 1), 0, 8)
        return posed(cut(body, cylinder(start, (0, 0, 1), n.real("br", 1, 2), 20)), n)
    return posed(cut(body, box(20, 20, 30, (0, n.real("y", -3, 0.5), -2))), n)


@kind
def creased(n):
    """The extrusion or revolution of a polyline: knots at which the surface is only continuous."""
    corners = [(k * 4, n.real(f"y{k}", -5, 5), 0) for k in range(6)]
    profile = Geom_BSplineCurve(points(corners), reals(list(range(6))), integers([2, 1, 1, 1, 1, 2]), 1)
    if n.whole("k", 0, 1):
        surface = Geom_SurfaceOfLinearExtrusion(profile, gp_Dir(0, 0.2, 1))
        return posed(trimmed(surface, loops(n, (0.1, 4.9), (0.1, 9), 1)), n)
    surface = Geom_SurfaceOfRevolution(profile, gp_Ax1(gp_Pnt(0, -9, 0), gp_Dir(1, 0, 0)))
    return posed(trimmed(surface, loops(n, (0.5, 4), (0.1, 4.9), 1)), n)


@kind
def touching_hole(n):
    """A disc with a hole that touches its boundary, or misses it by little."""
    maker = BRepBuilderAPI_MakeFace(Geom_Plane(ORIGIN, UP), wire(circle((0, 0, 0), (0, 0, 1), 10)), True)
    radius, space = n.real("r", 2, 4), (0, 1e-9, 1e-7, 1e-5)[n.whole("e", 0, 3)]
    hole = wire(circle((10 - radius - space, 0, 0), (0, 0, 1), radius))
    maker.Add(TopoDS.Wire_s(hole.Reversed()))
    return posed(maker.Face(), n)


@kind
def internal_edges(n):
    """A plane face with an edge inside that bounds nothing."""
    face = plane_face(polygon([(0, 0, 0), (20, 0, 0), (20, n.real("y", 10, 20), 0), (0, 15, 0)]))
    inside = BRepBuilderAPI_MakeWire(segment((5, 5, 0), (10, n.real("iy", 5, 9), 0))).Wire()
    BRep_Builder().Add(face, inside.Oriented(TopAbs_INTERNAL))
    return posed(face, n)
