"""Kinds of duplicates: copies in place as one product or two, turned on themselves, in other frames, and near ones."""

from common import checked, leaf, placed
from OCP.gp import gp_Trsf
from parts import Part, box, cylinder
from placement import product, translation, turn


def main() -> None:
    bolt = cylinder(3, 20)
    block = Part("block", (16.0, 18.0, 20.0, 6.0)).build()
    frame = product(translation(3, -7, 2), turn((1, 2, 3), 40))
    in_another_frame = placed(block, frame)
    cases = {
        "one product used twice": ((bolt, gp_Trsf()), (bolt, gp_Trsf()), True),
        "two equal products": ((bolt, gp_Trsf()), (cylinder(3, 20), gp_Trsf()), True),
        "turned on itself": ((bolt, gp_Trsf()), (bolt, turn((0, 0, 1), 73)), True),
        "written in another frame": ((block, gp_Trsf()), (in_another_frame, frame.Inverted()), True),
        "moved by a hundredth": ((bolt, gp_Trsf()), (bolt, translation(0, 0, 0.01)), False),
        "of the same box, with other holes": ((block, gp_Trsf()), (box(16, 18, 20), gp_Trsf()), False),
    }
    for label, (one, other, expected) in cases.items():
        result = checked({"one": one, "other": other})
        said = bool(result["bodies"][0]["duplicates"])
        pair = result["pairs"][0]
        print(f"{label}: duplicate {said}, expected {expected}; {leaf(pair['a'])} and other: {pair['state']}")


if __name__ == "__main__":
    main()
