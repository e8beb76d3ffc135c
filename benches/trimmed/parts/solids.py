"""Primitive solids, booleans and placements."""

from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakePrism,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound

from .numbers import Numbers

ORIGIN = gp_Pnt(0, 0, 0)
UP = gp_Dir(0, 0, 1)
Z_AXIS = gp_Ax1(ORIGIN, UP)


def axis(point, direction) -> gp_Ax2:
    return gp_Ax2(gp_Pnt(*point), direction if isinstance(direction, gp_Dir) else gp_Dir(*direction))


def box(x, y, z, corner=(0, 0, 0)):
    return BRepPrimAPI_MakeBox(gp_Pnt(*corner), x, y, z).Shape()


def cylinder(point, direction, radius, height):
    return BRepPrimAPI_MakeCylinder(axis(point, direction), radius, height).Shape()


def cone(point, direction, first, second, height):
    return BRepPrimAPI_MakeCone(axis(point, direction), first, second, height).Shape()


def sphere(point, radius, direction=(0, 0, 1)):
    return BRepPrimAPI_MakeSphere(axis(point, direction), radius).Shape()


def torus(point, direction, major, minor):
    return BRepPrimAPI_MakeTorus(axis(point, direction), major, minor).Shape()


def prism(face, vector):
    return BRepPrimAPI_MakePrism(face, gp_Vec(*vector)).Shape()


def cut(a, b):
    return BRepAlgoAPI_Cut(a, b).Shape()


def fuse(a, b):
    return BRepAlgoAPI_Fuse(a, b).Shape()


def common(a, b):
    return BRepAlgoAPI_Common(a, b).Shape()


def drill(numbers: Numbers, name: str, center, radius, length=200):
    """Returns a long cylinder through a point in a random direction."""
    direction = numbers.unit(name)
    start = [c - d * length / 2 for c, d in zip(center, direction)]
    return cylinder(start, direction, radius, length)


def moved(shape, transformation: gp_Trsf):
    """Returns a copy with other coordinates."""
    return BRepBuilderAPI_Transform(shape, transformation, True).Shape()


def placed(shape, transformation: gp_Trsf):
    """Returns the same shape at another location, as instances in an assembly are."""
    return shape.Moved(TopLoc_Location(transformation))


def translation(x, y, z) -> gp_Trsf:
    result = gp_Trsf()
    result.SetTranslation(gp_Vec(x, y, z))
    return result


def scaling(factor) -> gp_Trsf:
    result = gp_Trsf()
    result.SetScale(ORIGIN, factor)
    return result


def motion(numbers: Numbers, name: str, angles, distance) -> gp_Trsf:
    """Returns a random rotation about the origin, then a random translation."""
    rotation = gp_Trsf()
    rotation.SetRotation(gp_Ax1(ORIGIN, numbers.direction(name + "d")), numbers.real(name + "a", *angles))
    result = translation(*(numbers.real(name + letter, -distance, distance) for letter in "xyz"))
    result.Multiply(rotation)
    return result


def posed(shape, numbers: Numbers, name="pose", distance=50):
    """Moves a part so that nothing is parallel to the axes."""
    return moved(shape, motion(numbers, name, (0.3, 2.8), distance))


def compound(shapes):
    result, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(result)
    for shape in shapes:
        builder.Add(result, shape)
    return result


def faces(shape) -> list:
    return [TopoDS.Face_s(face) for face in _explored(shape, TopAbs_FACE)]


def edges(shape) -> list:
    """Returns the edges, each once."""
    found = []
    for edge in _explored(shape, TopAbs_EDGE):
        if not any(edge.IsSame(other) for other in found):
            found.append(TopoDS.Edge_s(edge))
    return found


def curve_kind(edge):
    return BRepAdaptor_Curve(edge).GetType()


def _explored(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()
