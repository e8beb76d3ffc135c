"""Compares the sides of points with winding numbers and with OpenCASCADE's BRepClass3d_SolidClassifier.

    python3 benches/peers/sides_occt.py points FOLDER [SEED]
    cargo bench --bench sides -- FOLDER/*
    python3 benches/peers/sides_occt.py compare FOLDER [SECONDS [DEFLECTION]]

Needs cadquery-ocp, libigl and numpy. FOLDER has STEP files. `points` writes to target/sides 10,000 random points of
each box, and 10,000 at 1e-7 to 1e-1 of the diagonal from vertices and edges: on the normals of their faces, on
the bisectors of these, and on lines from random points through them. `compare` prints how many points the
bench put on another side than the oracle: where OpenCASCADE's triangles (DEFLECTION is a part of the diagonal, 1e-5 if
not given) are farther off than ten deflections their winding number, nearer ones its classifier, for up to SECONDS a
file, eight if not given; nearer than the gap of the file's faces, which it closes in another way, either side may be
right. Points that the classifier puts on the boundary, for the tolerance that the file's edges get, are judged by the
winding number if they are farther from the faces than the gap and from the triangles than two deflections; the last
columns have how many of the others there are, and how many of these beyond the gap.
"""

import sys
import time
from pathlib import Path

import igl
import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.gp import gp_Pnt, gp_Vec
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_IN, TopAbs_ON, TopAbs_OUT, TopAbs_REVERSED, TopAbs_SOLID, TopAbs_VERTEX
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound
from OCP.TopTools import TopTools_ShapeMapHasher

POINTS = 10_000
SEED = 30
DEFLECTION = 1e-5
# Nearer than so many deflections the triangles do not decide.
NEAR = 10
OPENCASCADE_SECONDS = 8

# About so many of the undecided points are measured from the faces, which takes tens of milliseconds each.
MEASURED = 200

# The distance up to which the classifier puts a point on the boundary: far below those of the points.
ON_BOUNDARY = 1e-9
FOLDER = Path("target/sides")


def explored(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def read(path):
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return reader.OneShape()


def box_of(shape):
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box)
    low, high = box.CornerMin(), box.CornerMax()
    return np.array([low.X(), low.Y(), low.Z()]), np.array([high.X(), high.Y(), high.Z()])


def normal(face, at):
    """The face's normal where its surface is nearest to a point; None where it has none."""
    surface = BRepAdaptor_Surface(face)
    analysis = BRep_Tool.Surface_s(face)
    from OCP.ShapeAnalysis import ShapeAnalysis_Surface

    uv = ShapeAnalysis_Surface(analysis).ValueOfUV(gp_Pnt(*at), 1e-7)
    point, u, v = gp_Pnt(), gp_Vec(), gp_Vec()
    surface.D1(uv.X(), uv.Y(), point, u, v)
    across = np.cross([u.X(), u.Y(), u.Z()], [v.X(), v.Y(), v.Z()])
    length = np.linalg.norm(across)
    if length < 1e-12:
        return None
    return across / length * (-1 if face.Orientation() == TopAbs_REVERSED else 1)


def places(shape, random):
    """Points of vertices and edges, with the normals of the faces there."""
    faces_at = {}
    for face in explored(shape, TopAbs_FACE):
        for kind in (TopAbs_VERTEX, TopAbs_EDGE):
            for part in explored(face, kind):
                entry = faces_at.setdefault((kind, TopTools_ShapeMapHasher()(part)), (part, []))
                entry[1].append(TopoDS.Face(face))
    found = []
    for (kind, _), (part, faces) in faces_at.items():
        if kind == TopAbs_VERTEX:
            point = BRep_Tool.Pnt_s(TopoDS.Vertex(part))
        else:
            edge = TopoDS.Edge(part)
            if BRep_Tool.Degenerated_s(edge):
                continue
            curve = BRepAdaptor_Curve(edge)
            share = random.random()
            point = curve.Value((1 - share) * curve.FirstParameter() + share * curve.LastParameter())
        at = np.array([point.X(), point.Y(), point.Z()])
        normals = [n for n in (normal(face, at) for face in faces) if n is not None]
        found.append((at, normals))
    return found


def write_points(path, shape, seed=SEED):
    """Writes the points of a shape for the bench: first random ones, then those beside edges and corners."""
    random = np.random.default_rng(seed)
    low, high = box_of(shape)
    size = np.linalg.norm(high - low)
    lines = [(low + (high - low) * (1.1 * random.random(3) - 0.05), "random") for _ in range(POINTS)]
    near = places(shape, random)
    while len(lines) < 2 * POINTS:
        at, normals = near[random.integers(len(near))]
        choice = random.integers(3)
        if choice == 0 or not normals:
            direction, kind = at - (low + (high - low) * random.random(3)), "through"
        elif choice == 1:
            direction, kind = normals[random.integers(len(normals))], "normal"
        else:
            direction, kind = np.sum(normals, axis=0), "bisector"
        length = np.linalg.norm(direction)
        if length < 1e-6:
            continue
        distance = size * 10 ** (-7 + 6 * random.random()) * random.choice([-1, 1])
        lines.append((at + direction / length * distance, kind))
    text = "".join(f"{x!r} {y!r} {z!r} {kind}\n" for (x, y, z), kind in ((point.tolist(), kind) for point, kind in lines))
    (FOLDER / f"{path.stem}.points").write_text(text)


