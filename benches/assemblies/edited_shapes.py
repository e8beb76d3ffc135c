"""STEP files as OpenCASCADE reads them, edited and written again."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from random import Random

import numpy as np
from assembly import named
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepAlgoAPI import BRepAlgoAPI_Defeaturing
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex, BRepBuilderAPI_Transform
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.gp import gp_Pnt, gp_Trsf
from OCP.GProp import GProp_GProps
from OCP.STEPCAFControl import STEPCAFControl_Reader, STEPCAFControl_Writer
from OCP.TCollection import TCollection_AsciiString, TCollection_ExtendedString
from OCP.TDF import TDF_Label, TDF_LabelSequence, TDF_Tool
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Compound, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_Location, XCAFDoc_ShapeTool
from placement import direction, product, translation, turn

#: Points of a filled wall about its axis, along it, and of its caps from the axis to the wall.
AROUND, ALONG, ACROSS = 12, 12, 6
#: How near a point is to the faces that it lies on.
ON = 1e-6
#: What a part moves by, relative to its diagonal, and the angle that one turns by.
WAY, ANGLE = 0.07, 11.0
#: How many cylinders of a part, and parts, are tried to be filled.
HOLES, PARTS = 6, 8


class Unsuitable(Exception):
    """The file has nothing that can be edited so."""


@dataclass
class Leaf:
    """A solid or an open shell of one use of a product, in the frame of the file."""

    key: tuple
    shape: TopoDS_Shape

    @cached_property
    def surface(self) -> tuple[float, np.ndarray, np.ndarray]:
        """The area, the middle, and the second moments about it, of the surface."""
        found = GProp_GProps()
        BRepGProp.SurfaceProperties_s(self.shape, found, 1e-6)
        middle, moments = found.CentreOfMass(), found.MatrixOfInertia()
        inertia = np.array([[moments.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])
        return found.Mass(), np.array([middle.X(), middle.Y(), middle.Z()]), inertia

    @property
    def area(self) -> float:
        return self.surface[0]

    @cached_property
    def box(self) -> np.ndarray:
        found = Bnd_Box()
        BRepBndLib.AddOptimal_s(self.shape, found, False, False)
        low, high = found.CornerMin(), found.CornerMax()
        return np.array([[p.X(), p.Y(), p.Z()] for p in (low, high)])

    @property
    def diagonal(self) -> float:
        return float(np.linalg.norm(self.box[1] - self.box[0]))

    def is_as(self, other: Leaf, tolerance: float, motion: dict | None = None) -> bool:
        """Whether it lies as another one does, after a motion of the result."""
        shape = self.shape
        if motion is not None:
            trsf = product(translation(*motion["translation"]), turn(tuple(motion["axis"]), motion["angle"]))
            shape = BRepBuilderAPI_Transform(shape, trsf, True).Shape()
        area, middle, inertia = Leaf(self.key, shape).surface
        of_area, of_middle, of_inertia = other.surface
        size = self.diagonal
        return (
            abs(area - of_area) <= tolerance * area
            and np.abs(middle - of_middle).max() <= tolerance * size
            and np.abs(inertia - of_inertia).max() <= 4 * tolerance * area * size**2
        )


@dataclass
class Edit:
    """An edit, the leaves that it touches, and the size of the change as points show it, with their spacing."""

    label: str
    touched: set[tuple]
    size: tuple[float, float] | None = None


#: An edit of a document, by numbers drawn, of one of these leaves.
Change = Callable[["Document", Random, set[tuple]], Edit]


def entry(label: TDF_Label) -> str:
    text = TCollection_AsciiString()
    TDF_Tool.Entry_s(label, text)
    return text.ToCString()


def labels(sequence: TDF_LabelSequence) -> list[TDF_Label]:
    return [sequence.Value(index + 1) for index in range(sequence.Length())]


def pieces(shape: TopoDS_Shape) -> list[TopoDS_Shape]:
    """Return the solids of a shape, and the shells and faces that are in none."""
    found, within = [], TopAbs_ShapeEnum.TopAbs_SHAPE
    for kind, outside in (
        (TopAbs_ShapeEnum.TopAbs_SOLID, within),
        (TopAbs_ShapeEnum.TopAbs_SHELL, TopAbs_ShapeEnum.TopAbs_SOLID),
        (TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_SHELL),
    ):
        explorer = TopExp_Explorer(shape, kind, outside)
        while explorer.More():
            found.append(explorer.Current())
            explorer.Next()
    return found


@dataclass
class Use:
    """A use of a product: the labels of its components from the root, that of the product, and its place."""

    path: tuple[TDF_Label, ...]
    leaf: TDF_Label
    place: TopLoc_Location


@dataclass
class Document:
    """A file as OpenCASCADE reads it; of a copy, keys are those of the document that it is a copy of."""

    path: Path
    origin: Document | None = None
    keys: list[tuple] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
        reader = STEPCAFControl_Reader()
        reader.SetNameMode(True)
        reader.ReadFile(str(self.path))
        reader.Transfer(self.document)
        self.tool = XCAFDoc_DocumentTool.ShapeTool_s(self.document.Main())
        self.gone: set[tuple] = set()

    def uses(self) -> Iterator[Use]:
        roots = TDF_LabelSequence()
        self.tool.GetFreeShapes(roots)

        def below(label: TDF_Label, path: tuple[TDF_Label, ...], place: TopLoc_Location) -> Iterator[Use]:
            if not XCAFDoc_ShapeTool.IsAssembly_s(label):
                yield Use(path, label, place)
                return
            components = TDF_LabelSequence()
            XCAFDoc_ShapeTool.GetComponents_s(label, components)
            for component in labels(components):
                referred = TDF_Label()
                XCAFDoc_ShapeTool.GetReferredShape_s(component, referred)
                here = place.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(component))
                yield from below(referred, (*path, component), here)

        for root in labels(roots):
            yield from below(root, (), TopLoc_Location())

    def leaves(self) -> Iterator[Leaf]:
        """Return all leaves; those of a copy are in the order of its origin, and have its keys."""
        keys = None if self.origin is None else iter(list(self.origin.written()))
        for use in self.uses():
            for index, piece in enumerate(pieces(XCAFDoc_ShapeTool.GetShape_s(use.leaf))):
                key = (*map(entry, use.path), index) if keys is None else next(keys)
                yield Leaf(key, piece.Moved(use.place))

    def written(self) -> Iterator[tuple]:
        return (leaf.key for leaf in self.leaves())

    def touched(self, path: tuple[TDF_Label, ...] | None, leaf: TDF_Label, index: int | None) -> set[tuple]:
        """Return the leaves of a component's uses, or of a product's, or of its piece."""
        found = set()
        for use in self.uses():
            if use.leaf.IsEqual(leaf) and (path is None or use.path[-1].IsEqual(path[-1])):
                for at in range(len(pieces(XCAFDoc_ShapeTool.GetShape_s(leaf)))):
                    if index is None or at == index:
                        found.add((*map(entry, use.path), at))
        return found

    def write(self, path: Path) -> None:
        self.tool.UpdateAssemblies()
        writer = STEPCAFControl_Writer()
        writer.SetNameMode(True)
        writer.Transfer(self.document)
        writer.Write(str(path))

    def drawn(self, rng: Random, bodies: set[tuple]) -> tuple[Use, int | None]:
        """Return a use, or where the file is one product a piece of it, all of whose leaves are bodies of the command."""
        uses = list(self.uses())
        choices: list[tuple[Use, int | None]] = [(use, None) for use in uses if use.path]
        for use in uses:
            count = 0 if use.path else len(pieces(XCAFDoc_ShapeTool.GetShape_s(use.leaf)))
            if count > 1:
                choices.extend((use, index) for index in range(count))
        for use, index in rng.sample(choices, len(choices)):
            if self.touched(use.path or None, use.leaf, index) <= bodies:
                return use, index
        raise Unsuitable("one piece")

    def replace(self, leaf: TDF_Label, change: Callable[[int, TopoDS_Shape], TopoDS_Shape | None]) -> None:
        """Replace the shape of a product by its changed pieces."""
        whole, builder = TopoDS_Compound(), BRep_Builder()
        builder.MakeCompound(whole)
        old = pieces(XCAFDoc_ShapeTool.GetShape_s(leaf))
        new = [piece for index, old_one in enumerate(old) if (piece := change(index, old_one)) is not None]
        for piece in new:
            builder.Add(whole, piece)
        self.tool.SetShape(leaf, new[0] if len(new) == 1 else whole)


def of_none(document: Document, rng: Random, bodies: set[tuple]) -> Edit:
    return Edit("none", set())


def by_motion(label: str, motion_of: Callable[[Leaf, Random], gp_Trsf]) -> Change:
    def edit(document: Document, rng: Random, bodies: set[tuple]) -> Edit:
        use, index = document.drawn(rng, bodies)
        shape = XCAFDoc_ShapeTool.GetShape_s(use.leaf)
        piece = shape if index is None else pieces(shape)[index]
        if index is not None:
            motion = motion_of(Leaf((), piece), rng)
            found = document.touched(None, use.leaf, index)
            transformed = BRepBuilderAPI_Transform(piece, motion, True).Shape()
            document.replace(use.leaf, lambda at, old: transformed if at == index else old)
            return Edit(label, found)
        component = use.path[-1]
        place = XCAFDoc_ShapeTool.GetLocation_s(component)
        motion = motion_of(Leaf((), piece.Moved(place)), rng)
        found = document.touched(use.path, use.leaf, None)
        XCAFDoc_Location.Set_s(component, TopLoc_Location(product(motion, place.Transformation())))
        return Edit(label, found)

    return edit


def way(leaf: Leaf, rng: Random) -> gp_Trsf:
    return translation(*(WAY * leaf.diagonal * x for x in direction(rng)))


def oblique_turn(leaf: Leaf, rng: Random) -> gp_Trsf:
    return turn(direction(rng), ANGLE, tuple(leaf.box.mean(axis=0)))


def remove(document: Document, rng: Random, bodies: set[tuple]) -> Edit:
    use, index = document.drawn(rng, bodies)
    found = document.touched(use.path or None, use.leaf, index)
    # The keys of what is left, in the order in which the copy has it.
    left = [leaf.key for leaf in document.leaves() if leaf.key not in found]
    if index is not None:
        document.replace(use.leaf, lambda at, old: None if at == index else old)
    else:
        document.tool.RemoveComponent(use.path[-1])
        if XCAFDoc_ShapeTool.IsFree_s(use.leaf):
            # A product without a use would be written as a part at the origin.
            document.tool.RemoveShape(use.leaf)
    document.written = lambda: iter(left)
    return Edit("removed", found)


def rename(document: Document, rng: Random, bodies: set[tuple]) -> Edit:
    use, index = document.drawn(rng, bodies)
    if index is not None:
        raise Unsuitable("one product")
    found = document.touched(None, use.leaf, None)
    named(use.leaf, "renamed product")
    for other in document.uses():
        if other.leaf.IsEqual(use.leaf):
            named(other.path[-1], "renamed product")
    return Edit("renamed", found)


def fill(document: Document, rng: Random, bodies: set[tuple]) -> Edit:
    """Fill a hole: a cylinder all around whose material is outside."""
    products = {entry(use.leaf): use.leaf for use in document.uses()}
    for label in rng.sample(list(products.values()), min(PARTS, len(products))):
        for index, piece in enumerate(pieces(XCAFDoc_ShapeTool.GetShape_s(label))):
            if piece.ShapeType() != TopAbs_ShapeEnum.TopAbs_SOLID:
                continue
            found = document.touched(None, label, index)
            filled = without_hole(piece) if found <= bodies else None
            if filled is not None:
                document.replace(label, lambda at, old: filled[0] if at == index else old)
                return Edit("filled", found, filled[1])
    raise Unsuitable("no hole that OpenCASCADE fills")


def without_hole(solid: TopoDS_Shape) -> tuple[TopoDS_Shape, tuple[float, float]] | None:
    """Return the solid without one of its holes, with the distance of the wall's points and their spacing."""
    faces, holes = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE), {}
    while faces.More():
        face = TopoDS.Face(faces.Current())
        surface = BRepAdaptor_Surface(face)
        is_cylinder = surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder
        if is_cylinder and face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
            form = surface.Cylinder()
            foot = along_axis(gp_Pnt(0, 0, 0), surface)
            key = (round(form.Radius(), 5), *(round(x, 4) for x in foot))
            holes.setdefault(key, []).append((face, surface))
        faces.Next()
    volume = mass(solid)
    for walls in list(holes.values())[:HOLES]:
        turned = sum(surface.LastUParameter() - surface.FirstUParameter() for _, surface in walls)
        if turned < 2 * math.pi - 1e-6:
            continue
        filling = BRepAlgoAPI_Defeaturing()
        filling.SetShape(solid)
        for face, _ in walls:
            filling.AddFaceToRemove(face)
        filling.Build()
        if not filling.IsDone():
            continue
        result = pieces(filling.Shape())
        if len(result) == 1 and mass(result[0]) > volume * (1 + 1e-9):
            return result[0], farthest(walls, solid, result[0])
    return None


