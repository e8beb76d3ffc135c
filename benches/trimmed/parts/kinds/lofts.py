"""Lofts through sections and surfaces that fill a boundary."""

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace
from OCP.BRepOffsetAPI import BRepOffsetAPI_MakeFilling, BRepOffsetAPI_ThruSections
from OCP.GeomAbs import GeomAbs_C0

from ..curves import ellipse_wire, height_field, polygon, spline
from ..solids import cut, drill, posed, prism, sphere
from .registry import kind


def loft_body(n, ruled):
    """Returns a solid through four ellipses, tilted a little."""
    maker = BRepOffsetAPI_ThruSections(True, ruled)
    for k, z in enumerate((0, 15, 35, 50)):
        a = n.real(f"a{k}", 10, 20)
        maker.AddWire(ellipse_wire(z, a, a * n.real(f"f{k}", 0.6, 0.95), n.real(f"t{k}", -0.2, 0.2)))
    maker.Build()
    return maker.Shape()


def bored_loft(n, ruled):
    center = (n.real("x", -3, 3), n.real("y", -3, 3), n.real("z", 15, 35))
    return posed(cut(loft_body(n, ruled), drill(n, "b", center, n.real("r", 2, 5))), n)


@kind
def loft_hole(n):
    return bored_loft(n, ruled=False)


@kind
def loft_ruled(n):
    return bored_loft(n, ruled=True)


@kind
def loft_square_round(n):
    maker = BRepOffsetAPI_ThruSections(True, False)
    width = n.real("sx", 0.8, 1.2)
    maker.AddWire(polygon([(x * width, y, 0) for x, y in ((-10, -10), (10, -10), (10, 10), (-10, 10))]))
    maker.AddWire(ellipse_wire(20, n.real("a", 8, 12), n.real("b", 5, 8)))
    maker.AddWire(ellipse_wire(40, n.real("a2", 4, 12), 4))
    maker.Build()
    return posed(cut(maker.Shape(), drill(n, "b", (0, 0, n.real("z", 10, 30)), n.real("r", 1.5, 3))), n)


@kind
def filling(n):
    """A prism of a surface that fills four random curves."""
    maker = BRepOffsetAPI_MakeFilling()
    heights = [n.real(letter, -4, 4) for letter in "abcd"]
    corners = [(x, y, z) for (x, y), z in zip(((0, 0), (20, 0), (22, 18), (-2, 20)), heights)]
    for k in range(4):
        a, b = corners[k], corners[(k + 1) % 4]
        middle = [(a[j] + b[j]) / 2 + n.real(f"m{k}{j}", -2, 2) for j in range(3)]
        maker.Add(BRepBuilderAPI_MakeEdge(spline([a, middle, b])).Edge(), GeomAbs_C0)
    maker.Build()
    result = prism(maker.Shape(), (0, 0, n.real("h", 4, 8)))
    return posed(cut(result, drill(n, "bb", (10, 10, 3), n.real("r", 1, 3))), n)


@kind
def bspline_solid_cut(n):
    top = BRepBuilderAPI_MakeFace(height_field(n, (5, 5), 8, 14), 1e-6).Face()
    result = cut(prism(top, (0, 0, -20)), sphere((20, 20, n.real("sz", 8, 14)), n.real("sr", 5, 9), n.direction("sd")))
    return posed(cut(result, drill(n, "b", (12, 25, 5), n.real("r", 1.5, 4))), n)
