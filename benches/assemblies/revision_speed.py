"""Time `diff` of two revisions of a large assembly, ten parts of which changed, and check each of its words.

    python benches/assemblies/revision_speed.py COMMAND [PARTS [SEED [KINDS]]]

Two assemblies of PARTS parts (200): `kinds` has uses of the parts of `parts.py`, a third as many distinct ones, apart from
each other; `plates` those of `speed.py`, of 20 faces each, no two alike, in contact. KINDS names one of them, else both
are timed. In the second revision five parts have a hole moved by 0.01 and five a size larger by 0.05, five others are moved
by a translation and five are turned. Prints the wrong words, the seconds that the command states, by the clock, and the
CPU seconds of the process with reading; and those of `info` of both files, which reads them.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

from assembly import Group, Instance, drawn, silently, write
from edits import HOLE_MOVED, Revision, move, turn_about_any_axis, words
from OCP.TopoDS import TopoDS_Shape
from parts import KINDS
from placement import product, translation, turn
from revisions import compared, judged
from speed import PER_ROW, SIDE, body

EDITS_OF_A_KIND = 5
LARGER = 0.05
#: The number of `KINDS` that is a radius or a length from one face to its opposite, by which the surface moves as far.
SIZES = {"shaft": 1, "washer": 0, "ball": 0, "ring": 1, "cone": 2, "plate": 2, "flange": 1, "rounded": 2}


@dataclass(frozen=True)
class Plate:
    """A plate of `speed.py` by the seed of its numbers."""

    seed: int
    moved: float = 0.0
    wider: float = 0.0
    kind: str = "board"
    turns: float | None = None

    def build(self) -> TopoDS_Shape:
        return body(Random(self.seed), self.moved, self.wider)


def plates(rng: Random, count: int) -> list[Group]:
    """Return layers of plates in contact, as `speed.py` has them."""
    whole = product(turn((1, 2, 3), 40), translation(5, -3, 11))
    groups: list[Group] = []
    for index in range(count):
        column, row, layer = index % PER_ROW, index // PER_ROW % PER_ROW, index // PER_ROW**2
        if layer == len(groups):
            groups.append(Group(f"layer {layer + 1}", product(whole, translation(0, 0, 9 * layer)), []))
        place = translation(SIDE * column, (SIDE + 0.3) * row, 0)
        groups[layer].instances.append(Instance(f"board {index + 1}", Plate(rng.randrange(2**31)), place))
    return groups


def with_hole_moved(part):
    return replace(part, moved=HOLE_MOVED) if isinstance(part, Plate) else part.with_hole_moved(HOLE_MOVED)


def larger(part):
    if isinstance(part, Plate):
        return replace(part, wider=LARGER)
    numbers = list(part.numbers)
    numbers[SIZES[part.kind]] += LARGER
    return replace(part, numbers=tuple(numbers))


def revised(groups: list[Group], rng: Random) -> Revision:
    copies = [Group(g.name, g.place, [replace(i) for i in g.instances]) for g in groups]
    revision = Revision(copies, {i.name: words("same") for g in groups for i in g.instances}, set(), [])
    can_move = {kind for kind, of in KINDS.items() if of.moves is not None} | {"board"}
    can_grow = {*SIZES, "board"}
    for _, instance in revision.take(rng, EDITS_OF_A_KIND, lambda i: i.part.kind in can_move):
        instance.part = with_hole_moved(instance.part)
        revision.expected[instance.name] = words("changed", distance=HOLE_MOVED)
    for _, instance in revision.take(rng, EDITS_OF_A_KIND, lambda i: i.part.kind in can_grow):
        instance.part = larger(instance.part)
        revision.expected[instance.name] = words("changed", distance=LARGER)
    for _ in range(EDITS_OF_A_KIND):
        move(revision, rng)
        turn_about_any_axis(revision, rng)
    return revision


def measured(command: str, label: str, groups: list[Group], rng: Random) -> None:
    revision = revised(groups, rng)
    with tempfile.TemporaryDirectory() as folder:
        a, b = Path(folder, "a.step"), Path(folder, "b.step")
        silently(lambda: (write(groups, a), write(revision.groups, b)))
        reading = [timed(command, "info", path) for path in (a, b)]
        started = time.monotonic()
        result, cpu = compared(command, a, b)
        wall = time.monotonic() - started
    faults, undecided = judged(result["parts"], groups, revision)
    for fault in faults:
        print(f"wrong: {fault}")
    states = dict(Counter(part["state"] for part in result["parts"]).most_common())
    print(f"{label}: {len(result['parts'])} parts, {states}, {len(faults)} wrong, {undecided} undecided")
    print(f"  info of both: {sum(w for w, _ in reading):.2f} s, {sum(c for _, c in reading):.2f} CPU s")
    print(f"  diff: {wall:.2f} s, {cpu:.2f} CPU s with reading; stated: {result['seconds']}")


def timed(command: str, *arguments: str | Path) -> tuple[float, float]:
    """Return the seconds by the clock and on the CPU."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([command, *map(str, arguments)], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.monotonic() - started, after.ru_utime - before.ru_utime


def main() -> None:
    command, count, seed = sys.argv[1], int([*sys.argv[2:3], "200"][0]), int([*sys.argv[3:4], "1"][0])
    for label, make in (("kinds", drawn), ("plates", plates)):
        if len(sys.argv) < 5 or sys.argv[4] == label:
            rng = Random(seed)
            measured(command, label, make(rng, count), rng)


if __name__ == "__main__":
    main()
