"""Unchanged parts that are said to be renamed: 7 of 15 by argus-diff 0.1.1, as its users were told; names are kept here.

Fifteen parts, seven of which are copies of others under names of their own. Nothing changed but the order in the file
and, in the second case, one name.
"""

from common import compared, show_parts
from parts import KINDS, Part
from placement import translation

NUMBERS = {kind: tuple((low + high) / 2 for low, high in of.ranges) for kind, of in KINDS.items()}


def main() -> None:
    kinds = ["plate", "block", "bracket", "shaft", "flange", "washer", "star", "rounded"]
    shapes = {kind: Part(kind, NUMBERS[kind]).build() for kind in kinds}
    parts = {kind: (shapes[kind], translation(60 * index, 0, 0)) for index, kind in enumerate(kinds)}
    for index in range(7):
        kind = ["shaft", "washer", "washer", "plate", "star", "shaft", "washer"][index]
        parts[f"{kind} {index + 2}"] = (shapes[kind], translation(60 * index, 80, 0))
    print("the same fifteen, in another order")
    show_parts(compared(parts, dict(reversed(parts.items()))))
    renamed = {("rod" if name == "shaft 2" else name): part for name, part in parts.items()}
    print("one of them renamed")
    show_parts(compared(parts, renamed))


if __name__ == "__main__":
    main()
