"""Real parts against themselves, rewritten by OpenCASCADE with other frames, seams and splits.

    python rewritten.py COMMAND MODELS OUT.csv [--parts A,B] [--seconds 60]

COMMAND is the native executable, MODELS the folder of the shared models. Each part of
MODELS/step is written as STEP by OpenCASCADE as it is, which is the plain copy, and after each of
the changes in CHANGES, to a temporary folder. `distance` of the part to its copies and back and
`diff` at 1e-5 of its diagonal are run; a line of OUT.csv has user seconds, those of
the search and its cells, and the whole time relative to that of the plain copy. Needs OpenCASCADE's
Python bindings (requirements.txt).
"""

import argparse
import csv
import gzip
import math
import tempfile
from pathlib import Path

from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert, BRepBuilderAPI_Sewing, BRepBuilderAPI_Transform
from OCP.ShapeUpgrade import (
    ShapeUpgrade_ShapeDivideAngle,
    ShapeUpgrade_ShapeDivideArea,
    ShapeUpgrade_ShapeDivideClosed,
    ShapeUpgrade_UnifySameDomain,
)
from OCP.STEPControl import STEPControl_Reader
from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt, gp_Trsf

import cost
from sweep.shapes import diagonal, faces, through_step

# The limit of `diff`, relative to the diagonal.
DIFF_LIMIT = 1e-5
# The turn there and back, by which coordinates lose their last digits.
TURN = gp_Ax1(gp_Pnt(1.0, 2.0, 3.0), gp_Dir(1.0, 2.0, 2.0)), 0.7
# Faces are cut to parts of at most this share of the area of a square over the diagonal.
LARGEST_PART = 0.01
# Seams are moved by cutting at a quarter of a turn.
QUARTER = 0.5 * math.pi
SEWING = 1e-6


def moved(shape, angle):
    turn = gp_Trsf()
    turn.SetRotation(TURN[0], angle)
    return BRepBuilderAPI_Transform(shape, turn, True).Shape()


def divided(divide):
    divide.Perform()
    return divide.Result()


def by_area(shape):
    divide = ShapeUpgrade_ShapeDivideArea(shape)
    divide.MaxArea = LARGEST_PART * diagonal(shape) ** 2
    return divided(divide)


def unified(shape):
    unify = ShapeUpgrade_UnifySameDomain(shape, True, True, True)
    unify.Build()
    return unify.Shape()


def sewn(shape):
    sewing = BRepBuilderAPI_Sewing(SEWING)
    for face in faces(shape):
        sewing.Add(face)
    sewing.Perform()
    return sewing.SewedShape()


CHANGES = {
    "copy": lambda shape: shape,
    "turned there and back": lambda shape: moved(moved(shape, TURN[1]), -TURN[1]),
    "closed faces divided": lambda shape: divided(ShapeUpgrade_ShapeDivideClosed(shape)),
    "divided by angle": lambda shape: divided(ShapeUpgrade_ShapeDivideAngle(QUARTER, shape)),
    "divided by area": by_area,
    "unified": unified,
    "sewn": sewn,
    "splines": lambda shape: BRepBuilderAPI_NurbsConvert(shape, True).Shape(),
}


def read_step(path):
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return reader.OneShape()


def measured(command, part, other, limit, seconds):
    """The costs of both directed distances and of the comparison of faces."""
    return {
        "there": cost.distance(command, part, other, seconds),
        "back": cost.distance(command, other, part, seconds),
        "diff": cost.diff(command, part, other, limit, seconds),
    }


def rows(options, path, folder):
    part = folder / path.stem
    part.write_bytes(gzip.open(path).read())
    shape = read_step(part)
    limit, plain = DIFF_LIMIT * diagonal(shape), None
    for name, change in CHANGES.items():
        other = folder / f"{part.stem} {name}.step"
        try:
            through_step(change(shape), other, "MM")
        except Exception as error:
            yield [part.name, name, "", f"OpenCASCADE: {error}"[:80], "", "", "", ""]
            continue
        costs = measured(options.command, part, other, limit, options.seconds)
        plain = plain or costs
        for run, found in costs.items():
            ratio = found.seconds / max(plain[run].seconds, 1e-3)
            figures = [found.status, f"{found.seconds:.2f}", f"{found.solve:.2f}", found.cells, f"{ratio:.1f}"]
            yield [part.name, name, run, *figures]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("models", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--parts", default="", help="names with commas, all by default")
    parser.add_argument("--seconds", type=int, default=60, help="longest search")
    options = parser.parse_args()
    wanted = [name for name in options.parts.split(",") if name]
    with options.out.open("w", newline="") as file, tempfile.TemporaryDirectory() as folder:
        table = csv.writer(file)
        table.writerow(["part", "change", "run", "end", "user s", "search s", "cells", "times the copy"])
        for path in sorted((options.models / "step").glob("*.gz"), key=lambda path: path.stat().st_size):
            if wanted and not any(name in path.name for name in wanted):
                continue
            for row in rows(options, path, Path(folder)):
                table.writerow(row)
                file.flush()


if __name__ == "__main__":
    main()
