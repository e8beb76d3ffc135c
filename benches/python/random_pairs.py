"""Pairs of random parts for score_rates.py.

    python random_pairs.py FOLDER [--pairs COUNT] [--seed FIRST]

Each truth is a solid of 10 to 100 faces from `benches/trimmed/parts`; its candidate is the same part with
one drawn number moved by a twentieth of its range, so that most faces agree and some do not. Writes
NAME_a.step (truth) and NAME_b.step (candidate). Each part is made in a process of its own, as
OpenCASCADE may end it. It needs cadquery-ocp.
"""

import argparse
import multiprocessing
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "trimmed"))

#: Solids with plane, conic, free-form, blended, offset, mirrored and sheared faces.
KINDS = (
    "bool_box",
    "bool_sphere",
    "fillet_variable",
    "fillet_all",
    "fillet_bore",
    "chamfer",
    "draft",
    "shell",
    "offset_shape",
    "mirrored",
    "gtrsf",
    "wedge_mix",
    "many_holes",
    "nut",
    "sliver",
)
FACES = (10, 100)
EDIT = 0.05
FIRST_SEED = 700
PAIRS = 20
#: Seeds of each kind that are tried until there are enough pairs.
SEEDS = 200
SECONDS = 60


def edited(numbers, name):
    """Return numbers of the same seed, of which one is moved by a part of its range."""

    class Edited(type(numbers)):
        used = ()

        def real(self, of, low, high):
            self.used = (*self.used, of)
            return super().real(of, low, high) + (EDIT * (high - low) if of == name else 0.0)

    return Edited(numbers._seed)


def made(kind, seed, folder):
    """Write the files of a pair if both are valid solids with faces as many as asked for."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
    from OCP.TopAbs import TopAbs_FACE, TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer
    from parts import KINDS as MAKERS
    from parts.numbers import Numbers

    def count(shape, of):
        found, number = TopExp_Explorer(shape, of), 0
        while found.More():
            found.Next()
            number += 1
        return number

    start = Numbers(f"{kind}{seed}")
    recorded = edited(start, None)
    truth = MAKERS[kind](recorded)
    # Poses are no edits of a part.
    names = sorted(name for name in set(recorded.used) if not name.startswith("pose"))
    name = random.Random(f"{kind}{seed}/edit").choice(names)
    shapes = {"a": truth, "b": MAKERS[kind](edited(start, name))}
    for shape in shapes.values():
        if not (FACES[0] <= count(shape, TopAbs_FACE) <= FACES[1] and count(shape, TopAbs_SOLID) >= 1):
            raise ValueError("not a solid of that many faces")
        if not BRepCheck_Analyzer(shape).IsValid():
            raise ValueError("OpenCASCADE calls it invalid")
    for which, shape in shapes.items():
        writer = STEPControl_Writer()
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        writer.Write(str(folder / f"{kind}_{seed}_{which}.step"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pairs", type=int, default=PAIRS)
    parser.add_argument("--seed", type=int, default=FIRST_SEED)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    written = 0
    for seed in range(arguments.seed, arguments.seed + SEEDS):
        for kind in KINDS:
            if written == arguments.pairs:
                return
            process = multiprocessing.Process(target=made, args=(kind, seed, arguments.folder))
            process.start()
            process.join(SECONDS)
            if process.is_alive():
                process.kill()
                process.join()
            written += process.exitcode == 0


if __name__ == "__main__":
    main()
