"""OpenCASCADE's mesh of a shape as models of the interchange format.

A triangle is a bilinear patch with one side of length 0, and a point is a patch whose four
control points are one. The distance from the points to a part then shows a face that the
reader lost, and the distance from the part to the triangles shows pieces that lie outside
of the face: both over all points, where samples would show some.
"""

import json
import random
from dataclasses import dataclass
from pathlib import Path

from OCP.BRep import BRep_Tool
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape

from .shapes import faces

# Largest angle, in radians, between neighbouring triangles of the mesh.
ANGLE = 0.35
# Largest number of nodes taken from a face, to bound the time that the points take.
MAX_POINTS = 60

Point = tuple[float, float, float]


@dataclass
class Mesh:
    """Nodes and triangles of the faces, and the faces that OpenCASCADE could not mesh."""

    nodes: list[list[Point]]
    triangles: list[tuple[Point, Point, Point]]
    failed: list[int]


def mesh(shape: TopoDS_Shape, deflection: float) -> Mesh:
    """Meshes all faces within `deflection`, in model units."""
    BRepTools.Clean_s(shape)
    BRepMesh_IncrementalMesh(shape, deflection, False, ANGLE)
    result = Mesh([], [], [])
    for number, face in enumerate(faces(shape)):
        location = TopLoc_Location()
        triangulation = BRep_Tool.Triangulation_s(face, location)
        if triangulation is None:
            result.failed.append(number)
            continue
        move = location.Transformation()
        points = [triangulation.Node(i).Transformed(move).Coord() for i in range(1, triangulation.NbNodes() + 1)]
        result.nodes.append(points)
        for i in range(1, triangulation.NbTriangles() + 1):
            result.triangles.append(tuple(points[corner - 1] for corner in triangulation.Triangle(i).Get()))
    return result


def write_triangles(found: Mesh, path: Path) -> None:
    _write([(a, b, c, c) for a, b, c in found.triangles], path)


def write_points(found: Mesh, path: Path) -> None:
    """Writes up to MAX_POINTS nodes of each face, drawn with a fixed seed."""
    draw = random.Random(0)
    points = [point for nodes in found.nodes for point in draw.sample(nodes, min(len(nodes), MAX_POINTS))]
    _write([(point, point, point, point) for point in points], path)


def _write(patches: list[tuple[Point, Point, Point, Point]], path: Path) -> None:
    line = [0, 0, 1, 1]
    surfaces = [
        {"degree": [1, 1], "knots_u": line, "knots_v": line, "ctrl": [[[*a, 1], [*b, 1]], [[*d, 1], [*c, 1]]]}
        for a, b, c, d in patches
    ]
    path.write_text(json.dumps({"surfaces": surfaces}))
