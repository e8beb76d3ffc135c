"""Rigid motions of OpenCASCADE, made and compared."""

from __future__ import annotations

import math
from random import Random

from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec


def translation(x: float, y: float, z: float) -> gp_Trsf:
    motion = gp_Trsf()
    motion.SetTranslation(gp_Vec(x, y, z))
    return motion


def turn(axis: tuple[float, float, float], degrees: float, at: tuple[float, float, float] = (0, 0, 0)) -> gp_Trsf:
    motion = gp_Trsf()
    motion.SetRotation(gp_Ax1(gp_Pnt(*at), gp_Dir(*axis)), math.radians(degrees))
    return motion


def mirror_in_x() -> gp_Trsf:
    """Return the change of the sign of x in the part's own frame."""
    mirror = gp_Trsf()
    mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)))
    return mirror


def product(*motions: gp_Trsf) -> gp_Trsf:
    """Return the motion that applies the last one first."""
    result = gp_Trsf()
    for motion in motions:
        result = result.Multiplied(motion)
    return result


def direction(rng: Random) -> tuple[float, float, float]:
    """Return a direction, uniformly from the sphere."""
    z, angle = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
    planar = math.sqrt(1 - z * z)
    return (planar * math.cos(angle), planar * math.sin(angle), z)


def random_turn(rng: Random) -> gp_Trsf:
    return turn(direction(rng), rng.uniform(0, 180))


def largest_difference(motion: dict, expected: gp_Trsf, points: list[gp_Pnt]) -> float:
    """Return how far points lie apart after a motion of the result and after the expected one."""
    found = product(translation(*motion["translation"]), turn(tuple(motion["axis"]), motion["angle"]))
    return max(p.Transformed(found).Distance(p.Transformed(expected)) for p in points)
