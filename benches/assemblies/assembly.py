"""An assembly as a tree of instances, and its STEP file."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.gp import gp_Trsf
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool
from parts import Part, draw
from placement import mirror_in_x, product, random_turn, translation

# Parts are at most 40 wide; a cell of the grid holds one with any turn, and what an edit moves stays free of others.
SPACING = 120.0


@dataclass
class Instance:
    """A part at a place; `frame` is the frame of its file, which no word may depend on."""

    name: str
    part: Part
    place: gp_Trsf
    frame: gp_Trsf = field(default_factory=gp_Trsf)
    is_mirrored: bool = False


@dataclass
class Group:
    """A sub-assembly: instances in its frame."""

    name: str
    place: gp_Trsf
    instances: list[Instance]


def drawn(rng: Random, count: int) -> list[Group]:
    """Return groups of `count` instances in all, of about a third as many distinct parts, with turns at random."""
    kinds = [draw(rng) for _ in range(max(2, count // 3))]
    groups = [Group(f"group {i + 1}", translation(0, 0, i * 6 * SPACING), []) for i in range(1 + count // 6)]
    for index in range(count):
        part = rng.choice(kinds)
        cell = translation(SPACING * (index % 4), SPACING * (index // 4 % 4), SPACING * (index // 16))
        place = product(cell, random_turn(rng))
        groups[index % len(groups)].instances.append(Instance(f"{part.kind} {index + 1}", part, place))
    return [group for group in groups if group.instances]


def write(groups: list[Group], path: Path) -> None:
    """Write the assembly as STEP: equal parts in equal frames are one product with several uses."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    root = named(tool.NewShape(), "assembly")
    products: list[tuple[Instance, TDF_Label]] = []
    for group in groups:
        label = named(tool.NewShape(), group.name)
        for instance in group.instances:
            product_label = product_of(tool, instance, products)
            place = product(instance.place, instance.frame.Inverted())
            named(tool.AddComponent(label, product_label, TopLoc_Location(place)), instance.name)
        named(tool.AddComponent(root, label, TopLoc_Location(group.place)), group.name)
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.Transfer(document)
    writer.Write(str(path))


def product_of(
    tool: XCAFDoc_ShapeTool, instance: Instance, products: list[tuple[Instance, TDF_Label]]
) -> TDF_Label:
    """Return the label of the instance's product, which is made at its first use."""
    for other, label in products:
        is_equal = (other.part, other.is_mirrored) == (instance.part, instance.is_mirrored)
        if is_equal and other.frame is instance.frame:
            return label
    label = named(tool.AddShape(shape_of(instance), False), instance.part.kind)
    products.append((instance, label))
    return label


def shape_of(instance: Instance) -> TopoDS_Shape:
    """Return the part's geometry in the frame of its file."""
    shape = instance.part.build()
    if instance.is_mirrored:
        shape = BRepBuilderAPI_Transform(shape, mirror_in_x(), True).Shape()
    return BRepBuilderAPI_Transform(shape, instance.frame, True).Shape()


def named(label: TDF_Label, name: str) -> TDF_Label:
    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
    return label


def silently(work) -> None:
    """Run what writes to standard output below Python, and drop what it says."""
    sys.stdout.flush()
    kept, sink = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 1)
    try:
        work()
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(sink)
