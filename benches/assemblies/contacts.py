"""Pairs of bodies with a known contact, clearance or clash."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.TopoDS import TopoDS_Shape
from parts import ball, box, cone, cut, cylinder
from placement import translation, turn


@dataclass(frozen=True)
class Contact:
    """Two bodies with the states that are expected of them; a clearance or a volume is None where it is not compared."""

    label: str
    bodies: tuple[TopoDS_Shape, TopoDS_Shape]
    states: tuple[str, ...]
    clearance: float | None = None
    volume: float | None = None


def flush_boxes(rng: Random) -> Contact:
    x, y, z = (rng.uniform(3, 8) for _ in range(3))
    other = box(rng.uniform(3, 8), rng.uniform(3, 8), 4, (x, rng.uniform(-2, 2), rng.uniform(-2, 2)))
    return Contact("flush boxes", (box(x, y, z), other), ("touching",))


def shaft_in_bore(rng: Random) -> Contact:
    """A coaxial shaft; its clearance is radial."""
    radius, gap = rng.uniform(2, 4), rng.uniform(0.01, 0.4)
    sleeve = cut(box(12, 12, 6, (-6, -6, 0)), cylinder(radius + gap, 6))
    shaft = cylinder(radius, 10, (0, 0, -2))
    return Contact("shaft in a bore", (sleeve, shaft), ("near",), clearance=gap)


def press_fit(rng: Random) -> Contact:
    """A shaft that is thicker than its bore: the ring between both is in common."""
    radius, excess = rng.uniform(2, 4), rng.uniform(0.01, 0.1)
    sleeve = cut(box(12, 12, 6, (-6, -6, 0)), cylinder(radius, 6))
    shaft = cylinder(radius + excess, 10, (0, 0, -2))
    ring = math.pi * ((radius + excess) ** 2 - radius**2) * 6
    return Contact("press fit", (sleeve, shaft), ("clash",), volume=ring)


def overlapping_boxes(rng: Random) -> Contact:
    depth = 10 ** rng.uniform(-3, 0.3)
    x, y, z = (rng.uniform(4, 8) for _ in range(3))
    other = box(5, y + 2, z + 2, (x - depth, -1, -1))
    return Contact("overlapping boxes", (box(x, y, z), other), ("clash",), volume=depth * y * z)


def ball_on_plate(rng: Random) -> Contact:
    radius = rng.uniform(2, 4)
    return Contact("ball on a plate", (box(12, 12, 2, (-6, -6, -2)), moved(ball(radius), 0, 0, radius)), ("touching",))


def ball_above_plate(rng: Random) -> Contact:
    radius, gap = rng.uniform(2, 4), rng.uniform(0.01, 0.45)
    bodies = (box(12, 12, 2, (-6, -6, -2)), moved(ball(radius), 0, 0, radius + gap))
    return Contact("ball above a plate", bodies, ("near",), clearance=gap)


def ball_in_void(rng: Random) -> Contact:
    """A ball in a hollow that nothing leads to; both spheres are concentric."""
    radius, gap = rng.uniform(2, 3), rng.uniform(0.02, 0.4)
    hollow = cut(box(12, 12, 12, (-6, -6, -6)), ball(radius + gap))
    return Contact("ball in a void", (hollow, ball(radius)), ("near",), clearance=gap)


def tilted_box(rng: Random) -> Contact:
    """A box that stands on one edge."""
    angle = rng.uniform(10, 80)
    tilted = transformed(box(4, 4, 4), turn((0, 1, 0), -angle))
    return Contact("box on an edge", (box(12, 12, 2, (-6, -4, -2)), tilted), ("touching",))


def crossing_cylinders(rng: Random) -> Contact:
    """Two cylinders of equal radii whose axes cross at right angles: Steinmetz's solid, 16 r³ / 3."""
    radius = rng.uniform(1, 2)
    bodies = (cylinder(radius, 10, (0, 0, -5)), cylinder(radius, 10, (-5, 0, 0), (1, 0, 0)))
    return Contact("crossing cylinders", bodies, ("clash",), volume=16 * radius**3 / 3)


def cone_in_cone(rng: Random) -> Contact:
    """A cone in its counterpart, pulled out along the axis: the gap is along the normal."""
    rise, out = rng.uniform(3, 6), rng.uniform(0.05, 0.3)
    seat = cut(box(12, 12, rise, (-6, -6, 0)), cone(2, 4, rise))
    plug = moved(cone(2, 4, rise), 0, 0, out)
    # The slant is (2, rise).
    gap = out * 2 / math.hypot(2, rise)
    return Contact("cone in its seat", (seat, plug), ("near",), clearance=gap)


def twins(rng: Random) -> Contact:
    x, y, z = (rng.uniform(3, 8) for _ in range(3))
    return Contact("twins", (box(x, y, z), box(x, y, z)), ("clash",), volume=x * y * z)


def apart(rng: Random) -> Contact:
    return Contact("apart", (box(4, 4, 4), box(4, 4, 4, (4 + rng.uniform(0.6, 3), 0, 0))), ("apart",))


def moved(shape: TopoDS_Shape, x: float, y: float, z: float) -> TopoDS_Shape:
    return transformed(shape, translation(x, y, z))


def transformed(shape: TopoDS_Shape, motion) -> TopoDS_Shape:
    return BRepBuilderAPI_Transform(shape, motion, True).Shape()


CONTACTS: list[Callable[[Random], Contact]] = [
    flush_boxes,
    shaft_in_bore,
    press_fit,
    overlapping_boxes,
    ball_on_plate,
    ball_above_plate,
    ball_in_void,
    tilted_box,
    crossing_cylinders,
    cone_in_cone,
    twins,
    apart,
]
