"""Parts of assemblies, made by OpenCASCADE in their own frames; all lengths are millimetres.

A part is a kind and its numbers, so that an edit changes a number and builds the part again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from random import Random

from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Vec
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape

Z = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Part:
    """A kind of part and its numbers."""

    kind: str
    numbers: tuple[float, ...]

    def build(self) -> TopoDS_Shape:
        """Return the solid in the part's own frame."""
        return KINDS[self.kind].build(*self.numbers)

    @property
    def turns(self) -> float | None:
        """The angle in degrees about its own z axis that lays the part on itself; 0 for any angle, None for no one."""
        return KINDS[self.kind].turns

    @property
    def is_chiral(self) -> bool:
        """Whether no motion lays the part on its mirror image."""
        return KINDS[self.kind].is_chiral

    def with_hole_moved(self, by: float) -> Part | None:
        """Return the part with one hole or step moved by a length, or None where it has none."""
        index = KINDS[self.kind].moves
        if index is None:
            return None
        numbers = list(self.numbers)
        numbers[index] += by
        return replace(self, numbers=tuple(numbers))


def box(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0)) -> TopoDS_Shape:
    return BRepPrimAPI_MakeBox(gp_Pnt(*at), x, y, z).Shape()


def cylinder(
    radius: float, height: float, at: tuple[float, float, float] = (0, 0, 0), along: tuple[float, float, float] = Z
) -> TopoDS_Shape:
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(*at), gp_Dir(*along)), radius, height).Shape()


def cut(shape: TopoDS_Shape, *tools: TopoDS_Shape) -> TopoDS_Shape:
    for tool in tools:
        shape = BRepAlgoAPI_Cut(shape, tool).Shape()
    return one_solid(shape)


def fuse(shape: TopoDS_Shape, *others: TopoDS_Shape) -> TopoDS_Shape:
    for other in others:
        shape = BRepAlgoAPI_Fuse(shape, other).Shape()
    return one_solid(shape)


def one_solid(shape: TopoDS_Shape) -> TopoDS_Shape:
    """Return the only solid of a compound, as boolean operations give one."""
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    solid = TopoDS.Solid(explorer.Current())
    explorer.Next()
    if explorer.More():
        raise ValueError("a part of several solids")
    return solid


def prism(corners: list[tuple[float, float]], height: float) -> TopoDS_Shape:
    polygon = BRepBuilderAPI_MakePolygon()
    for x, y in corners:
        polygon.Add(gp_Pnt(x, y, 0))
    polygon.Close()
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()).Face(), gp_Vec(0, 0, height)).Shape()


def plate(x: float, y: float, z: float, radius: float, at_x: float, at_y: float) -> TopoDS_Shape:
    """A plate with a large hole, and a small one in a corner."""
    return cut(box(x, y, z), cylinder(radius, z, (at_x, at_y, 0)), cylinder(1.0, z, (3, 4, 0)))


def block(x: float, y: float, z: float, at: float) -> TopoDS_Shape:
    """A block with three holes of different radii in three directions: it has no symmetry."""
    return cut(
        box(x, y, z),
        cylinder(2.0, 0.4 * z, (at, 0.3 * y, 0.6 * z)),
        cylinder(1.5, 0.3 * x, (0.7 * x, 0.6 * y, 0.3 * z), (1, 0, 0)),
        cylinder(1.0, 0.3 * y, (0.35 * x, 0.7 * y, 0.65 * z), (0, 1, 0)),
    )


def bracket(a: float, b: float, c: float, thickness: float, at: float) -> TopoDS_Shape:
    """Two legs, one with a hole off its middle and the other shorter: it has no symmetry."""
    legs = fuse(box(a, b, thickness), box(thickness, 0.8 * b, c))
    return cut(
        legs,
        cylinder(1.8, thickness, (at, 0.3 * b, 0)),
        cylinder(1.2, thickness, (0, 0.6 * b, 0.7 * c), (1, 0, 0)),
    )


def shaft(radius: float, length: float, shoulder: float) -> TopoDS_Shape:
    """A cylinder with a thicker part up to its shoulder."""
    return fuse(cylinder(radius, length), cylinder(1.5 * radius, shoulder))


