"""Whether the clashes that `check` finds in CAD files of other people are OpenCASCADE's too.

    python benches/assemblies/check_files_peers.py COMMAND FOLDER [SECONDS [PAIRS]]

A line of JSON a file with two bodies or more. OpenCASCADE reads the file by itself: STEP, BREP text, and the shapes
within documents of FreeCAD. Its solids are matched with the command's bodies by volume and centroid. For each pair that
the command calls `clash` or `touching` (at most PAIRS a file, 40), a boolean of the two solids gives a common volume:
within the command's interval of a clash, up to SLACK; none where it says `touching`. A boolean of its own process that
fails or takes more than SECONDS (20) counts as failed. The point of a clash is classified by both solids besides. What
disagrees is listed, to be looked at.
"""

from __future__ import annotations

import json
import multiprocessing
import queue
import subprocess
import sys
import tempfile
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from assembly import silently
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.gp import gp_Pnt
from OCP.GProp import GProp_GProps
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_ShapeEnum, TopAbs_State
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS_Shape

#: What OpenCASCADE's integrals and booleans may be off, relative to the smaller body.
SLACK = 1e-5
#: How near volumes and centroids of one body are, relative to it and to its size.
MATCH = 1e-3


def read_step(path: Path) -> list[TopoDS_Shape]:
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return [reader.OneShape()]


def read_brep(path: Path) -> list[TopoDS_Shape]:
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, str(path), BRep_Builder())
    return [shape]


def read_freecad(path: Path) -> list[TopoDS_Shape]:
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(path) as archive:
        names = [name for name in archive.namelist() if name.endswith((".brp", ".brep"))]
        return [shape for name in names for shape in read_brep(Path(archive.extract(name, folder)))]


READERS: dict[str, Callable[[Path], list[TopoDS_Shape]]] = {
    **dict.fromkeys([".step", ".stp"], read_step),
    ".brep": read_brep,
    ".fcstd": read_freecad,
}


def solids(shape: TopoDS_Shape) -> Iterator[TopoDS_Shape]:
    explorer = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def mass(shape: TopoDS_Shape, accuracy: float = 1e-6) -> tuple[float, np.ndarray]:
    """Return the volume and the centroid of a solid; OpenCASCADE takes minutes for some where more is asked."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, accuracy)
    middle = properties.CentreOfMass()
    return properties.Mass(), np.array([middle.X(), middle.Y(), middle.Z()])


def middle(interval: dict[str, float]) -> float:
    return 0.5 * (interval["lower"] + interval["upper"])


def matched(bodies: list[dict], shapes: list[TopoDS_Shape]) -> dict[str, tuple[TopoDS_Shape, float]]:
    """Return the solid of each body that has exactly one, with its volume, by the body's full name."""
    found: dict[str, tuple[TopoDS_Shape, float]] = {}
    masses = [(shape, *mass(shape, 0.1 * MATCH)) for shape in shapes]
    repeated = Counter(body["fullName"] for body in bodies)
    for body in bodies:
        facts = body["facts"]
        if not facts.get("volume") or not facts.get("centroid") or repeated[body["fullName"]] > 1:
            continue
        volume, centroid = middle(facts["volume"]), np.array([middle(x) for x in facts["centroid"]])
        size = abs(volume) ** (1 / 3)
        alike = [
            shape
            for shape, own, at in masses
            if abs(abs(own) - abs(volume)) <= MATCH * abs(volume) and np.linalg.norm(at - centroid) <= MATCH * size
        ]
        # Several solids of one place are copies of each other: any does.
        if alike:
            found[body["fullName"]] = (alike[0], abs(volume))
    return found


def is_inside(solid: TopoDS_Shape, point: list[float]) -> bool:
    classifier = BRepClass3d_SolidClassifier(solid)
    classifier.Perform(gp_Pnt(*point), 1e-7)
    return classifier.State() == TopAbs_State.TopAbs_IN


def common(one: TopoDS_Shape, other: TopoDS_Shape, answer: multiprocessing.Queue) -> None:
    boolean = BRepAlgoAPI_Common(one, other)
    answer.put(sum(abs(mass(solid)[0]) for solid in solids(boolean.Shape())) if boolean.IsDone() else None)


def volume_in_common(one: TopoDS_Shape, other: TopoDS_Shape, seconds: float) -> float | None:
    context = multiprocessing.get_context("fork")
    answer = context.Queue()
    process = context.Process(target=lambda: silently(lambda: common(one, other, answer)))
    process.start()
    try:
        return answer.get(timeout=seconds)
    except queue.Empty:
        return None
    finally:
        process.kill()
        process.join()


def compared(command: str, path: Path, seconds: float, most: int) -> dict[str, object] | None:
    def asked(*arguments: str) -> dict:
        done = subprocess.run([command, *arguments, "--json", str(path)], capture_output=True, text=True)
        return json.loads(done.stdout)

    checked = asked("check", "--max-seconds", "60")
    pairs = [pair for pair in checked.get("pairs", []) if pair["state"] in ("clash", "touching")]
    # Clashes first, the largest ones first.
    pairs.sort(key=lambda pair: -middle(pair["volume"]) if pair["volume"] else 0.0)
    if not pairs:
        return None
    read: list[TopoDS_Shape] = []
    silently(lambda: read.extend(READERS[path.suffix.lower()](path)))
    shapes = [solid for shape in read for solid in solids(shape)]
    of_body = matched(asked("info")["bodies"], shapes)
    counts: Counter[str] = Counter()
    disagree = []
    for pair in pairs[:most]:
        if pair["a"] not in of_body or pair["b"] not in of_body:
            counts["unmatched"] += 1
            continue
        (one, first), (other, second) = of_body[pair["a"]], of_body[pair["b"]]
        if pair["state"] == "clash":
            both = is_inside(one, pair["point"]) and is_inside(other, pair["point"])
            counts["points inside both" if both else "points not inside both"] += 1
        volume = volume_in_common(one, other, seconds)
        if volume is None:
            counts["failed"] += 1
            continue
        lower, upper = (pair["volume"]["lower"], pair["volume"]["upper"]) if pair["volume"] else (0.0, 0.0)
        slack = SLACK * min(first, second)
        agrees = lower - slack <= volume <= upper + slack
        counts[f"{pair['state']} {'agrees' if agrees else 'differs'}"] += 1
        if not agrees:
            disagree.append([pair["a"], pair["b"], pair["state"], lower, upper, volume])
    return {"file": path.name, "bodies": len(checked["bodies"]), **counts, "differ": disagree}


def main() -> None:
    command, folder = sys.argv[1:3]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 20.0
    most = int(sys.argv[4]) if len(sys.argv) > 4 else 40
    for path in sorted(Path(folder).iterdir()):
        if path.suffix.lower() in READERS:
            try:
                line = compared(command, path, seconds, most)
            except (ValueError, KeyError, TypeError, RuntimeError) as error:
                line = {"file": path.name, "failed": f"{type(error).__name__}: {error}"}
            if line is not None:
                print(json.dumps(line), flush=True)


if __name__ == "__main__":
    main()