def triangles(shape, deflection):
    BRepMesh_IncrementalMesh(shape, deflection, False, 0.1, False)
    points, corners = [], []
    for shape_of_face in explored(shape, TopAbs_FACE):
        face, place = TopoDS.Face(shape_of_face), TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, place)
        if mesh is None:
            continue
        first = len(points)
        for index in range(1, mesh.NbNodes() + 1):
            point = mesh.Node(index).Transformed(place.Transformation())
            points.append((point.X(), point.Y(), point.Z()))
        flip = face.Orientation() == TopAbs_REVERSED
        for index in range(1, mesh.NbTriangles() + 1):
            a, b, c = (first + corner - 1 for corner in mesh.Triangle(index).Get())
            corners.append((a, c, b) if flip else (a, b, c))
    return np.array(points), np.array(corners)


def off(point, faces):
    """The distance of a point from faces."""
    return BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(gp_Pnt(*point)).Vertex(), faces).Value()


class Classifier:
    """The classifier of a solid, which is asked only for points in its box."""

    def __init__(self, solid):
        self.low, self.high = box_of(solid)
        self.solid = BRepClass3d_SolidClassifier(solid)

    def state(self, point):
        reach = ON_BOUNDARY + 1e-3 * np.max(self.high - self.low)
        if np.any(point < self.low - reach) or np.any(point > self.high + reach):
            return TopAbs_OUT
        self.solid.Perform(gp_Pnt(*point), ON_BOUNDARY)
        return self.solid.State()


def compare(path, shape, seconds=OPENCASCADE_SECONDS, deflection=DEFLECTION):
    gap, *lines = (FOLDER / f"{path.stem}.txt").read_text().splitlines()
    gap, rows = float(gap.split()[1]), [line.split() for line in lines]
    if not rows:
        # Of a model that is not closed there are no sides.
        return
    points = np.array([[float(x) for x in row[:3]] for row in rows])
    sides = [row[-1] for row in rows]
    low, high = box_of(shape)
    size = np.linalg.norm(high - low)
    vertices, corners = triangles(shape, deflection * size)
    apart = np.sqrt(igl.point_mesh_squared_distance(points, vertices, corners)[0])
    winding = igl.fast_winding_number(vertices, corners, points)
    faces, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(faces)
    for face in explored(shape, TopAbs_FACE):
        builder.Add(faces, face)
    classifiers = [Classifier(solid) for solid in explored(shape, TopAbs_SOLID)]
    counts = dict(far=0, near=0, unchecked=0, in_gap=0, wrong=0, on=0, on_beyond=0)
    undecided = points[[side == "Undecided" for side in sides]]
    of_undecided = [off(point, faces) for point in undecided[:: len(undecided) // MEASURED + 1]]
    started = time.process_time()
    for point, side, distance, number in zip(points, sides, apart, winding, strict=True):
        if side == "Undecided":
            continue
        if distance > NEAR * deflection * size:
            # The winding number of solids in voids of others is not above 1 either.
            inside = round(number) % 2 == 1
            counts["far"] += 1
        elif time.process_time() - started > seconds:
            counts["unchecked"] += 1
            continue
        else:
            states = [classifier.state(point) for classifier in classifiers]
            if TopAbs_ON not in states:
                inside = sum(state == TopAbs_IN for state in states) % 2 == 1
                counts["near"] += 1
            elif off(point, faces) > gap and distance > 2 * deflection * size:
                inside = round(number) % 2 == 1
                counts["far"] += 1
            else:
                counts["on"] += 1
                counts["on_beyond"] += off(point, faces) > gap
                continue
        if inside != (side == "Inside"):
            apart_exactly = off(point, faces)
            counts["in_gap" if apart_exactly <= gap else "wrong"] += 1
            print(f"{path.name}: {point.tolist()} {side}, {apart_exactly:.2e} from the faces, winding {number:.4f}", file=sys.stderr)
    print(f"| {path.name} | {gap:.1e} | {len(points)} | {counts['far']} | {counts['near']} | {counts['unchecked']} |"
          f" {len(undecided)} | {max(of_undecided, default=0):.1e} | {counts['in_gap']} | {counts['wrong']} | {counts['on']} |"
          f" {counts['on_beyond']} |", flush=True)


def main(step, folder, *options):
    FOLDER.mkdir(parents=True, exist_ok=True)
    if step == "compare":
        print("| model | gap | points | by winding | by classifier | not checked | undecided | farthest of these "
              "| on the other side, in the gap | beyond it | on the boundary by the classifier | of these beyond the gap |")
        print("|" + "---|" * 12)
    for path in sorted(Path(folder).iterdir()):
        if path.suffix.lower() not in (".step", ".stp"):
            continue
        if step == "points":
            write_points(path, read(path), *map(int, options))
        elif (FOLDER / f"{path.stem}.txt").exists():
            compare(path, read(path), *map(float, options))


if __name__ == "__main__":
    main(*sys.argv[1:])
