"""Compares clearances with OpenCASCADE's BRepExtrema_DistShapeShape, and with FCL and parry on triangles.

    python3 benches/peers/clearance_peers.py A.step B.step [C.step D.step ...]

Needs cadquery-ocp, python-fcl and numpy. For each pair `cargo bench --bench clearance` measures seeded poses
and writes them with their intervals to target/clearance; the same poses are then measured by the others.
Prints a Markdown table: medians in milliseconds (FCL, OpenCASCADE: CPU time of this process; parry and ours:
least of three by the clock), and how many of the others' distances are outside the intervals. Triangles are
OpenCASCADE's, with a deflection of 1e-4 of the diagonal; their time is not counted. parry is the program
in peers/parry, built at first.
"""

import json
import statistics
import subprocess
import sys
import time
from pathlib import Path

import fcl
import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.gp import gp_Quaternion, gp_Trsf, gp_Vec
from OCP.IGESControl import IGESControl_Reader
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS

# The poses measured by OpenCASCADE and parry, which take seconds for some.
SLOW_POSES = 12

# Seconds after which no further pose is measured by it.
OPENCASCADE_SECONDS = 60

RELATIVE_DEFLECTION = 1e-4

PARRY = Path(__file__).parent / "peers" / "parry"

# OpenCASCADE's tolerance of a distance and the gaps of the files.
TOLERANCE = 1e-6


def read(path):
    reader = IGESControl_Reader() if path.lower().endswith((".igs", ".iges")) else STEPControl_Reader()
    reader.ReadFile(path)
    reader.TransferRoots()
    return reader.OneShape()


def triangles(shape, deflection):
    BRepMesh_IncrementalMesh(shape, deflection, False, 0.1, False)
    points, corners = [], []
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        place = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(TopoDS.Face(explorer.Current()), place)
        if mesh is not None:
            first = len(points)
            for index in range(1, mesh.NbNodes() + 1):
                point = mesh.Node(index).Transformed(place.Transformation())
                points.append((point.X(), point.Y(), point.Z()))
            for index in range(1, mesh.NbTriangles() + 1):
                corners.append([first + corner - 1 for corner in mesh.Triangle(index).Get()])
        explorer.Next()
    return np.array(points), np.array(corners)


def tree(points, corners):
    model = fcl.BVHModel()
    model.beginModel(len(points), len(corners))
    model.addSubModel(points, corners)
    model.endModel()
    return model


def timed(work):
    started = time.process_time()
    value = work()
    return value, 1e3 * (time.process_time() - started)


def outside(distance, pose, tolerance):
    return not pose["lower"] - tolerance <= distance <= pose["upper"] + tolerance


def measure_opencascade(poses, a, b):
    found, started = [], time.process_time()
    for pose in poses[:SLOW_POSES]:
        motion = gp_Trsf()
        motion.SetTransformation(gp_Quaternion(*pose["quaternion"]), gp_Vec(*pose["translation"]))
        moved = BRepBuilderAPI_Transform(a, motion, True).Shape()
        distance, spent = timed(lambda moved=moved: BRepExtrema_DistShapeShape(moved, b).Value())
        found.append((distance, spent, outside(distance, pose, TOLERANCE)))
        if time.process_time() - started > OPENCASCADE_SECONDS:
            break
    return found


def measure_fcl(poses, a, b, deflection):
    found = []
    other = fcl.CollisionObject(b)
    for pose in poses:
        x, y, z, w = pose["quaternion"]
        one = fcl.CollisionObject(a, fcl.Transform(np.array([w, x, y, z]), np.array(pose["translation"])))
        distance, spent = timed(lambda one=one: fcl.distance(one, other, fcl.DistanceRequest(), fcl.DistanceResult()))
        _, collide = timed(lambda one=one: fcl.collide(one, other, fcl.CollisionRequest(), fcl.CollisionResult()))
        # FCL returns -1 for meshes that meet.
        found.append((max(distance, 0.0), spent, collide, outside(max(distance, 0.0), pose, 2 * deflection)))
    return found


def measure_parry(poses, meshes, deflection):
    poses = poses[:SLOW_POSES]
    motions = [{key: pose[key] for key in ("quaternion", "translation")} for pose in poses]
    sides = [dict(points=points.tolist(), triangles=corners.tolist()) for points, corners in meshes]
    command = ["cargo", "run", "--quiet", "--release", "--locked", "--target-dir", "target/parry"]
    given = json.dumps(dict(meshes=sides, poses=motions)).encode()
    ran = subprocess.run([*command, "--manifest-path", PARRY / "Cargo.toml"], input=given, check=True, capture_output=True)
    rows = zip(poses, json.loads(ran.stdout), strict=True)
    return [(distance, spent, test, outside(distance, pose, 2 * deflection)) for pose, (distance, spent, test) in rows]


def median(values):
    return f"{statistics.median(values):.3g}"


def main(paths):
    print("| A | B | ours: interval | limit | OpenCASCADE | outside | most off "
          "| FCL distance | outside | collide | parry distance | outside | intersection | triangles |")
    print("|" + "---|" * 14)
    for a, b in zip(paths[::2], paths[1::2], strict=True):
        command = ["cargo", "bench", "--quiet", "--bench", "clearance", "--", a, b]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        stems = [Path(path).stem for path in (a, b)]
        lines = Path(f"target/clearance/{stems[0]}-{stems[1]}.jsonl").read_text().splitlines()
        poses = [json.loads(line) for line in lines]
        shapes = [read(path) for path in (a, b)]
        exact = measure_opencascade(poses, *shapes)
        deflection = RELATIVE_DEFLECTION * poses[0]["diagonal"]
        meshes = [triangles(shape, deflection) for shape in shapes]
        near = measure_fcl(poses, *[tree(*mesh) for mesh in meshes], deflection)
        tests = measure_parry(poses, meshes, deflection)
        off = max(max(pose["lower"] - row[0], row[0] - pose["upper"], 0.0) for pose, row in zip(poses, exact))
        cells = [
            *stems,
            median([pose["ms"] for pose in poses]),
            median([pose["limitMs"] for pose in poses]),
            median([row[1] for row in exact]),
            f"{sum(row[2] for row in exact)} of {len(exact)}",
            f"{off:.2g}",
            median([row[1] for row in near]),
            f"{sum(row[3] for row in near)} of {len(near)}",
            median([row[2] for row in near]),
            median([row[1] for row in tests]),
            f"{sum(row[3] for row in tests)} of {len(tests)}",
            median([row[2] for row in tests]),
            str(sum(len(mesh[1]) for mesh in meshes)),
        ]
        print("| " + " | ".join(cells) + " |", flush=True)


main(sys.argv[1:])
