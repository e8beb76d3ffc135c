"""Spline loops with holes on every kind of surface."""

from OCP.Geom import (
    Geom_BezierSurface,
    Geom_BSplineSurface,
    Geom_ConicalSurface,
    Geom_CylindricalSurface,
    Geom_OffsetSurface,
    Geom_Plane,
    Geom_SphericalSurface,
    Geom_SurfaceOfLinearExtrusion,
    Geom_SurfaceOfRevolution,
    Geom_ToroidalSurface,
)
from OCP.gp import gp_Dir
from OCP.TColStd import TColStd_Array2OfReal

from ..curves import height_field, integers, net, reals, spline, vase
from ..solids import ORIGIN, UP, Z_AXIS, box, cut, fuse, moved, posed, prism, translation
from ..trims import FRAME, blob, loops, trimmed
from .registry import kind


def random_u(n):
    """An interval of u within one period of an angle."""
    return n.real("u0", 0.3, 2), n.real("u1", 3, 5.8)


def within(surface, margin):
    """The surface's domain without a part of its size on each side."""
    u0, u1, v0, v1 = surface.Bounds()
    inset = lambda low, high: (low + margin * (high - low), high - margin * (high - low))
    return inset(u0, u1), inset(v0, v1)


def face(n, surface, u, v, max_holes=3):
    return posed(trimmed(surface, loops(n, u, v, n.whole("h", 0, max_holes))), n)


@kind
def spline_on_sphere(n):
    return face(n, Geom_SphericalSurface(FRAME, n.real("R", 10, 20)), random_u(n), (-1.3, n.real("v1", 0.6, 1.3)))


@kind
def spline_on_torus(n):
    surface = Geom_ToroidalSurface(FRAME, n.real("R", 12, 20), n.real("r", 4, 8))
    return face(n, surface, random_u(n), (n.real("v0", 0.3, 2), n.real("v1", 3, 5.8)))


@kind
def spline_on_cone(n):
    surface = Geom_ConicalSurface(FRAME, n.real("a", 0.2, 0.9), n.real("R", 8, 12))
    return face(n, surface, random_u(n), (-4, n.real("v1", 8, 20)))


@kind
def spline_on_cylinder(n):
    return face(n, Geom_CylindricalSurface(FRAME, n.real("R", 8, 12)), random_u(n), (-4, n.real("v1", 8, 20)))


@kind
def spline_on_bspline(n):
    surface = height_field(n, (7, 6), -6, 6)
    return face(n, surface, *within(surface, 0.02))


@kind
def spline_on_revolution(n):
    return face(n, Geom_SurfaceOfRevolution(vase(n), Z_AXIS), random_u(n), (0.05, 0.95))


@kind
def spline_on_extrusion(n):
    through = [(0, 0, 0), (8, n.real("y1", -8, 8), 0), (16, n.real("y2", -8, 8), n.real("zz", -4, 4)), (26, n.real("y3", -8, 8), 0)]
    surface = Geom_SurfaceOfLinearExtrusion(spline(through), gp_Dir(0.3, n.real("dy", -0.2, 0.4), 1))
    return face(n, surface, (0.03, 0.97), (0, n.real("h1", 10, 20)))


@kind
def spline_on_offset(n):
    surface = Geom_OffsetSurface(height_field(n, (5, 5), -3, 3), n.real("off", 0.5, 2))
    return face(n, surface, *within(surface, 0.05), max_holes=2)


@kind
def glyph(n):
    """Letters: prisms of wobbly loops with holes, or the plate that they are stamped out of."""
    plane, result = Geom_Plane(ORIGIN, UP), None
    for k in range(n.whole("n", 1, 2)):
        curves = [blob(n, f"g{k}", (14 * k, 0), (5, 7), 12, 0.35)]
        if n.whole(f"hole{k}", 0, 3):
            curves.append(blob(n, f"gi{k}", (14 * k, 0), (2, 2.5), 7, 0.3, True))
        letter = prism(trimmed(plane, curves), (0, 0, n.real("h", 2, 6)))
        result = letter if result is None else fuse(result, letter)
    if n.whole("emb", 0, 1):
        result = cut(box(40, 30, 6, (-10, -15, -3)), moved(result, translation(0, 0, 1)))
    return posed(result, n)


def bezier(n, rows):
    """Returns a Bézier surface of degree rows - 1 and 3 over a grid of random heights."""
    return Geom_BezierSurface(net([[(i * 5, j * 6, n.real(f"z{i}{j}", -5, 5)) for j in range(4)] for i in range(rows)]))


@kind
def bezier_patch(n):
    return posed(trimmed(bezier(n, 5), loops(n, (0.02, 0.98), (0.02, 0.98), 2)), n)


@kind
def high_degree(n):
    """Degrees up to 18: above those that are accepted, some are refused."""
    return posed(trimmed(bezier(n, n.whole("d", 9, 18) + 1), loops(n, (0.02, 0.98), (0.02, 0.98), 1)), n)


@kind
def rational_weights(n):
    """A bicubic B-spline surface whose weights differ by up to six orders of magnitude."""
    size, degree, spread = 6, 3, n.whole("e", 0, 3)
    weights = TColStd_Array2OfReal(1, size, 1, size)
    for i in range(size):
        for j in range(size):
            weights.SetValue(i + 1, j + 1, 10 ** n.real(f"w{i}{j}", -spread, spread))
    poles = net([[(i * 8, j * 8, n.real(f"z{i}{j}", -8, 8)) for j in range(size)] for i in range(size)])
    spans = size - degree
    knots = reals(list(range(spans + 1)))
    multiplicities = integers([degree + 1] + [1] * (spans - 1) + [degree + 1])
    surface = Geom_BSplineSurface(poles, weights, knots, knots, multiplicities, multiplicities, degree, degree, False, False)
    u, v = ((start + 0.05, end - 0.05) for start, end in (surface.Bounds()[:2], surface.Bounds()[2:]))
    return face(n, surface, u, v)
