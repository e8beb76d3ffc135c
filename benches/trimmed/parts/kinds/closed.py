"""Tori: surfaces closed in both directions, with loops that avoid the seams or cross them."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus
from OCP.Geom import Geom_CylindricalSurface, Geom_SphericalSurface, Geom_ToroidalSurface

from ..solids import axis, cut, cylinder, fuse, posed, sphere, torus
from ..trims import FRAME, blob, wire_on
from .registry import kind

WHOLE = axis((0, 0, 0), (0, 0, 1))
# Largest distance of a face's natural boundary from its surface's.
FACE_TOLERANCE = 1e-7


def radii(n, least=4):
    return n.real("R", 12, 20), n.real("r", least, 8)


def with_holes(n, maker, surface, place):
    """Returns a face with one or two loops in it; `place` is the center of loop j."""
    for j in range(n.whole("n", 1, 2)):
        size = (n.real(f"ru{j}", 0.3, 0.6), n.real(f"rv{j}", 0.2, 0.5))
        maker.Add(wire_on(surface, blob(n, f"h{j}", place(j), size, 7, 0.3, True)))
    return posed(maker.Face(), n)


@kind
def torus_full(n):
    return posed(torus((0, 0, 0), (0, 0, 1), *radii(n, 2)), n)


@kind
def torus_hole(n):
    """One bore through the tube: its loops cross no seam as a rule."""
    major, minor = radii(n)
    around, tilt = n.real("a", 0, 6.28), n.real("b", 0.4, 1.2)
    outward = (math.cos(around), math.sin(around))
    direction = (math.cos(tilt) * outward[0], math.cos(tilt) * outward[1], math.sin(tilt))
    bore = cylinder((major * outward[0], major * outward[1], 0), direction, n.real("br", 0.5, 2), 3 * minor)
    return posed(cut(torus((0, 0, 0), (0, 0, 1), major, minor), bore), n)


@kind
def torus_bump(n):
    major, minor = radii(n)
    around = n.real("a", 0, 6.28)
    ball = sphere((major * math.cos(around), major * math.sin(around), minor), n.real("br", 1, 3))
    return posed(fuse(torus((0, 0, 0), (0, 0, 1), major, minor), ball), n)


@kind
def torus_seam_ball(n):
    """A ball fused where both seams meet."""
    major = n.real("R", 12, 16)
    return posed(fuse(torus((0, 0, 0), (0, 0, 1), major, n.real("r", 3, 5)), sphere((major + 2, 0, 0), 6)), n)


@kind
def torus_face_holes(n):
    surface = Geom_ToroidalSurface(FRAME, *radii(n))
    maker = BRepBuilderAPI_MakeFace(surface, FACE_TOLERANCE)
    return with_holes(n, maker, surface, lambda j: (n.real(f"c{j}", 1, 1.5) + 2.5 * j, n.real(f"d{j}", 1, 5)))


@kind
def full_periodic_holes(n):
    """A torus, sphere or cylinder with loops about v = 0, which on the torus is a seam: such a face is invalid."""
    choice = n.whole("k", 0, 2)
    surface = (Geom_ToroidalSurface(FRAME, 14, 5), Geom_SphericalSurface(FRAME, 10), Geom_CylindricalSurface(FRAME, 8))[choice]
    bounds = (0, 2 * math.pi, -10, 10) if choice == 2 else ()
    maker = BRepBuilderAPI_MakeFace(surface, *bounds, FACE_TOLERANCE)
    return with_holes(n, maker, surface, lambda j: (n.real(f"c{j}", 1, 1.5) + 2.5 * j, 0.1))


@kind
def torus_wedge(n):
    return posed(BRepPrimAPI_MakeTorus(WHOLE, n.real("R", 12, 20), n.real("r", 3, 6), n.real("ang", 1, 6)).Shape(), n)


@kind
def torus_segment(n):
    across = (n.real("v0", -1, 0.5), n.real("v1", 1, 3))
    maker = BRepPrimAPI_MakeTorus(WHOLE, n.real("R", 12, 20), n.real("r", 3, 6), *across, n.real("ang", 1, 6))
    return posed(maker.Shape(), n)
