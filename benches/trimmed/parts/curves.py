"""Curves in space, wires and freeform surfaces."""

import math

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon, BRepBuilderAPI_MakeWire
from OCP.GeomAbs import GeomAbs_C2
from OCP.GeomAPI import GeomAPI_Interpolate, GeomAPI_PointsToBSpline, GeomAPI_PointsToBSplineSurface
from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Elips, gp_Pnt
from OCP.TColgp import TColgp_Array1OfPnt, TColgp_Array2OfPnt, TColgp_HArray1OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

from .numbers import Numbers

# Degrees and tolerances of the splines that are fitted to points.
DEGREES = (3, 8)
CURVE_TOLERANCE = 1e-6
SURFACE_TOLERANCE = 1e-4
INTERPOLATION_TOLERANCE = 1e-7


def points(coordinates) -> TColgp_Array1OfPnt:
    result = TColgp_Array1OfPnt(1, len(coordinates))
    for index, point in enumerate(coordinates, 1):
        result.SetValue(index, gp_Pnt(*map(float, point)))
    return result


def net(rows) -> TColgp_Array2OfPnt:
    result = TColgp_Array2OfPnt(1, len(rows), 1, len(rows[0]))
    for i, row in enumerate(rows, 1):
        for j, point in enumerate(row, 1):
            result.SetValue(i, j, gp_Pnt(*map(float, point)))
    return result


def reals(values) -> TColStd_Array1OfReal:
    result = TColStd_Array1OfReal(1, len(values))
    for index, value in enumerate(values, 1):
        result.SetValue(index, value)
    return result


def integers(values) -> TColStd_Array1OfInteger:
    result = TColStd_Array1OfInteger(1, len(values))
    for index, value in enumerate(values, 1):
        result.SetValue(index, value)
    return result


def spline(through):
    """Returns a B-spline curve near these points, its ends on the first and the last."""
    return GeomAPI_PointsToBSpline(points(through), *DEGREES, GeomAbs_C2, CURVE_TOLERANCE).Curve()


def closed_spline(through):
    """Returns a periodic B-spline curve through these points."""
    array = TColgp_HArray1OfPnt(1, len(through))
    for index, point in enumerate(through, 1):
        array.SetValue(index, gp_Pnt(*map(float, point)))
    interpolation = GeomAPI_Interpolate(array, True, INTERPOLATION_TOLERANCE)
    interpolation.Perform()
    return interpolation.Curve()


def height_field(numbers: Numbers, counts, low, high, spacing=10):
    """Returns a B-spline surface near random heights on a grid."""
    rows, columns = counts
    grid = [[(i * spacing, j * spacing, numbers.real(f"z{i}{j}", low, high)) for j in range(columns)] for i in range(rows)]
    return GeomAPI_PointsToBSplineSurface(net(grid), *DEGREES, GeomAbs_C2, SURFACE_TOLERANCE).Surface()


def vase(numbers: Numbers):
    """Returns a profile in the plane y = 0 that does not reach the z axis."""
    ranges = [(5, 8, 0), (6, 14, 10), (4, 12, 22), (6, 12, 35)]
    return spline([(numbers.real(f"r{k}", low, high), 0, z) for k, (low, high, z) in enumerate(ranges)])


def wire(*curves):
    return BRepBuilderAPI_MakeWire(*(BRepBuilderAPI_MakeEdge(curve).Edge() for curve in curves)).Wire()


def segment(a, b):
    return BRepBuilderAPI_MakeEdge(gp_Pnt(*a), gp_Pnt(*b)).Edge()


def polygon(corners):
    maker = BRepBuilderAPI_MakePolygon()
    for corner in corners:
        maker.Add(corner if isinstance(corner, gp_Pnt) else gp_Pnt(*corner))
    maker.Close()
    return maker.Wire()


def circle(point, direction, radius) -> gp_Circ:
    return gp_Circ(gp_Ax2(gp_Pnt(*point), gp_Dir(*direction)), radius)


def ellipse_wire(height, a, b, tilt=0.0):
    plane = gp_Ax2(gp_Pnt(0, 0, height), gp_Dir(tilt, 0, 1))
    return wire(gp_Elips(plane, max(a, b), min(a, b)))


def plane_face(boundary):
    return BRepBuilderAPI_MakeFace(boundary).Face()


def wobbly_circle(numbers: Numbers, name, count, radius, part, center=(0.0, 0.0)):
    """Returns points around a circle, their radii off by up to `part`."""
    result = []
    for k in range(count):
        angle, factor = 2 * math.pi * k / count, 1 + numbers.real(f"{name}{k}", -part, part)
        result.append((center[0] + radius * factor * math.cos(angle), center[1] + radius * factor * math.sin(angle)))
    return result
