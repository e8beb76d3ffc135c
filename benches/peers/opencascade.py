"""Models as OpenCASCADE's surfaces, and their triangles."""

import time

import numpy as np
import OCP.OCP.collections as containers
from OCP.BRep import BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.Geom import Geom_BSplineSurface
from OCP.gp import gp_Pnt
from OCP.TopLoc import TopLoc_Location

# Points of a degenerate edge nearer than this are one: OpenCASCADE's Precision::Confusion.
CONFUSION = 1e-7


def surface(arrays):
    """The same surface as a `Geom_BSplineSurface`."""
    n, m = arrays.weights.shape
    poles, weights = containers.Array2_gp_Pnt(1, n, 1, m), containers.Array2_double(1, n, 1, m)
    for i in range(n):
        for j in range(m):
            poles.SetValue(i + 1, j + 1, gp_Pnt(*map(float, arrays.points[i, j])))
            weights.SetValue(i + 1, j + 1, float(arrays.weights[i, j]))
    knots, multiplicities = zip(*(_knots(vector) for vector in arrays.knots), strict=True)
    given = (poles, weights) if arrays.rational else (poles,)
    return Geom_BSplineSurface(*given, *knots, *multiplicities, *arrays.degree)


def _knots(vector):
    """Distinct knots and how often each is there."""
    distinct, counts = np.unique(vector, return_counts=True)
    values, repeats = containers.Array1_double(1, len(distinct)), containers.Array1_int(1, len(distinct))
    for index, (knot, count) in enumerate(zip(distinct, counts, strict=True), start=1):
        values.SetValue(index, float(knot))
        repeats.SetValue(index, int(count))
    return values, repeats


def triangles(surfaces, deflection, angle):
    """Vertices, triangles, and the seconds that `BRepMesh_IncrementalMesh` took.

    Copying the triangles to numpy is not counted. Triangles without area, as at
    poles, are left out: the mesh tools refuse or ignore them.
    """
    seconds, offset, vertices, faces = 0.0, 0, [], []
    for geometry in surfaces:
        start = time.perf_counter()
        face = BRepBuilderAPI_MakeFace(geometry, CONFUSION).Face()
        BRepMesh_IncrementalMesh(face, deflection, False, angle, True)
        seconds += time.perf_counter() - start
        mesh = BRep_Tool.Triangulation_s(face, TopLoc_Location())
        nodes = [mesh.Node(index + 1).Coord() for index in range(mesh.NbNodes())]
        vertices.append(np.array(nodes))
        corners = [mesh.Triangle(index + 1).Get() for index in range(mesh.NbTriangles())]
        faces.append(np.array(corners, dtype=np.int64).reshape(-1, 3) - 1 + offset)
        offset += len(nodes)
    vertices, faces = np.concatenate(vertices), np.concatenate(faces)
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return vertices, np.ascontiguousarray(faces[areas > 0]), seconds
