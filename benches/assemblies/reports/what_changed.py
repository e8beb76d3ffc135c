"""What changed between two files: FreeCAD#28449, occt-import-js#16, agentcad#106 and diff3d#12.

They ask which parts of two files are in the first only, in the second only, the same or different, of any two paths,
also after a local edit that leaves volume and box nearly alone.
"""

from common import compared, show_parts
from OCP.gp import gp_Trsf
from parts import Part, box, cylinder
from placement import product, translation, turn

BLOCK = Part("block", (16.0, 18.0, 20.0, 6.0))
PLATE = Part("plate", (30.0, 24.0, 3.0, 3.0, 12.0, 11.0))


def main() -> None:
    bolt = cylinder(2, 20)
    block, plate = BLOCK.build(), PLATE.build()
    before = {
        "block": (block, gp_Trsf()),
        "plate": (plate, translation(0, 0, 40)),
        "bracket": (Part("bracket", (24.0, 16.0, 20.0, 3.0, 12.0)).build(), translation(50, 0, 0)),
        "cover": (box(30, 24, 2), translation(0, 0, 60)),
        **{f"bolt {i + 1}": (bolt, translation(10 * i, 60, 0)) for i in range(4)},
    }
    after = dict(before)
    # A hole of a corner by 0.01: the box is the same, and the volume but for 1e-9.
    after["plate"] = (PLATE.with_hole_moved(0.01).build(), before["plate"][1])
    after["bracket"] = (before["bracket"][0], product(translation(0, 5, 0), before["bracket"][1]))
    after["bolt 2"] = (bolt, product(translation(0, 0, 3), before["bolt 2"][1], turn((0, 0, 1), 30)))
    del after["cover"]
    after["lid"] = (box(20, 12, 2), translation(0, 0, 80))
    print("expected: plate changed, bracket and bolt 2 moved, cover removed, lid added")
    parts = compared(before, after)
    show_parts(parts)
    print(f"  the way of the hole of 0.01: {[[p['lower'], p['upper']] for p in parts if p['state'] == 'changed']}")
    print("read in another order, nothing changed")
    show_parts(compared(before, dict(reversed(before.items()))))


if __name__ == "__main__":
    main()
