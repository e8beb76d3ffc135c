"""Fillets, chamfers, drafts, shells and offsets."""

from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer, BRepFilletAPI_MakeFillet
from OCP.BRep import BRep_Tool
from OCP.BRepOffset import BRepOffset_Skin
from OCP.BRepOffsetAPI import BRepOffsetAPI_DraftAngle, BRepOffsetAPI_MakeOffsetShape, BRepOffsetAPI_MakeThickSolid
from OCP.GeomAbs import GeomAbs_Arc, GeomAbs_BSplineCurve, GeomAbs_Line, GeomAbs_Plane
from OCP.gp import gp_Pln
from OCP.Standard import Standard_Failure
from OCP.TopTools import TopTools_ListOfShape

from ..solids import ORIGIN, UP, box, curve_kind, cut, cylinder, drill, edges, faces, fuse, posed, torus
from .lofts import loft_body
from .registry import kind

# Tolerance of offsets and of walls of shells.
OFFSET_TOLERANCE = 1e-4


def bored_box(n, low=3, high=6):
    return cut(box(40, 30, 20), drill(n, "b", (20, 15, 10), n.real("r", low, high)))


def hollowed(shape, openings, thickness):
    """Returns the shell of a solid, open at these faces."""
    maker, removed = BRepOffsetAPI_MakeThickSolid(), TopTools_ListOfShape()
    for face in openings:
        removed.Append(face)
    maker.MakeThickSolidByJoin(shape, removed, thickness, OFFSET_TOLERANCE, BRepOffset_Skin, False, False, GeomAbs_Arc)
    maker.Build()
    return maker.Shape()


@kind
def fillet_variable(n):
    body = fuse(box(40, 30, 20), cylinder((20, 15, 10), (0, 0, 1), n.real("r", 6, 10), 25))
    maker, candidates = BRepFilletAPI_MakeFillet(body), edges(body)
    for k in range(n.whole("n", 1, 4)):
        edge = candidates[n.whole(f"e{k}", 0, len(candidates) - 1)]
        variable = n.whole(f"v{k}", 0, 1)
        radii = (n.real(f"r1{k}", 0.5, 3), n.real(f"r2{k}", 0.5, 3)) if variable else (n.real(f"rr{k}", 0.5, 3),)
        try:
            maker.Add(*radii, edge)
        except Standard_Failure:
            # The edge has a fillet already, as a tangent one of another's.
            continue
    maker.Build()
    return posed(maker.Shape(), n)


@kind
def fillet_all(n):
    body = bored_box(n) if n.whole("bored", 0, 1) else box(40, 30, n.real("z", 15, 25))
    maker, radius = BRepFilletAPI_MakeFillet(body), n.real("rr", 1, 3)
    for edge in edges(body):
        if curve_kind(edge) == GeomAbs_Line:
            maker.Add(radius, edge)
    maker.Build()
    return posed(maker.Shape(), n)


@kind
def fillet_bore(n):
    body = bored_box(n)
    maker, radius = BRepFilletAPI_MakeFillet(body), n.real("rr", 0.3, 1.2)
    for edge in edges(body):
        if curve_kind(edge) != GeomAbs_Line and not BRep_Tool.IsClosed_s(edge, faces(body)[0]):
            maker.Add(radius, edge)
    maker.Build()
    return posed(maker.Shape(), n)


@kind
def fillet_torus(n):
    tilt = (n.real("dx", -0.3, 0.3), n.real("dy", -0.3, 0.3), 1)
    body = fuse(torus((0, 0, 0), (0, 0, 1), 15, 5), cylinder((0, 0, -12), tilt, n.real("r", 11, 14), 24))
    maker = BRepFilletAPI_MakeFillet(body)
    sections = [edge for edge in edges(body) if curve_kind(edge) == GeomAbs_BSplineCurve]
    maker.Add(n.real("rr", 0.4, 1.0), sections[0])
    maker.Build()
    return posed(maker.Shape(), n)


@kind
def chamfer(n):
    body = bored_box(n)
    maker, candidates = BRepFilletAPI_MakeChamfer(body), edges(body)
    for k in range(3):
        maker.Add(n.real(f"c{k}", 0.5, 2), candidates[n.whole(f"e{k}", 0, len(candidates) - 1)])
    maker.Build()
    return posed(maker.Shape(), n)


@kind
def draft(n):
    body = box(40, 30, 20)
    maker = BRepOffsetAPI_DraftAngle(body)
    for face in faces(body):
        if abs(BRepAdaptor_Surface(face).Plane().Axis().Direction().Z()) < 0.1:
            maker.Add(face, UP, n.real("a", 0.03, 0.2), gp_Pln(ORIGIN, UP))
    maker.Build()
    return posed(cut(maker.Shape(), drill(n, "b", (20, 15, 10), n.real("r", 2, 5))), n)


@kind
def shell(n):
    body = box(40, 30, 20)
    if not n.whole("k", 0, 1):
        body = fuse(body, cylinder((20, 15, 10), (0, 0, 1), n.real("r", 6, 10), 25))
    maker = BRepFilletAPI_MakeFillet(body)
    maker.Add(n.real("fr", 2, 4), edges(body)[0])
    maker.Build()
    sides = faces(maker.Shape())
    opening = sides[n.whole("f", 0, len(sides) - 1)]
    return posed(hollowed(maker.Shape(), [opening], n.real("t", -1.5, -0.5)), n)


@kind
def loft_shell(n):
    body = loft_body(n, ruled=False)
    ends = [face for face in faces(body) if BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane]
    return posed(hollowed(body, [ends[0]], n.real("t", -1, -0.4)), n)


@kind
def offset_shape(n):
    maker = BRepOffsetAPI_MakeOffsetShape()
    maker.PerformByJoin(loft_body(n, ruled=False), n.real("o", 0.5, 1.5), OFFSET_TOLERANCE)
    return posed(maker.Shape(), n)