def mass(solid: TopoDS_Shape) -> float:
    found = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, found)
    return found.Mass()


def farthest(walls, solid: TopoDS_Shape, filled: TopoDS_Shape) -> tuple[float, float]:
    """Return how far points of walls are from the filled solid's faces, and points of these within the hole from the
    solid's; and how far the points are apart."""
    before, after = faces_of(solid), faces_of(filled)
    largest, spacing = 0.0, 0.0
    for _, surface in walls:
        radius = surface.Cylinder().Radius()
        us = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), AROUND)
        vs = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), ALONG)
        spacing = max(spacing, radius * (us[1] - us[0]) + (vs[1] - vs[0]) + radius / ACROSS)
        for u in us:
            for v in vs:
                at = surface.Value(u, v)
                largest = max(largest, distance(at, after))
            for v in (vs[0], vs[-1]):
                rim = surface.Value(u, v)
                middle = along_axis(rim, surface)
                for step in range(ACROSS):
                    at = gp_Pnt(*(m + (r - m) * step / ACROSS for m, r in zip(middle, rim.Coord())))
                    if distance(at, after) <= ON:
                        largest = max(largest, distance(at, before))
    return largest, spacing


def along_axis(point: gp_Pnt, surface: BRepAdaptor_Surface) -> tuple[float, ...]:
    """Return the foot of a point on the axis of a cylinder."""
    axis = surface.Cylinder().Axis()
    origin, along = axis.Location().Coord(), axis.Direction().Coord()
    way = sum((p - o) * d for p, o, d in zip(point.Coord(), origin, along))
    return tuple(o + way * d for o, d in zip(origin, along))


def faces_of(shape: TopoDS_Shape) -> TopoDS_Compound:
    whole, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(whole)
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        builder.Add(whole, faces.Current())
        faces.Next()
    return whole


def distance(point: gp_Pnt, faces: TopoDS_Compound) -> float:
    return BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(point).Vertex(), faces).Value()


EDITS: dict[str, Change] = {
    "none": of_none,
    "moved": by_motion("moved", way),
    "turned": by_motion("turned", oblique_turn),
    "removed": remove,
    "renamed": rename,
    "filled": fill,
}
