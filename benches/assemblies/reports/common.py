"""Files of the situations, the command's answers, and what OpenCASCADE says by a boolean operation."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent))

from assembly import named, silently  # noqa: E402
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common  # noqa: E402
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform  # noqa: E402
from OCP.BRepGProp import BRepGProp  # noqa: E402
from OCP.gp import gp_Trsf  # noqa: E402
from OCP.GProp import GProp_GProps  # noqa: E402
from OCP.STEPCAFControl import STEPCAFControl_Writer  # noqa: E402
from OCP.TCollection import TCollection_ExtendedString  # noqa: E402
from OCP.TDocStd import TDocStd_Document  # noqa: E402
from OCP.TopLoc import TopLoc_Location  # noqa: E402
from OCP.TopoDS import TopoDS_Shape  # noqa: E402
from OCP.XCAFDoc import XCAFDoc_DocumentTool  # noqa: E402

Parts = dict[str, tuple[TopoDS_Shape, gp_Trsf]]


def written(parts: Parts, folder: str, name: str) -> Path:
    """Write parts, each by its name with a shape and a place, as one assembly; a shape used twice is one product."""
    path = Path(folder, name)
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    root = named(tool.NewShape(), "assembly")
    products: list[tuple[TopoDS_Shape, object]] = []
    for part, (shape, place) in parts.items():
        label = next((label for other, label in products if other is shape), None)
        if label is None:
            # Of its uses the last by name, so that the order of the parts changes no name.
            product = max(name for name, (other, _) in parts.items() if other is shape)
            label = named(tool.AddShape(shape, False), product)
            products.append((shape, label))
        named(tool.AddComponent(root, label, TopLoc_Location(place)), part)
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)

    def write() -> None:
        writer.Transfer(document)
        writer.Write(str(path))

    silently(write)
    return path


def asked(*arguments: str | Path) -> dict:
    """Return the answer of the command, whose path is the script's first argument, as JSON."""
    words = [sys.argv[1], *map(str, arguments), "--json"]
    answer = subprocess.run(words, capture_output=True, text=True, check=False)
    if not answer.stdout:
        raise RuntimeError(answer.stderr)
    return json.loads(answer.stdout)


def checked(parts: Parts, *options: str) -> dict:
    """Return what `check` says of the parts."""
    with tempfile.TemporaryDirectory() as folder:
        return asked("check", written(parts, folder, "assembly.step"), *options)


def compared(before: Parts, after: Parts, limit: float = 1e-3) -> list[dict]:
    """Return what `diff` says of each part."""
    with tempfile.TemporaryDirectory() as folder:
        files = [written(before, folder, "a.step"), written(after, folder, "b.step")]
        return asked("diff", *files, "--limit", str(limit))["parts"]


def leaf(name: str | None) -> str:
    """Return the last level of a body's name: of a use, behind its product's name, that of the use."""
    last = (name or "–").split(" / ")[-1]
    return last[last.index("(") + 1 : -1] if last.endswith(")") else last


def interval(value: dict | None) -> str:
    return "–" if value is None else f"[{value['lower']:.6g}, {value['upper']:.6g}]"


def show_pairs(result: dict) -> None:
    """Print each pair that is not apart."""
    for pair in result["pairs"]:
        names = f"{leaf(pair['a'])} and {leaf(pair['b'])}"
        if pair["state"] == "clash":
            print(f"  {names}: clash, volume {interval(pair['volume'])}, depth {interval(pair['depth'])}")
        elif pair["state"] != "apart":
            print(f"  {names}: {pair['state']}, clearance {interval(pair['clearance'])} {pair.get('why') or ''}")
    print(f"  clean: {result['clean']}")


def show_parts(parts: list[dict]) -> None:
    """Print what became of each part that is not the same."""
    for part in parts:
        if part["state"] == "same":
            continue
        names = " -> ".join(leaf(part[side]) for side in ("nameOfA", "nameOfB"))
        print(f"  {names}: {part['state']}")
    same = sum(part["state"] == "same" for part in parts)
    print(f"  the same: {same} of {len(parts)}")


def placed(shape: TopoDS_Shape, place: gp_Trsf) -> TopoDS_Shape:
    return BRepBuilderAPI_Transform(shape, place, True).Shape()


def volume(shape: TopoDS_Shape) -> float:
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return properties.Mass()


def common_volume(parts: Parts, one: str, other: str) -> float:
    """Return the volume of the common part of two parts by a boolean operation of OpenCASCADE."""
    return volume(BRepAlgoAPI_Common(placed(*parts[one]), placed(*parts[other])).Shape())
