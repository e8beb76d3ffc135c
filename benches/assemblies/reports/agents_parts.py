"""Parts that are valid each and occupy the same space, named in text-to-cad#329.

Two gears with an error of half a tooth in their phase, and without one; a bracket clamped through the case that it is
to clear; a joint turned into its own previous link. The shapes are ours, the words the report's.
"""

import math

from common import checked, common_volume, show_pairs
from OCP.gp import gp_Trsf
from parts import bracket, box, cut, cylinder, fuse, prism
from placement import product, translation, turn

TEETH = 16
MODULE = 2.0


def gear():
    """A gear with trapezia as teeth, whose flanks leave a gap to those of its like."""
    corners = []
    pitch = 2 * math.pi / TEETH
    middle = 0.5 * MODULE * TEETH
    for tooth in range(TEETH):
        for part, height in ((-0.29, -1.25), (-0.11, 0.95), (0.11, 0.95), (0.29, -1.25)):
            radius, angle = middle + MODULE * height, (tooth + part) * pitch
            corners.append((radius * math.cos(angle), radius * math.sin(angle)))
    return cut(prism(corners, 6.0), cylinder(4.0, 6.0))


def gears(phase: float):
    """Two gears at the distance of their pitch circles, the second turned from meshing by a part of a pitch."""
    wheel = gear()
    # A gap of the second one is at the first one's tooth along x.
    turned = turn((0, 0, 1), 180.0 + (0.5 + phase) * 360.0 / TEETH)
    return {"gear 1": (wheel, gp_Trsf()), "gear 2": (wheel, product(translation(MODULE * TEETH, 0, 0), turned))}


def clamped():
    case = cut(box(60, 40, 30), box(56, 36, 28, (2, 2, 2)))
    return {"case": (case, gp_Trsf()), "bracket": (bracket(26, 16, 20, 3, 12), translation(50, 10, 10))}


def links(angle: float):
    link = fuse(box(40, 10, 6, (0, -5, 0)), cylinder(5, 6), cylinder(5, 6, (40, 0, 0)))
    upper = product(translation(40, 0, 3), turn((0, 1, 0), -angle))
    return {"link 1": (link, gp_Trsf()), "link 2": (link, product(upper, translation(0, 0, 3.5)))}


def main() -> None:
    cases = [
        ("gears in mesh", gears(0.0)),
        ("gears half a tooth off", gears(0.5)),
        ("a bracket through the case", clamped()),
        ("a joint at 0 degrees", links(0.0)),
        ("a joint turned into its previous link", links(-150.0)),
    ]
    for label, parts in cases:
        print(f"{label}: in common by a boolean {common_volume(parts, *parts):.6g}")
        show_pairs(checked(parts, "--below", "0.6"))


if __name__ == "__main__":
    main()
