"""Mirrored parts: a left hand where a right one was, one that is its own mirror image, and a mirrored pair in place."""

from common import compared, placed, show_parts
from OCP.gp import gp_Trsf
from parts import Part
from placement import mirror_in_x, product, translation, turn


def main() -> None:
    bracket = Part("bracket", (24.0, 16.0, 20.0, 3.0, 12.0)).build()
    flange = Part("flange", (16.0, 5.0, 5.0, 10.0)).build()
    place = product(translation(10, 20, 30), turn((1, 1, 0), 50))
    mirror = mirror_in_x()
    for label, shape in (("chiral", bracket), ("its own mirror image", flange)):
        before = {"part": (shape, gp_Trsf())}
        print(f"{label}, mirrored and moved")
        show_parts(compared(before, {"part": (placed(shape, mirror), place)}))
    left = placed(bracket, mirror)
    both = {"left": (left, gp_Trsf()), "right": (bracket, translation(40, 0, 0))}
    print("left and right exchanged, in place of each other")
    swapped = {"left": (bracket, translation(40, 0, 0)), "right": (left, gp_Trsf())}
    show_parts(compared(both, swapped))


if __name__ == "__main__":
    main()
