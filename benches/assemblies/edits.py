"""Edits of an assembly, each with the states that are expected for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from random import Random

from assembly import Group, Instance, SPACING
from OCP.gp import gp_Trsf
from parts import KINDS, draw
from placement import direction, mirror_in_x, product, random_turn, translation, turn

HOLE_MOVED = 0.01
HOLE_MOVED_FAR = 0.3


@dataclass(frozen=True)
class Expected:
    """The states that are right for one part; of a part without symmetry the motion; of a change its size."""

    states: frozenset[str]
    motion: gp_Trsf | None = None
    distance: float | None = None


def words(*states: str, motion: gp_Trsf | None = None, distance: float | None = None) -> Expected:
    return Expected(frozenset(states), motion, distance)


@dataclass
class Revision:
    """The second revision in the making: `expected` by the names of the first, of added parts by their own."""

    groups: list[Group]
    expected: dict[str, Expected]
    touched: set[str]
    labels: list[str]

    def take(self, rng: Random, count: int = 1, suits: Callable[[Instance], bool] = lambda _: True):
        """Return instances that no edit has touched, with their groups, or nothing if there are too few."""
        free = [
            (group, instance)
            for group in self.groups
            for instance in group.instances
            if instance.name not in self.touched and suits(instance)
        ]
        if len(free) < count:
            return []
        taken = rng.sample(free, count)
        self.touched.update(instance.name for _, instance in taken)
        return taken


def moved(motion: gp_Trsf, group: Group, instance: Instance) -> Expected:
    """Move an instance in the frame of its group; the expected motion is that of the whole assembly's frame."""
    instance.place = product(motion, instance.place)
    return words("moved", motion=world(motion, group) if instance.part.turns is None else None)


def world(motion: gp_Trsf, group: Group) -> gp_Trsf:
    return product(group.place, motion, group.place.Inverted())


def move(revision: Revision, rng: Random) -> None:
    for group, instance in revision.take(rng):
        length = 10 ** rng.uniform(-1, 1.3)
        by = translation(*(length * x for x in direction(rng)))
        revision.expected[instance.name] = moved(by, group, instance)


def turn_about_any_axis(revision: Revision, rng: Random) -> None:
    for group, instance in revision.take(rng):
        at = instance.place.TranslationPart()
        through = tuple(at.Coord(i + 1) + rng.uniform(-20, 20) for i in range(3))
        motion = turn(direction(rng), rng.uniform(5, 175), through)
        revision.expected[instance.name] = moved(motion, group, instance)


def turn_on_itself(revision: Revision, rng: Random) -> None:
    for _, instance in revision.take(rng, suits=lambda i: i.part.turns is not None):
        angle = instance.part.turns or rng.uniform(5, 355)
        instance.place = product(instance.place, turn((0, 0, 1), angle))


def move_hole(revision: Revision, rng: Random) -> None:
    for _, instance in revision.take(rng, suits=lambda i: KINDS[i.part.kind].moves is not None):
        instance.part = instance.part.with_hole_moved(HOLE_MOVED)
        revision.expected[instance.name] = words("changed", distance=HOLE_MOVED)


def move_and_change(revision: Revision, rng: Random) -> None:
    for group, instance in revision.take(rng, suits=lambda i: i.part.turns is None):
        by = world(translation(*(rng.uniform(2, 10) for _ in range(3))), group)
        moved(by, group, instance)
        instance.part = instance.part.with_hole_moved(HOLE_MOVED_FAR)
        revision.expected[instance.name] = words("movedAndChanged", distance=HOLE_MOVED_FAR)


def replace_part(revision: Revision, rng: Random) -> None:
    for _, instance in revision.take(rng):
        others = [kind for kind in KINDS if kind != instance.part.kind]
        instance.part = draw(rng, others)
        # Another product under the same name of its use is another part, if not at its place.
        revision.expected[instance.name] = words("changed", "removed", "added")


def add(revision: Revision, rng: Random) -> None:
    group = rng.choice(revision.groups)
    place = product(translation(-2 * SPACING, rng.uniform(0, 3) * SPACING, 0), random_turn(rng))
    name = f"cover {len(revision.expected) + 1}"
    group.instances.append(Instance(name, draw(rng), place))
    revision.touched.add(name)
    revision.expected[name] = words("added")


def remove(revision: Revision, rng: Random) -> None:
    of_several = [id(i) for g in revision.groups if len(g.instances) > 1 for i in g.instances]
    for group, instance in revision.take(rng, suits=lambda i: id(i) in of_several):
        group.instances.remove(instance)
        revision.expected[instance.name] = words("removed")


def rename(revision: Revision, rng: Random) -> None:
    for _, instance in revision.take(rng):
        revision.expected[instance.name] = words("renamed")
        instance.name = f"{instance.name} new"
        revision.touched.add(instance.name)


def permute_copies(revision: Revision, rng: Random) -> None:
    for group in revision.groups:
        for one in group.instances:
            for other in group.instances:
                is_copy = other is not one and other.part == one.part and not other.is_mirrored
                if is_copy and not {one.name, other.name} & revision.touched:
                    one.place, other.place = other.place, one.place
                    revision.touched.update((one.name, other.name))
                    return


def mirror(revision: Revision, rng: Random) -> None:
    for _, instance in revision.take(rng):
        instance.is_mirrored = True
        states = ("mirrored",) if instance.part.is_chiral else ("moved", "same")
        revision.expected[instance.name] = words(*states)


def move_group(revision: Revision, rng: Random) -> None:
    whole = [g for g in revision.groups if not {i.name for i in g.instances} & revision.touched]
    if not whole:
        return
    group = rng.choice(whole)
    motion = translation(*(rng.uniform(5, 20) for _ in range(3)))
    group.place = product(motion, group.place)
    for instance in group.instances:
        revision.touched.add(instance.name)
        is_unique = instance.part.turns is None
        revision.expected[instance.name] = words("moved", motion=motion if is_unique else None)


def export_in_other_frames(revision: Revision, rng: Random) -> None:
    for group in revision.groups:
        for instance in group.instances:
            shift = translation(*(rng.uniform(-50, 50) for _ in range(3)))
            instance.frame = product(shift, random_turn(rng))


def export_in_another_order(revision: Revision, rng: Random) -> None:
    rng.shuffle(revision.groups)
    for group in revision.groups:
        rng.shuffle(group.instances)


EDITS = {
    "move": move,
    "turn": turn_about_any_axis,
    "turn on itself": turn_on_itself,
    "move a hole by 0.01": move_hole,
    "move, and move a hole": move_and_change,
    "replace": replace_part,
    "add": add,
    "remove": remove,
    "rename": rename,
    "permute copies": permute_copies,
    "mirror": mirror,
    "move a group": move_group,
    "other frames": export_in_other_frames,
    "another order": export_in_another_order,
}


def revised(groups: list[Group], rng: Random, first: str) -> Revision:
    """Return a revision by the edit of this name, and by up to two others at random."""
    copies = [Group(g.name, g.place, [replace(i) for i in g.instances]) for g in groups]
    expected = {i.name: words("same") for g in groups for i in g.instances}
    revision = Revision(copies, expected, set(), [])
    for label in [first, *rng.sample(list(EDITS), rng.randint(0, 2))]:
        EDITS[label](revision, rng)
        revision.labels.append(label)
    return revision
