"""Loops and bores across the seams of periodic surfaces, on other sheets of their parameters, and on reversed surfaces."""

import math

from OCP.Geom import (
    Geom_ConicalSurface,
    Geom_CylindricalSurface,
    Geom_SphericalSurface,
    Geom_SurfaceOfRevolution,
    Geom_ToroidalSurface,
)
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

from ..curves import closed_spline, plane_face, vase, wire
from ..solids import Z_AXIS, common, cut, cylinder, posed, prism, sphere
from ..trims import FRAME, loops, trimmed
from .registry import kind

PERIOD = 2 * math.pi


def across_seam(n, surface, v, holes):
    """Returns a face about u = 0, its curves a whole number of periods away."""
    shift = n.whole("wrap", -2, 2) * PERIOD
    u = (shift + n.real("u0", -1.5, -0.3), shift + n.real("u1", 0.4, 2.0))
    return posed(trimmed(surface, loops(n, u, v, holes)), n)


@kind
def seam_cylinder(n):
    return across_seam(n, Geom_CylindricalSurface(FRAME, n.real("R", 8, 12)), (-4, n.real("v1", 8, 20)), n.whole("h", 0, 2))


@kind
def seam_sphere(n):
    return across_seam(n, Geom_SphericalSurface(FRAME, n.real("R", 8, 12)), (-1.2, n.real("v1", 0.6, 1.3)), n.whole("h", 0, 2))


@kind
def seam_torus(n):
    surface, shift = Geom_ToroidalSurface(FRAME, n.real("R", 12, 20), n.real("r", 4, 8)), n.whole("wv", -1, 1) * PERIOD
    return across_seam(n, surface, (shift + n.real("v0", -1.5, -0.2), shift + n.real("v1", 0.5, 2)), n.whole("h", 0, 2))


@kind
def seam_cone(n):
    surface = Geom_ConicalSurface(FRAME, n.real("a", 0.2, 0.9), n.real("R", 8, 12))
    return across_seam(n, surface, (-4, n.real("v1", 8, 20)), 1)


@kind
def seam_revolution(n):
    return across_seam(n, Geom_SurfaceOfRevolution(vase(n), Z_AXIS), (0.05, 0.95), 1)


@kind
def seam_holes(n):
    """A cylinder bored across its seam, and perhaps along its axis."""
    result = cylinder((0, 0, 0), (0, 0, 1), 10, 40)
    for k in range(n.whole("n", 1, 3)):
        direction = (1, n.real(f"t{k}", -0.3, 0.3), n.real(f"u{k}", -0.3, 0.3))
        result = cut(result, cylinder((0, 0, 8 + 11 * k), direction, n.real(f"r{k}", 1.5, 4), 30))
    if n.whole("th", 0, 1):
        result = cut(result, cylinder((0, 0, -5), (0, 0, 1), n.real("R", 5, 8), 60))
    return posed(result, n)


def drawn_prism(n, center, radius, z, height):
    """Returns a prism of a periodic spline around a point."""
    points = []
    for k in range(8):
        angle, factor = PERIOD * k / 8, 1 + n.real(f"q{k}", -0.3, 0.3)
        points.append((center[0] + radius * factor * math.cos(angle), center[1] + radius * factor * math.sin(angle), z))
    return prism(plane_face(wire(closed_spline(points))), height)


@kind
def periodic_bspline(n):
    """An extruded periodic spline bored across its seam."""
    points = [(n.real(f"r{k}", 8, 12) * math.cos(PERIOD * k / 8), n.real(f"r{k}", 8, 12) * math.sin(PERIOD * k / 8), 0) for k in range(8)]
    body = prism(plane_face(wire(closed_spline(points))), (n.real("dx", -3, 3), 0, 25))
    angle = n.real("a", -0.4, 0.4)
    bore = cylinder((0, 0, n.real("z", 8, 16)), (math.cos(angle), math.sin(angle), 0.1), n.real("br", 1.5, 4), 40)
    return posed(cut(body, bore), n)


@kind
def sphere_pole_loop(n):
    """A sphere cut by a wobbly prism around or beside a pole."""
    prism_ = drawn_prism(n, (n.real("cx", -3, 3), n.real("cy", -3, 3)), 5, -20, (0, 0, 40))
    ball = sphere((0, 0, 0), 10)
    return posed(cut(ball, prism_) if n.whole("k", 0, 1) else common(ball, prism_), n)


@kind
def left_handed(n):
    """Surfaces whose frames are left-handed."""
    frame = gp_Ax3(gp_Pnt(1, 2, 3), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0))
    frame.YReverse()
    surface = (
        Geom_CylindricalSurface(frame, 9),
        Geom_SphericalSurface(frame, 9),
        Geom_ToroidalSurface(frame, 14, 5),
        Geom_ConicalSurface(frame, 0.5, 9),
    )[n.whole("k", 0, 3)]
    u = (n.real("u0", -1, 2), n.real("u1", 3, 5))
    return posed(trimmed(surface, loops(n, u, (-1.1, 1.1), n.whole("h", 0, 3))), n)


@kind
def reversed_face(n):
    face = trimmed(Geom_SphericalSurface(FRAME, n.real("R", 8, 12)), loops(n, (1, 4), (-1.1, 1.1), 2))
    return posed(face.Reversed(), n)
