"""Loops of splines in the parameters of any surface."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeWire
from OCP.BRepLib import BRepLib
from OCP.Geom2d import Geom2d_BSplineCurve
from OCP.gp import gp_Ax3, gp_Pnt, gp_Pnt2d
from OCP.TColgp import TColgp_Array1OfPnt2d

from .curves import integers, reals
from .numbers import Numbers
from .solids import ORIGIN, UP

DEGREE = 3
# Loops within a rectangle: how far the outer one stays inside where all its radii grow.
SHRINKING = 1.35
FRAME = gp_Ax3(ORIGIN, UP)


def closed_curve(controls) -> Geom2d_BSplineCurve:
    """Returns the closed cubic of this control polygon, with clamped ends."""
    count = len(controls)
    array = TColgp_Array1OfPnt2d(1, count)
    for index, (u, v) in enumerate(controls, 1):
        array.SetValue(index, gp_Pnt2d(u, v))
    knots = reals([k / count for k in range(count + 1)])
    curve = Geom2d_BSplineCurve(array, knots, integers([1] * (count + 1)), DEGREE, True)
    curve.SetNotPeriodic()
    return curve


def blob(numbers: Numbers, name, center, radii, count, roughness, reverse=False) -> Geom2d_BSplineCurve:
    """Returns a random loop about a point, clockwise if reversed."""
    controls = []
    for k in range(count):
        angle = 2 * math.pi * k / count * (-1 if reverse else 1)
        factor = 1 + numbers.real(f"{name}{k}", -roughness, roughness)
        controls.append((center[0] + radii[0] * factor * math.cos(angle), center[1] + radii[1] * factor * math.sin(angle)))
    return closed_curve(controls)


def loops(numbers: Numbers, u, v, holes: int) -> list[Geom2d_BSplineCurve]:
    """Returns an outer loop within the rectangle u × v and up to three holes in it."""
    center = [(u[0] + u[1]) / 2, (v[0] + v[1]) / 2]
    radii = [(u[1] - u[0]) / 2 / SHRINKING, (v[1] - v[0]) / 2 / SHRINKING]
    result = [blob(numbers, "o", center, radii, 10, 0.25)]
    # Center and radii in parts of the outer radii, control points and roughness.
    inner = [
        ((-0.3, -0.2), (0.15, 0.2), 6, 0.25),
        ((0.3, 0.25), (0.18, 0.12), 7, 0.25),
        ((0.28, -0.3), (0.1, 0.1), 5, 0.2),
    ]
    for number, (place, size, count, roughness) in enumerate(inner[:holes], 1):
        at = [c + r * p for c, r, p in zip(center, radii, place)]
        result.append(blob(numbers, f"h{number}", at, [r * s for r, s in zip(radii, size)], count, roughness, True))
    return result


def wire_on(surface, curve):
    edge = BRepBuilderAPI_MakeEdge(curve, surface).Edge()
    BRepLib.BuildCurves3d_s(edge)
    return BRepBuilderAPI_MakeWire(edge).Wire()


def trimmed(surface, curves):
    """Returns the face of a surface within these loops, the outer one first."""
    maker = BRepBuilderAPI_MakeFace(surface, wire_on(surface, curves[0]), True)
    for curve in curves[1:]:
        maker.Add(wire_on(surface, curve))
    face = maker.Face()
    BRepLib.BuildCurves3d_s(face)
    return face
