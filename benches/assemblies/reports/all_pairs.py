"""Clashes, contacts and least distances of all pairs: FreeCAD#28165, FreeCAD_Assembly4#331, #429 and #516.

Assembly4 intersects every part with every other one and keeps what has a volume. A shelf of twelve parts: flush, with
a press fit of 0.01, with a gap below the threshold of 0.2, and a shaving of 1e-3.
"""

import time
from itertools import combinations

from common import checked, common_volume, leaf, show_pairs
from OCP.gp import gp_Trsf
from parts import box, cut, cylinder
from placement import translation


def shelf():
    bored = cut(box(20, 20, 10), cylinder(4.0, 10, (10, 10, 0)))
    parts = {
        "base": (box(100, 60, 5), gp_Trsf()),
        "bearing": (bored, translation(5, 5, 5)),
        "pressed pin": (cylinder(4.01, 14), translation(15, 15, 5)),
        "near plate": (box(20, 20, 4), translation(30, 5, 5.1)),
        "shaved plate": (box(20, 20, 4), translation(55, 5, 5 - 1e-3)),
        "far plate": (box(20, 20, 4), translation(55, 5, 12)),
    }
    for index in range(6):
        parts[f"post {index + 1}"] = (box(4, 4, 20), translation(10 + 14 * index, 40, 5))
    return parts


def main() -> None:
    parts = shelf()
    started = time.process_time()
    found = {pair: common_volume(parts, *pair) for pair in combinations(parts, 2)}
    spent = time.process_time() - started
    print(f"booleans of {len(found)} pairs, {spent:.2f} CPU s, with a volume:")
    for pair, shared in found.items():
        if shared > 0:
            print(f"  {pair[0]} and {pair[1]}: {shared:.6g}")
    result = checked(parts, "--below", "0.2")
    clashes = [pair for pair in result["pairs"] if pair["state"] == "clash"]
    print(f"check of {result['pairCount']} pairs, clashes {[leaf(pair['a']) for pair in clashes]}:")
    show_pairs(result)


if __name__ == "__main__":
    main()
