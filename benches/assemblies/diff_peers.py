"""What other tools say of two revisions of an assembly of 15 parts that differ by one known edit: argus-diff and caddiff.

    python benches/assemblies/diff_peers.py COMMAND [SEED...]

The edits are those of `edits.py`, each by itself (seeds 5 and 11 where none is given). `argus` of argus-diff is asked where
it is on the path. caddiff (`pip install --no-deps caddiff`) is asked for its bill of materials and its geometric differences
where FREECAD_PYTHON names a Python that imports FreeCAD; its pictures are not made. A tool is right of an edit if it names a
difference where there is one, and none where there is none: an order, a frame, a turn of a part on itself and a mirror of
a part that is its own image change nothing. Prints a line a revision and the sums, with CPU seconds.
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from random import Random

from assembly import Group, drawn, silently, write
from edits import EDITS, Revision, words
from revisions import compared, judged

PARTS = 15


def by_argus(a: Path, b: Path) -> str:
    done = subprocess.run(["argus", "diff", str(a), str(b)], capture_output=True, text=True, cwd=a.parent)
    text = done.stdout + done.stderr
    return "; ".join(line.strip() for line in text.splitlines() if any(word in line.lower() for word in ARGUS_WORDS))


ARGUS_WORDS = ("modified", "added", "removed", "renamed", "unchanged", "moved", "error")


def by_caddiff(a: Path, b: Path) -> str:
    """Return what the first two steps of caddiff find: products in one file only, other counts, other geometry."""
    package = Path(find_spec("caddiff").origin).parent
    for step, arguments in (("bom_diff", [a, b, "bom.json"]), ("geom_diff", ["bom.json", a, b, "geom.json"])):
        words = [os.environ["FREECAD_PYTHON"], str(package / f"{step}.py"), *map(str, arguments)]
        done = subprocess.run(words, capture_output=True, text=True, cwd=a.parent, check=False)
        if done.returncode < 0 or not (a.parent / arguments[-1 if step == "geom_diff" else 2]).exists():
            return f"failed: {step}, {done.returncode}"
    bom, found = (json.loads((a.parent / name).read_text()) for name in ("bom.json", "geom.json"))
    said = [f"{word} {name}" for word in ("removed", "added") for name in bom[word]]
    said += [f"counts of {one['base_name']}" for one in bom["candidates"] if not one["count_match"]]
    for entry in found["geometric_diffs"]:
        changes = Counter(change.get("change_type", "differs") for change in entry["geometric_changes"])
        said.append(f"{entry['base_name']} {dict(changes) or entry.get('note', '')}")
    failed = [one["name"] for one in found["skipped_parts"] if one["reason"] != "assembly_container"]
    return "; ".join(said) + (f" (not compared: {', '.join(failed)})" if failed else "")


def main() -> None:
    command, seeds = sys.argv[1], list(map(int, sys.argv[2:])) or [5, 11]
    tools = {"argus-diff": by_argus} if shutil.which("argus") else {}
    if "FREECAD_PYTHON" in os.environ and find_spec("caddiff"):
        tools["caddiff"] = by_caddiff
    right: Counter[str] = Counter()
    seconds: Counter[str] = Counter()
    count = 0
    for seed in seeds:
        for label, edit in EDITS.items():
            rng = Random(seed)
            groups = drawn(rng, PARTS)
            copies = [Group(g.name, g.place, [replace(i) for i in g.instances]) for g in groups]
            revision = Revision(copies, {i.name: words("same") for g in groups for i in g.instances}, set(), [])
            edit(revision, rng)
            is_changed = any("same" not in one.states for one in revision.expected.values())
            count += 1
            with tempfile.TemporaryDirectory() as folder:
                a, b = Path(folder, "a.step"), Path(folder, "b.step")
                silently(lambda: (write(groups, a), write(revision.groups, b)))
                result, cpu = compared(command, a, b)
                faults, undecided = judged(result["parts"], groups, revision)
                right["ours"] += not faults and not undecided
                seconds["ours"] += cpu
                print(f"{seed} {label}, {'changed' if is_changed else 'unchanged'}")
                print(f"  ours: {dict(Counter(part['state'] for part in result['parts']))} {faults}")
                for name, tool in tools.items():
                    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
                    said = tool(a, b)
                    seconds[name] += resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
                    print(f"  {name}: {said or 'no difference'}", flush=True)
    print(f"{count} revisions; ours right in all words: {right['ours']}")
    print({name: round(spent / count, 2) for name, spent in seconds.items()})


if __name__ == "__main__":
    main()
