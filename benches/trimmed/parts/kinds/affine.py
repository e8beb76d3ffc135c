"""Parts mapped, mirrored, scaled, far from the origin, with coarse tolerances, and placed in assemblies."""

from OCP.BRepBuilderAPI import BRepBuilderAPI_GTransform, BRepBuilderAPI_MakeVertex
from OCP.gp import gp_Ax2, gp_GTrsf, gp_Pnt, gp_Trsf
from OCP.ShapeFix import ShapeFix_ShapeTolerance

from ..curves import segment
from ..solids import box, compound, cut, cylinder, drill, faces, fuse, motion, moved, placed, posed, scaling, sphere, torus, translation
from .blends import bored_box
from .booleans import bool_box
from .registry import kind
from .revolved import turned_vase


def small_box(n):
    return posed(cut(box(10, 10, 10), drill(n, "b", (5, 5, 5), n.real("r", 1, 3))), n)


@kind
def gtrsf(n):
    """A part under a general affine map: its circles become rational splines of three arcs."""
    body = fuse(bored_box(n), torus((20, 15, 20), (0, 0, 1), 10, n.real("tr", 2, 4)))
    affine = gp_GTrsf()
    for row, factor in enumerate((1.3, 0.8, n.real("sz", 0.5, 1.6)), 1):
        affine.SetValue(row, row, factor)
    affine.SetValue(1, 2, n.real("sh", -0.4, 0.4))
    return posed(BRepBuilderAPI_GTransform(body, affine, True).Shape(), n)


@kind
def mirrored(n):
    body = bool_box(n) if n.whole("k", 0, 1) else turned_vase(n)
    mirror, scale = gp_Trsf(), gp_Trsf()
    mirror.SetMirror(gp_Ax2(gp_Pnt(1, 2, 3), n.direction("mir")))
    scale.SetScale(gp_Pnt(3, 2, 1), n.real("scale", 0.3, 2.0))
    scale.Multiply(mirror)
    return moved(body, scale)


@kind
def big_offset(n):
    return moved(bool_box(n), translation(1e5, -2e5, 1.5e5))


@kind
def tiny_scale(n):
    return moved(small_box(n), scaling(1e-3))


@kind
def huge_scale(n):
    return moved(small_box(n), scaling(1e5))


@kind
def coarse_tolerance(n):
    """Edges that state a tolerance of 0.05."""
    shape = small_box(n)
    ShapeFix_ShapeTolerance().SetTolerance(shape, 0.05)
    return shape


@kind
def assembly(n):
    """Instances of instances."""
    at = lambda name, distance=40: motion(n, name, (0.1, 3), distance)
    plate = cut(box(10, 8, 5), cylinder((5, 4, -1), (0, 0.1, 1), n.real("r", 1, 3), 9))
    ball = cut(sphere((0, 0, 0), 5), drill(n, "b", (0, 0, 0), n.real("r2", 1, 2)))
    group = compound([placed(plate, at("a1", 10)), placed(plate, at("a2", 10)), placed(ball, at("b1", 10))])
    return compound([placed(group, at("s1")), placed(group, at("s2")), placed(ball, at("b2"))])


@kind
def mixed_compound(n):
    """A solid twice, one of its faces, an edge and a vertex."""
    solid = small_box(n)
    vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(90, 0, 0)).Vertex()
    return compound([solid, solid, segment((0, 0, 0), (50, 0, 0)), vertex, faces(solid)[0]])
