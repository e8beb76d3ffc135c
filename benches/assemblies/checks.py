"""Check assemblies of pairs with known contacts, and count the words of `check` that are wrong.

    python benches/assemblies/checks.py COMMAND [PAIRS [ASSEMBLIES [SEED]]]

Each assembly has PAIRS pairs of `contacts.py`, each turned at random in a cell of its own, so that no others are near.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from random import Random

from assembly import named, silently
from contacts import CONTACTS, Contact
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_DocumentTool
from placement import product, random_turn, translation

BELOW = 0.5
SPACING = 60.0
# What the decimals of a file change.
FILE_TOLERANCE = 1e-7


def main() -> None:
    command = sys.argv[1]
    pairs, assemblies, seed = (int(value) for value in [*sys.argv[2:5], *["12", "25", "1"][len(sys.argv) - 2 :]])
    states, wrong, undecided, seconds = Counter(), 0, 0, []
    for index in range(assemblies):
        rng = Random(seed + index)
        contacts = [CONTACTS[(index + place) % len(CONTACTS)](rng) for place in range(pairs)]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "assembly.step")
            silently(lambda: write(contacts, path, rng))
            result, cpu = checked(command, path)
        seconds.append((cpu, result["seconds"]))
        faults, left = judged(result, contacts)
        states.update(pair["state"] for pair in result["pairs"])
        wrong, undecided = wrong + len(faults), undecided + left
        for fault in faults:
            print(f"{seed + index}: {fault}", flush=True)
    print(f"{assemblies} assemblies of {2 * pairs} bodies: {wrong} wrong, {undecided} undecided; {dict(states)}")
    seconds.sort(key=lambda one: one[0])
    print(f"CPU seconds with reading: median {seconds[assemblies // 2][0]:.2f}, largest {seconds[-1][0]:.2f}")
    print(f"seconds of the slowest: {seconds[-1][1]}")


def write(contacts: list[Contact], path: Path, rng: Random) -> None:
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    root = named(tool.NewShape(), "assembly")
    for index, contact in enumerate(contacts):
        cell = translation(SPACING * (index % 8), SPACING * (index // 8 % 8), SPACING * (index // 64))
        place = TopLoc_Location(product(cell, random_turn(rng)))
        for side, body in zip("ab", contact.bodies):
            name = f"{side}{index}"
            named(tool.AddComponent(root, named(tool.AddShape(body, False), name), place), name)
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.Transfer(document)
    writer.Write(str(path))


def checked(command: str, path: Path) -> tuple[dict, float]:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = [command, "check", str(path), "--below", str(BELOW), "--json"]
    answer = subprocess.run(arguments, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if not answer.stdout:
        raise RuntimeError(answer.stderr)
    return json.loads(answer.stdout), after.ru_utime - before.ru_utime


def judged(result: dict, contacts: list[Contact]) -> tuple[list[str], int]:
    """Return what is wrong, and how many pairs are undecided."""
    faults, undecided, listed = [], 0, {}
    for pair in result["pairs"]:
        one, other = (pair[side].split(" / ")[-1] for side in "ab")
        if one[1:] != other[1:]:
            if pair["state"] not in ("apart", "undecided"):
                faults.append(f"{one} and {other} are {pair['state']}")
            continue
        listed[int(one[1:])] = pair
    for index, contact in enumerate(contacts):
        pair = listed.get(index, {"state": "apart"})
        if pair["state"] == "undecided":
            undecided += 1
            print(f"undecided: {contact.label}: {pair['why']}")
        elif pair["state"] not in contact.states:
            faults.append(f"{contact.label}: {pair['state']}")
        else:
            faults.extend(f"{contact.label}: {fault}" for fault in numbers(pair, contact))
    return faults, undecided


def numbers(pair: dict, contact: Contact) -> list[str]:
    """Return which intervals do not hold what is known."""
    faults = []
    for name, known in (("clearance", contact.clearance), ("volume", contact.volume)):
        if known is None or pair.get(name) is None:
            continue
        lower, upper = pair[name]["lower"], pair[name]["upper"]
        slack = FILE_TOLERANCE * max(1.0, known)
        if not (lower - slack <= known <= upper + slack):
            faults.append(f"{name} {known} is not in [{lower}, {upper}]")
    return faults


if __name__ == "__main__":
    main()
