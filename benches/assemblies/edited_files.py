"""What `diff` says of CAD files of other people and of copies that OpenCASCADE edited and wrote again.

    python benches/assemblies/edited_files.py COMMAND FOLDER [LIMIT [SEED]]

Of each STEP file with two bodies or more a copy is written for each edit: none; one part moved; one turned about an axis
through its middle; one removed; one renamed; one hole filled. A use of a part in a sub-assembly that is used twice is edited
in both. `diff` compares the file itself, as its own system wrote it, with each copy, to LIMIT (1e-2) in the file's unit.

Its parts are matched with OpenCASCADE's solids and open shells by area and box. A word is right if its state is that of the
edit and the part is paired with itself, or, of several that moved at once, with a copy of it; `renamed` counts for `same`
where the copy has another name, as OpenCASCADE writes some. A motion is right if it lays area, middle and second moments of
the part's surface on those of its partner. A filled hole must be as large as points of its wall and its caps are far. Words
of files of which faces are left out are counted apart.
Prints a line of JSON a comparison, and the sum.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random

import edited_shapes as shapes
import numpy as np
from assembly import silently
from edited_shapes import EDITS, Document, Leaf, Unsuitable

#: How near areas and boxes are of one body in both readings, relative to it and to its diagonal.
MATCH = 1e-3
#: How near a moved part is to the edited one, relative to its diagonal; files have gaps.
PLACE = 1e-4
#: After how many seconds `diff` says what it has.
SECONDS = "60"


@dataclass
class Side:
    """One file: OpenCASCADE's leaves, and those that each name of the command's bodies may be."""

    leaves: dict[tuple, Leaf]
    of_name: dict[str, set[tuple]]
    names: set[str]


def asked(command: str, *arguments: str | Path) -> tuple[dict, float, float]:
    """Return the command's answer, its seconds by the clock, and on the CPU."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    words = [command, *map(str, arguments), "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not done.stdout:
        raise RuntimeError(done.stderr[-300:])
    return json.loads(done.stdout), time.monotonic() - started, after.ru_utime - before.ru_utime


def read(command: str, path: Path, document: Document) -> Side:
    leaves = {leaf.key: leaf for leaf in document.leaves()}
    bodies = asked(command, "info", path)[0]["bodies"]
    of_name: dict[str, set[tuple]] = {}
    for body in bodies:
        facts = body["facts"]
        if not facts.get("area"):
            continue
        area = facts["area"]["upper"]
        box = np.array([[x["lower"] for x in facts[side]] for side in ("min", "max")])
        size = np.linalg.norm(box[1] - box[0])
        of_name[body["fullName"]] = {
            key
            for key, leaf in leaves.items()
            if abs(leaf.area - area) <= MATCH * area and np.abs(leaf.box - box).max() <= MATCH * size
        }
    return Side(leaves, of_name, {body["fullName"] for body in bodies})


def judged(parts: list[dict], a: Side, b: Side, edit: shapes.Edit) -> tuple[Counter, list[str]]:
    """Return the words by right, wrong, undecided and not compared, and what is wrong."""
    counts: Counter[str] = Counter()
    faults = []
    for part in parts:
        name = part["nameOfA"] or part["nameOfB"]
        keys = a.of_name.get(part["nameOfA"] or "", set())
        others = b.of_name.get(part["nameOfB"] or "", set())
        is_known = (keys or part["nameOfA"] is None) and (others or part["nameOfB"] is None)
        if not is_known:
            counts["not compared"] += 1
        elif part["state"] == "undecided":
            counts["undecided"] += 1
        else:
            fault = next(iter(wrong_of(part, keys, others, a, b, edit)), None)
            is_of_copy = bool(keys and others and not keys & others)
            counts["wrong" if fault else "right, of a copy" if is_of_copy else "right"] += 1
            if fault:
                faults.append(f"{name}: {part['state']}: {fault}")
    return counts, faults


