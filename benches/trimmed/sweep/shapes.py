"""Shapes of OpenCASCADE: their faces, their files and their sizes."""

import math
from dataclasses import dataclass
from pathlib import Path

from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.GProp import GProp_GProps
from OCP.IGESControl import IGESControl_Reader, IGESControl_Writer
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_Reader, STEPControl_StepModelType, STEPControl_Writer
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Face, TopoDS_Shape
from OCP.gp import gp_Pnt

# The relative errors that the adaptive quadrature of areas is asked for.
AREA_ACCURACIES = (1e-3, 1e-4, 1e-6, 1e-9)
# IGES keeps solids as B-reps (1) and not as loose trimmed surfaces (0).
IGES_BREP_MODE = 1


def explored(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> list:
    """Returns the parts of a kind in OpenCASCADE's order."""
    explorer, found = TopExp_Explorer(shape, kind), []
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def faces(shape: TopoDS_Shape) -> list[TopoDS_Face]:
    """Returns the faces in OpenCASCADE's order, those that stand twice at one place once."""
    distinct: dict[tuple, list[TopoDS_Face]] = {}
    for face in explored(shape, TopAbs_FACE):
        move = face.Location().Transformation()
        place = tuple(move.Value(row, column) for row in (1, 2, 3) for column in (1, 2, 3, 4))
        there = distinct.setdefault(place, [])
        if not any(face.IsPartner(other) for other in there):
            there.append(TopoDS.Face_s(face))
    return [face for there in distinct.values() for face in there]


def distance(point: tuple[float, float, float], shape: TopoDS_Shape) -> float:
    """Returns the distance of a point from the faces of a shape."""
    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    # The distance from a solid is 0 inside of it.
    for face in faces(shape):
        builder.Add(compound, face)
    vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(*point)).Vertex()
    return BRepExtrema_DistShapeShape(vertex, compound).Value()


def diagonal(shape: TopoDS_Shape) -> float:
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box)
    low_x, low_y, low_z, high_x, high_y, high_z = box.Get()
    return math.dist((low_x, low_y, low_z), (high_x, high_y, high_z))


def is_valid(shape: TopoDS_Shape) -> bool:
    return BRepCheck_Analyzer(shape).IsValid()


def edge_tolerance(shape: TopoDS_Shape) -> float:
    """Returns the largest distance that the shape states between an edge and its curves."""
    edges = (TopoDS.Edge_s(edge) for edge in explored(shape, TopAbs_EDGE))
    return max((BRep_Tool.Tolerance_s(edge) for edge in edges), default=0.0)


@dataclass
class Area:
    """An area by quadrature, how much that may be off, and the length of the face's edges."""

    value: float
    spread: float
    rim: float


def area(face: TopoDS_Shape) -> Area:
    """Returns the area by adaptive quadrature.

    On trimmed splines that quadrature misses what it is asked for by orders of magnitude: the
    results with several accuracies tell such faces from the others.
    """
    values = [_area(face, accuracy) for accuracy in AREA_ACCURACIES]
    rim = GProp_GProps()
    BRepGProp.LinearProperties_s(face, rim)
    return Area(values[-1], max(values) - min(values), rim.Mass())


def _area(face: TopoDS_Shape, accuracy: float) -> float:
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties, accuracy)
    return abs(properties.Mass())


def write_brep(shape: TopoDS_Shape, path: Path) -> None:
    BRepTools.Write_s(shape, str(path))


def read_brep(path: Path) -> TopoDS_Shape:
    shape = TopoDS_Shape()
    BRepTools.Read_s(shape, str(path), BRep_Builder())
    return shape


def through_step(shape: TopoDS_Shape, path: Path, unit: str) -> TopoDS_Shape:
    """Writes STEP in a unit, MM or INCH, and returns the shape that reading it makes."""
    writer = STEPControl_Writer()
    Interface_Static.SetCVal_s("write.step.unit", unit)
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    return _translated(STEPControl_Reader(), path)


def through_iges(shape: TopoDS_Shape, path: Path) -> TopoDS_Shape:
    """Writes IGES and returns the shape that reading it makes."""
    writer = IGESControl_Writer("MM", IGES_BREP_MODE)
    writer.AddShape(shape)
    writer.ComputeModel()
    writer.Write(str(path))
    return _translated(IGESControl_Reader(), path)


def _translated(reader, path: Path) -> TopoDS_Shape:
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return reader.OneShape()
