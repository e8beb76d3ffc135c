"""Compare assemblies with revisions by known edits, and count the words of `diff` that are wrong.

    python benches/assemblies/revisions.py COMMAND [COUNT [SEED]]

COMMAND is the built command line. Every revision has one edit of the table in `edits.py`, in turn, and up to two
others. Three errors are counted: a state that is not one of the expected states of the edit, a motion of a part without
symmetry that differs from the edit's, and an interval that does not contain the size of a change. Undecided states are
counted apart. The files of a revision with an error stay in `wrong/`; the table goes to standard output.
"""

from __future__ import annotations

import json
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from random import Random

from assembly import Group, drawn, silently, write
from edits import EDITS, Expected, Revision, revised
from OCP.gp import gp_Pnt, gp_Trsf
from placement import largest_difference, product

LIMIT = 1e-3
# A motion is proven to the limit at the part; points of it are compared to a few times that.
MOTION_TOLERANCE = 5 * LIMIT
# What the files' decimals and the frames change of a hole's way.
FILE_TOLERANCE = 1e-9
POINTS = [(0.0, 0.0, 0.0), (20.0, 0.0, 0.0), (0.0, 20.0, 0.0), (0.0, 0.0, 20.0)]


def main() -> None:
    command, count, seed = sys.argv[1], int((sys.argv[2:3] or ["300"])[0]), int((sys.argv[3:4] or ["1"])[0])
    states, undecided, wrong, seconds = Counter(), 0, 0, []
    for index in range(count):
        rng = Random(seed + index)
        groups = drawn(rng, rng.randint(3, 24))
        revision = revised(groups, rng, list(EDITS)[index % len(EDITS)])
        with tempfile.TemporaryDirectory() as folder:
            a, b = Path(folder, "a.step"), Path(folder, "b.step")
            silently(lambda: (write(groups, a), write(revision.groups, b)))
            result, cpu = compared(command, a, b)
            faults, open_words = judged(result["parts"], groups, revision)
            if faults:
                kept = Path("wrong", str(seed + index))
                kept.mkdir(parents=True, exist_ok=True)
                shutil.copy(a, kept)
                shutil.copy(b, kept)
        seconds.append(cpu)
        states.update(part["state"] for part in result["parts"])
        undecided += open_words
        wrong += bool(faults)
        for fault in faults:
            print(f"{seed + index} ({', '.join(revision.labels)}): {fault}", flush=True)
    seconds.sort()
    print(f"{count} revisions, seeds from {seed}: {wrong} with a wrong word, {undecided} words undecided")
    print(f"words: {dict(states.most_common())}")
    print(f"CPU seconds: median {seconds[count // 2]:.2f}, largest {seconds[-1]:.2f}")


def compared(command: str, a: Path, b: Path) -> tuple[dict, float]:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = [command, "diff", str(a), str(b), "--limit", str(LIMIT), "--json"]
    answer = subprocess.run(arguments, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not answer.stdout:
        raise RuntimeError(answer.stderr)
    return json.loads(answer.stdout), after.ru_utime - before.ru_utime


def judged(parts: list[dict], groups: list[Group], revision: Revision) -> tuple[list[str], int]:
    """Return what is wrong with the words, and how many are undecided."""
    faults, undecided, said = [], 0, set()
    places = {i.name: product(g.place, i.place) for g in groups for i in g.instances}
    for part in parts:
        name = instance_of(part["nameOfA"] or part["nameOfB"])
        said.add(name)
        expected = revision.expected.get(name)
        if expected is None:
            faults.append(f"{name}: {part['state']}, a part that is none")
        elif part["state"] == "undecided":
            undecided += 1
        elif part["state"] not in expected.states:
            faults.append(f"{name}: {part['state']}, expected {' or '.join(sorted(expected.states))}")
        else:
            faults.extend(f"{name}: {fault}" for fault in numbers(part, expected, places.get(name)))
    faults.extend(f"{name}: not listed" for name in revision.expected.keys() - said)
    return faults, undecided


def instance_of(path: str) -> str:
    """Return the instance's name; behind a product of another name it stands in parentheses."""
    name = path.split(" / ")[2]
    return name[name.index("(") + 1 : -1] if name.endswith(")") else name


def numbers(part: dict, expected: Expected, place: gp_Trsf | None) -> list[str]:
    """Return what is wrong with the motion and the interval of a part whose word is right."""
    faults = []
    if expected.motion is not None:
        off = largest_difference(part["motion"], expected.motion, [gp_Pnt(*p).Transformed(place) for p in POINTS])
        if off > MOTION_TOLERANCE:
            faults.append(f"the motion is {off:.3g} off")
    if expected.distance is not None:
        holds = part["lower"] <= expected.distance + FILE_TOLERANCE
        if not (holds and expected.distance - FILE_TOLERANCE <= part["upper"]):
            faults.append(f"{expected.distance} is not in [{part['lower']}, {part['upper']}]")
    return faults


if __name__ == "__main__":
    main()
