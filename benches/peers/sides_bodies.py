"""Compares the sides of points with those of bodies known from formulas.

    python3 benches/peers/sides_bodies.py points FOLDER
    cargo bench --bench sides -- FOLDER/*
    python3 benches/peers/sides_bodies.py compare FOLDER

Needs cadquery-ocp, libigl and numpy. `points` writes to FOLDER as STEP bodies that OpenCASCADE makes of half
spaces, balls, cylinders, cones and tori, each turned and moved, and for each the points of sides_occt.py.
`compare` prints how many points the bench put on another side than the formulas do.
"""

import sys
from pathlib import Path

import numpy as np
import sides_occt
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
    BRepPrimAPI_MakeWedge,
)
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt, gp_Quaternion, gp_Trsf, gp_Vec
from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer
from OCP.TopoDS import TopoDS_Compound

# Where bodies stand: turned about no axis of theirs, off the origin.
TURN = np.array([0.2, -0.5, 0.3, 0.7])
PLACE = np.array([3.0, -7.0, 11.0])

# Points nearer to the boundary than this are on either side: coordinates in the files have twelve digits.
ROUNDING = 2e-11


def axes(direction):
    return gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(*direction))


def frame(direction):
    along = np.array(direction) / np.linalg.norm(direction)
    return lambda p: (p @ along, np.linalg.norm(p - np.outer(p @ along, along), axis=1))


def box(low, high):
    """A box, as the shape and its formula, which is below 0 inside; so are all bodies here."""
    shape = BRepPrimAPI_MakeBox(gp_Pnt(*low), gp_Pnt(*high)).Shape()
    return shape, lambda p: np.max(np.maximum(np.array(low) - p, p - np.array(high)), axis=1)


def ball(centre, radius):
    shape = BRepPrimAPI_MakeSphere(gp_Pnt(*centre), radius).Shape()
    return shape, lambda p: np.linalg.norm(p - np.array(centre), axis=1) - radius


def cylinder(direction, radius, length):
    place, shape_axes = frame(direction), axes(direction)
    shape = BRepPrimAPI_MakeCylinder(shape_axes, radius, length).Shape()

    def formula(p):
        height, across = place(p)
        return np.maximum(across - radius, np.maximum(-height, height - length))

    return shape, formula


def cone(low, high, length):
    """A frustum about z; its slope is below 1."""
    shape = BRepPrimAPI_MakeCone(low, high, length).Shape()

    def formula(p):
        height, across = p[:, 2], np.linalg.norm(p[:, :2], axis=1)
        return np.maximum(across - low - (high - low) * height / length, np.maximum(-height, height - length))

    return shape, formula


def torus(radius, tube):
    shape = BRepPrimAPI_MakeTorus(radius, tube).Shape()
    return shape, lambda p: np.hypot(np.linalg.norm(p[:, :2], axis=1) - radius, p[:, 2]) - tube


def wedge(x, y, z, top):
    """A box whose side x = `x` leans to x = `top` at y = `y`."""
    shape = BRepPrimAPI_MakeWedge(x, y, z, top).Shape()

    def formula(p):
        lean = (p[:, 0] - x) * y + (x - top) * p[:, 1]
        return np.max([-p[:, 0], -p[:, 1], p[:, 1] - y, -p[:, 2], p[:, 2] - z, lean / np.hypot(y, x - top)], axis=0)

    return shape, formula


def without(a, b):
    return BRepAlgoAPI_Cut(a[0], b[0]).Shape(), lambda p: np.maximum(a[1](p), -b[1](p))


def both(a, b):
    return BRepAlgoAPI_Common(a[0], b[0]).Shape(), lambda p: np.maximum(a[1](p), b[1](p))


def either(a, b):
    return BRepAlgoAPI_Fuse(a[0], b[0]).Shape(), lambda p: np.minimum(a[1](p), b[1](p))


def beside(a, b):
    """Two bodies that do not meet, as a compound."""
    shape, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(shape)
    builder.Add(shape, a[0])
    builder.Add(shape, b[0])
    return shape, lambda p: np.minimum(a[1](p), b[1](p))


def bodies():
    plate = box((-4, -3, 0), (4, 3, 1))
    rod = cylinder((1, 2, 2), 0.8, 5)
    hollow = without(ball((0, 0, 0), 3), ball((0.5, 0, 0), 2))
    return {
        "box": plate,
        "ball": ball((0, 0, 0), 3),
        "cylinder": rod,
        "frustum": cone(2, 1, 3),
        "cone": cone(2, 0, 3),
        "torus": torus(3, 1),
        "wedge": wedge(4, 3, 2, 1),
        "bored_plate": without(without(plate, cylinder((0, 0, 1), 1, 1)), cylinder((1, 0, 3), 0.5, 3)),
        "bored_ball": without(ball((0, 0, 0), 3), cylinder((0, 0.3, 1), 1, 5)),
        "dice": both(box((-2, -2, -2), (2, 2, 2)), ball((0, 0, 0), 2.6)),
        "tee": either(cylinder((0, 0, 1), 1, 6), cylinder((1, 0, 1), 0.6, 6)),
        "hollow_ball": hollow,
        "ball_in_void": beside(hollow, ball((0.5, 0, 0), 1)),
        "cut_torus": without(torus(3, 1), box((0, 0, -2), (5, 5, 2))),
        "ring_and_box": either(torus(3, 1), box((2, -1, -0.5), (6, 1, 0.5))),
    }


def motion():
    unit = TURN / np.linalg.norm(TURN)
    moved = gp_Trsf()
    moved.SetTransformation(gp_Quaternion(*unit.tolist()), gp_Vec(*PLACE.tolist()))
    return moved


def moved_back(points):
    x, y, z, w = TURN / np.linalg.norm(TURN)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation = np.eye(3) + 2 * w * cross + 2 * cross @ cross
    return (points - PLACE) @ rotation


def write(path, shape):
    writer = STEPControl_Writer()
    writer.Transfer(BRepBuilderAPI_Transform(shape, motion(), True).Shape(), STEPControl_AsIs)
    writer.Write(str(path))


def compare(name, formula):
    rows = [line.split() for line in (sides_occt.FOLDER / f"{name}.txt").read_text().splitlines()[1:]]
    values = formula(moved_back(np.array([[float(x) for x in row[:3]] for row in rows])))
    counts = dict(undecided=0, least=np.inf, wrong=0)
    for row, value in zip(rows, values, strict=True):
        if row[-1] == "Undecided":
            counts["undecided"] += 1
        elif abs(value) > ROUNDING and (value < 0) != (row[-1] == "Inside"):
            counts["wrong"] += 1
            print(f"{name}: {row} but {value:.3e}", file=sys.stderr)
        else:
            counts["least"] = min(counts["least"], abs(value))
    far = max((abs(value) for row, value in zip(rows, values, strict=True) if row[-1] == "Undecided"), default=0)
    print(f"| {name} | {len(rows)} | {counts['undecided']} | {far:.1e} | {counts['least']:.1e} | {counts['wrong']} |")


def main(step, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    sides_occt.FOLDER.mkdir(parents=True, exist_ok=True)
    if step == "compare":
        print("| body | points | undecided | farthest undecided | nearest decided | wrong |")
        print("|---|---|---|---|---|---|")
    for name, (shape, formula) in bodies().items():
        path = folder / f"{name}.step"
        if step == "points":
            write(path, shape)
            sides_occt.write_points(path, sides_occt.read(path))
        else:
            compare(name, formula)


main(*sys.argv[1:])
