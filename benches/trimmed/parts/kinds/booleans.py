"""Primitives cut and joined in random poses."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakeWedge
from OCP.gp import gp_Ax2, gp_Elips, gp_Pnt

from ..curves import plane_face, polygon, wire
from ..solids import UP, box, common, cone, cut, cylinder, drill, fuse, posed, prism, sphere, torus
from .registry import kind


@kind
def bool_box(n):
    result = box(40, 30, 20)
    for k in range(n.whole("n", 1, 3)):
        center = (n.real(f"x{k}", 8, 32), n.real(f"y{k}", 8, 22), n.real(f"z{k}", 5, 15))
        result = cut(result, drill(n, f"b{k}", center, n.real(f"r{k}", 1, 5)))
    direction = n.direction("cd") if n.whole("cm", 0, 1) else (0.2, 0.1, 1)
    base = (n.real("cx", 10, 30), n.real("cy", 10, 20), 15)
    boss = cone(base, direction, n.real("c1", 4, 8), n.real("c2", 0.5, 3), n.real("ch", 10, 20))
    return posed(fuse(result, boss), n)


@kind
def bool_sphere(n):
    result = sphere((0, 0, 0), 20, n.direction("ax"))
    for k in range(n.whole("n", 1, 3)):
        center = [n.real(f"o{k}{j}", -8, 8) for j in range(3)]
        result = cut(result, drill(n, f"b{k}", center, n.real(f"r{k}", 1.5, 6)))
    if n.whole("bx", 0, 1):
        result = cut(result, posed(box(40, 40, 40, (0, 0, n.real("h", 5, 15))), n, "bp", 4))
    return posed(result, n)


@kind
def sphere_caps(n):
    half = posed(box(80, 80, 80, (-40, -40, n.real("h", -6, 14))), n, "bp", 1)
    ball = sphere((0, 0, 0), 20)
    return posed(common(ball, half) if n.whole("k", 0, 1) else cut(ball, half), n)


@kind
def sphere_band(n):
    """A sphere cut by cylinders through and beside its poles, so that a pole is inside, outside or on the boundary."""
    offset = (0.0, n.real("x", 2.9, 3.1), 3.0, n.real("x2", 0.5, 6))[n.whole("k", 0, 3)]
    result = cut(sphere((0, 0, 0), 20), cylinder((offset, 0, -30), (0, 0, 1), 3, 60))
    across = cylinder((-30, n.real("y", -3, 3), n.real("z", -3, 3)), (1, 0, 0), n.real("r", 3, 6), 60)
    return posed(cut(result, across), n)


@kind
def bool_torus(n):
    result = torus((0, 0, 0), n.direction("ax"), n.real("R", 15, 20), n.real("r", 4, 8))
    for k in range(n.whole("n", 1, 2)):
        center = [n.real(f"o{k}{j}", -14, 14) for j in range(3)]
        result = cut(result, drill(n, f"b{k}", center, n.real(f"r{k}", 2, 7)))
    if n.whole("bx", 0, 1):
        result = common(result, posed(box(60, 60, 60, (n.real("h", -12, 5), -30, -30)), n, "bp", 2))
    return posed(result, n)


@kind
def bool_cone(n):
    top = 0 if n.whole("apex", 0, 1) else n.real("r2", 2, 6)
    result = cone((0, 0, 0), (0, 0, 1), n.real("r1", 10, 15), top, 30)
    for k in range(n.whole("n", 1, 2)):
        center = [n.real(f"o{k}0", -4, 4), n.real(f"o{k}1", -4, 4), n.real(f"o{k}2", 5, 20)]
        result = cut(result, drill(n, f"b{k}", center, n.real(f"r{k}", 1, 4)))
    ring = torus((0, 0, n.real("tz", 5, 12)), (0.1, 0.05, 1), n.real("tR", 8, 12), n.real("tr", 1, 3))
    return posed(fuse(result, ring), n)


@kind
def fragments(n):
    hole = cone((0, 0, -15), (n.real("x", -0.2, 0.2), n.real("y", -0.2, 0.2), 1), n.real("c1", 3, 5), n.real("c2", 5, 7), 40)
    bar = cylinder((-20, n.real("cy", -4, 4), 2), (1, 0, 0.1), n.real("r", 2, 3), 50)
    return posed(fuse(cut(sphere((0, 0, 0), 12), hole), bar), n)


@kind
def nut(n):
    corners = [(12 * math.cos(k * math.pi / 3), 12 * math.sin(k * math.pi / 3), 0) for k in range(6)]
    result = prism(plane_face(polygon(corners)), (0, 0, 8))
    result = common(result, cone((0, 0, -2), (0, 0, 1), n.real("k1", 9.5, 10.5) + 2, n.real("k2", 17, 19), 12))
    result = common(result, cone((0, 0, 10), (0, 0, -1), 12.2, 18, 12))
    return posed(cut(result, cylinder((0, 0, -1), (0, 0, 1), n.real("r", 5, 7), 12)), n)


@kind
def many_holes(n):
    result = box(60, 60, 4)
    for i in range(6):
        for j in range(6):
            bore = cylinder((6 + 9.5 * i, 6 + 9.5 * j, -1), (0.05 * (i - 2), 0.05 * (j - 3), 1), n.real(f"r{i}{j}", 1, 4), 8)
            result = cut(result, bore)
    return posed(result, n)


@kind
def prism_conics(n):
    ellipse = gp_Elips(gp_Ax2(gp_Pnt(0, 0, 0), UP), n.real("A", 10, 15), n.real("B", 5, 9))
    face = BRepBuilderAPI_MakeFace(wire(ellipse)).Face()
    result = prism(face, (n.real("dx", -5, 5), n.real("dy", -5, 5), 25))
    if n.whole("q", 0, 1):
        return posed(cut(result, posed(box(60, 60, 30, (-30, -30, n.real("h", 15, 20))), n, "bp", 1)), n)
    return posed(cut(result, drill(n, "b", (0, 0, 12), n.real("r", 2, 5))), n)


@kind
def wedge_mix(n):
    ends = (n.real("x", 5, 15), n.real("z", 2, 8), n.real("x2", 20, 35), n.real("z2", 10, 18))
    result = cut(BRepPrimAPI_MakeWedge(40, 30, 20, *ends).Shape(), sphere((20, 30, 10), n.real("r", 4, 8), n.direction("sd")))
    return posed(fuse(result, torus((20, 0, 10), n.direction("td"), 6, n.real("tr", 1, 2.5))), n)


@kind
def tangent_cylinders(n):
    crossing = cylinder((-20, 0, 0), (1, 0, 0), n.real("r", 7.9, 8.1), 40)
    return posed(fuse(cylinder((0, 0, -20), (0, 0, 1), 8, 40), crossing), n)


@kind
def sliver(n):
    """Walls and steps of hundredths."""
    width = n.real("eps", 1e-3, 5e-2)
    result = cut(box(40, 30, 20), cylinder((20, -1, 20 - 5 - width), (0, 1, 0), 5, 40))
    result = cut(result, cylinder((-1, 15, 4 + width * 0.3), (1, 0, 0), 4, 50))
    return posed(fuse(result, box(5, 5, 5 + width, (30, 20, 15))), n)


@kind
def thin_wall(n):
    wall = n.real("t", 0.001, 0.02)
    tube = cut(cylinder((0, 0, 0), (0, 0, 1), 10, 20), cylinder((0, 0, -1), (0, 0, 1), 10 - wall, 30))
    return posed(cut(tube, drill(n, "b", (0, 0, 10), n.real("r", 1, 3))), n)
