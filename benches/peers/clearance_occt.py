"""Compares clearances with OpenCASCADE's BRepExtrema_DistShapeShape.

    python3 benches/peers/clearance_occt.py POSES A.step B.step

POSES is a file that `cargo bench --bench clearance` has written to target/clearance, for the same two
models. Prints for each pose OpenCASCADE's distance, whether it is in the interval, and its seconds.
"""

import json
import sys
import time
from pathlib import Path

from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.gp import gp_Quaternion, gp_Trsf, gp_Vec
from OCP.STEPControl import STEPControl_Reader

POSES = 12

# OpenCASCADE's own tolerance of a distance, and the gaps of the files.
TOLERANCE = 1e-6


def read(path):
    reader = STEPControl_Reader()
    reader.ReadFile(path)
    reader.TransferRoots()
    return reader.OneShape()


def main(poses, a, b):
    a, b = read(a), read(b)
    print("| pose | interval | OpenCASCADE | in the interval | s |")
    print("|---|---|---|---|---|")
    for index, line in enumerate(Path(poses).read_text().splitlines()[:POSES]):
        pose = json.loads(line)
        motion = gp_Trsf()
        motion.SetTransformation(gp_Quaternion(*pose["quaternion"]), gp_Vec(*pose["translation"]))
        moved = BRepBuilderAPI_Transform(a, motion, True).Shape()
        started = time.process_time()
        distance = BRepExtrema_DistShapeShape(moved, b).Value()
        seconds = time.process_time() - started
        lower, upper = pose["lower"], pose["upper"]
        inside = lower - TOLERANCE <= distance <= upper + TOLERANCE
        print(f"| {index} | [{lower:.9g}, {upper:.9g}] | {distance:.9g} | {inside} | {seconds:.2f} |", flush=True)


main(*sys.argv[1:])