def flange(radius: float, height: float, bore: float, circle: float) -> TopoDS_Shape:
    """A disc with a bore and six holes on a circle."""
    holes = [
        cylinder(1.2, height, (circle * math.cos(i * math.pi / 3), circle * math.sin(i * math.pi / 3), 0))
        for i in range(6)
    ]
    return cut(cylinder(radius, height), cylinder(bore, height), *holes)


def housing(x: float, y: float, z: float, wall: float, at: float) -> TopoDS_Shape:
    """A box with a hollow inside that nothing leads to, and a blind hole in one wall."""
    hollow = box(x - 4 * wall, y - 2 * wall, z - 2 * wall, (3 * wall, wall, wall))
    return cut(box(x, y, z), hollow, cylinder(1.5, 1.5 * wall, (0, at, 0.4 * z), (1, 0, 0)))


def rounded(x: float, y: float, z: float, radius: float) -> TopoDS_Shape:
    """A box about the z axis with four rounded edges along it."""
    solid = box(x, y, z, (-0.5 * x, -0.5 * y, 0))
    fillet = BRepFilletAPI_MakeFillet(solid)
    edges = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_EDGE)
    seen = []
    while edges.More():
        edge = TopoDS.Edge(edges.Current())
        if is_along_z(edge) and not any(edge.IsSame(other) for other in seen):
            fillet.Add(radius, edge)
            seen.append(edge)
        edges.Next()
    return one_solid(fillet.Shape())


def is_along_z(edge: TopoDS_Shape) -> bool:
    return abs(BRepAdaptor_Curve(edge).Line().Direction().Z()) > 0.5


def star(teeth: float, inner: float, outer: float, height: float) -> TopoDS_Shape:
    """A prism over a star of eight points."""
    corners = []
    for i in range(2 * int(teeth)):
        radius = inner if i % 2 else outer
        corners.append((radius * math.cos(i * math.pi / teeth), radius * math.sin(i * math.pi / teeth)))
    return prism(corners, height)


def washer(outer: float, inner: float, height: float) -> TopoDS_Shape:
    return cut(cylinder(outer, height), cylinder(inner, height))


def cone(bottom: float, top: float, height: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeCone(bottom, top, height).Shape()


def ball(radius: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeSphere(radius).Shape()


def ring(radius: float, tube: float) -> TopoDS_Shape:
    return BRepPrimAPI_MakeTorus(radius, tube).Shape()


@dataclass(frozen=True)
class Kind:
    """How a kind is built and drawn; `moves` is the number that moves a hole or a step."""

    build: Callable[..., TopoDS_Shape]
    ranges: tuple[tuple[float, float], ...]
    turns: float | None = None
    is_chiral: bool = False
    moves: int | None = None


KINDS = {
    "plate": Kind(plate, ((24, 40), (20, 30), (2, 5), (2, 4), (10, 14), (10, 12)), moves=4),
    "block": Kind(block, ((14, 20), (15, 22), (17, 26), (5, 7)), is_chiral=True, moves=3),
    "bracket": Kind(bracket, ((20, 30), (14, 20), (16, 26), (2, 4), (10, 14)), is_chiral=True, moves=4),
    "shaft": Kind(shaft, ((2, 4), (25, 40), (6, 12)), turns=0.0, moves=2),
    "flange": Kind(flange, ((14, 18), (3, 6), (4, 6), (9, 11)), turns=60.0),
    "housing": Kind(housing, ((24, 30), (20, 26), (15, 22), (1.5, 2.5), (6, 9)), is_chiral=True, moves=4),
    "rounded": Kind(rounded, ((12, 15), (16, 20), (8, 11), (1, 3)), turns=180.0),
    "star": Kind(star, ((8, 8), (6, 8), (10, 14), (4, 8)), turns=45.0),
    "washer": Kind(washer, ((6, 10), (3, 5), (1, 2)), turns=0.0),
    "cone": Kind(cone, ((6, 9), (2, 4), (8, 14)), turns=0.0),
    "ball": Kind(ball, ((5, 9),), turns=0.0),
    "ring": Kind(ring, ((8, 12), (2, 3)), turns=0.0),
}


def draw(rng: Random, kinds: list[str] | None = None) -> Part:
    """Return a part of a drawn kind and drawn numbers."""
    kind = rng.choice(kinds or list(KINDS))
    return Part(kind, tuple(rng.uniform(*span) for span in KINDS[kind].ranges))
