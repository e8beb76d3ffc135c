"""Interpenetrating solids that pass as disjoint: build123d-mcp#453, with its control, and the check asked for in #13.

Two cubes of 20 overlap by 10 x 20 x 20. The sum of their volumes is 16000, that of their union 12000.
"""

from common import checked, common_volume, show_pairs, volume
from OCP.gp import gp_Trsf
from parts import box
from placement import translation


def main() -> None:
    for label, x in (("overlapping by 10", 10.0), ("20 apart", 40.0)):
        parts = {
            "a": (box(20, 20, 20), gp_Trsf()),
            "b": (box(20, 20, 20), translation(x, 0, 0)),
        }
        total = sum(volume(shape) for shape, _ in parts.values())
        print(f"{label}: volumes summed {total:.0f}, in common by a boolean {common_volume(parts, 'a', 'b'):.6g}")
        show_pairs(checked(parts))


if __name__ == "__main__":
    main()