def wrong_of(part: dict, keys: set, others: set, a: Side, b: Side, edit: shapes.Edit) -> Iterator[str]:
    state = part["state"]
    if state == "added":
        yield "nothing was added"
        return
    touched = keys & edit.touched
    # Copies in one place are one part as well as another.
    if state == "removed":
        if edit.label != "removed" or not touched:
            yield "it was not removed"
        return
    key, other = next(((key, key) for key in keys & others), (next(iter(keys)), next(iter(others))))
    if key != other and not (keys <= edit.touched and others <= edit.touched and state == "moved"):
        yield f"paired with another part, {part['nameOfB']}"
        return
    has_new_name = part["nameOfA"] not in b.names or part["nameOfB"] not in a.names
    if not touched or edit.label == "none":
        expected = {"same", "renamed"} if has_new_name else {"same"}
    else:
        expected = {
            "moved": {"moved"},
            "turned": {"moved"},
            "removed": {"removed"},
            "renamed": {"renamed"},
            "filled": {"changed"},
        }[edit.label]
    if state not in expected:
        # A part that its motion lays on itself has not moved.
        is_in_place = a.leaves[key].is_as(b.leaves[key], PLACE)
        if not (touched and edit.label == "turned" and state in ("same", "renamed") and is_in_place):
            yield f"expected {' or '.join(sorted(expected))}"
            return
    if state == "moved" and not a.leaves[key].is_as(b.leaves[other], PLACE, part["motion"]):
        yield f"by another motion, {part['motion']}"
    if state == "changed" and edit.size is not None:
        sampled, spacing = edit.size
        if part["upper"] < sampled * (1 - 1e-6) - 1e-6 or part["lower"] > sampled + spacing + 1e-6:
            yield f"[{part['lower']}, {part['upper']}], but points are {sampled} off"


def main() -> None:
    command, folder = sys.argv[1:3]
    limit, seed = [*sys.argv[3:4], "1e-2"][0], int([*sys.argv[4:5], "1"][0])
    total: Counter[str] = Counter()
    words: Counter[str] = Counter()
    for path in sorted(Path(folder).iterdir()):
        if path.suffix.lower() not in (".step", ".stp"):
            continue
        original: list[Document] = []
        silently(lambda: original.append(Document(path)))
        a = read(command, path, original[0])
        if len(a.names) < 2:
            continue
        bodies = set().union(*(keys for keys in a.of_name.values() if len(keys) == 1))
        for label, change in EDITS.items():
            line: dict[str, object] = {"file": path.name, "edit": label}
            with tempfile.TemporaryDirectory() as place:
                copy = Path(place, "copy.step")
                made: list[tuple[Document, shapes.Edit]] = []

                def make() -> None:
                    document = Document(path)
                    edit = change(document, Random(f"{seed} {path.name}"), bodies)
                    document.write(copy)
                    made.append((Document(copy, document), edit))

                try:
                    silently(make)
                except Unsuitable as error:
                    print(json.dumps(line | {"left out": str(error)}), flush=True)
                    continue
                document, edit = made[0]
                b = read(command, copy, document)
                result, wall, cpu = asked(command, "diff", path, copy, "--limit", limit, "--max-seconds", SECONDS)
            parts = result.get("parts", [])
            counts, faults = judged(parts, a, b, edit)
            left_out = sum(len(faces) for faces in result["skipped"].values())
            if left_out:
                # The parts are then those of the faces that were read.
                counts = Counter({"of files with faces left out": len(parts)})
                line["facesLeftOut"] = left_out
            total.update(counts)
            words.update(part["state"] for part in parts)
            states = dict(Counter(part["state"] for part in parts))
            times = {"seconds": round(wall, 1), "cpuSeconds": round(cpu, 1)}
            print(json.dumps(line | {"states": states, **counts, "faults": faults} | times), flush=True)
    print(json.dumps({"words": dict(words), **total}))


if __name__ == "__main__":
    main()
