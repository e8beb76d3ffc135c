"""Time `check` of an assembly of bodies of 20 faces each, which touch their neighbours or come near them.

    python benches/assemblies/speed.py COMMAND [BODIES [SEED]]

Each body is a plate with rounded corners, seven bores and a boss with a bore, no two alike. Plates stand flush along x and
0.3 apart along y; the bosses carry the plates above them. Prints the seconds that the command states, by the clock, and
the CPU seconds of the process with reading.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from random import Random

from assembly import named, silently
from OCP.BRepFilletAPI import BRepFilletAPI_MakeFillet
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS, TopoDS_Shape
from OCP.XCAFDoc import XCAFDoc_DocumentTool
from parts import box, cut, cylinder, fuse, is_along_z
from placement import product, translation, turn

SIDE = 20.0
PER_ROW = 5
FACES = 20


def main() -> None:
    command = sys.argv[1]
    bodies, seed = (int(value) for value in [*sys.argv[2:4], *["100", "1"][len(sys.argv) - 2 :]])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "assembly.step")
        silently(lambda: write(bodies, path, Random(seed)))
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        answer = subprocess.run([command, "check", str(path), "--json"], capture_output=True, text=True, check=False)
        wall, after = time.monotonic() - started, resource.getrusage(resource.RUSAGE_CHILDREN)
    result = json.loads(answer.stdout)
    print(f"{len(result['bodies'])} bodies: pairs {dict(Counter(pair['state'] for pair in result['pairs']))}")
    print(f"embedded: {dict(Counter(body['embedded'] for body in result['bodies']))}")
    print(f"after reading: {result['seconds']}; with it {wall:.2f} s, {after.ru_utime - before.ru_utime:.2f} CPU s")


def body(rng: Random, moved: float = 0.0, wider: float = 0.0) -> TopoDS_Shape:
    """Return a plate of 20 faces, 4 to 6 thick, with its boss 3 high.

    One of its bores is moved by a length along x, another has a radius larger by a length.
    """
    thickness = rng.uniform(4, 6)
    plate = rounded_along_z(box(SIDE, SIDE, thickness), rng.uniform(1, 2))
    plate = fuse(plate, cylinder(rng.uniform(3, 4), 9 - thickness, (10, 10, thickness)))
    places = [(3 + moved, 3), (17, 3), (3, 17), (17, 17), (10, 3), (3, 10), (17, 10)]
    bores = [
        cylinder(rng.uniform(0.5, 1.5) + (wider if index == 1 else 0.0), thickness, (x, y, 0))
        for index, (x, y) in enumerate(places)
    ]
    solid = cut(plate, *bores, cylinder(rng.uniform(1, 2), 9, (10, 10, 0)))
    faces = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE)
    count = 0
    while faces.More():
        count += 1
        faces.Next()
    if count != FACES:
        raise ValueError(f"a body of {count} faces")
    return solid


def rounded_along_z(shape: TopoDS_Shape, radius: float) -> TopoDS_Shape:
    fillet = BRepFilletAPI_MakeFillet(shape)
    edges = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_EDGE)
    while edges.More():
        edge = TopoDS.Edge(edges.Current())
        if is_along_z(edge):
            fillet.Add(radius, edge)
        edges.Next()
    return fillet.Shape()


def write(bodies: int, path: Path, rng: Random) -> None:
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    root = named(tool.NewShape(), "assembly")
    # Turned as a whole, so that no face is along an axis.
    whole = product(turn((1, 2, 3), 40), translation(5, -3, 11))
    for index in range(bodies):
        column, row, layer = index % PER_ROW, index // PER_ROW % PER_ROW, index // PER_ROW**2
        place = product(whole, translation(SIDE * column, (SIDE + 0.3) * row, 9 * layer))
        name = f"plate {index}"
        named(tool.AddComponent(root, named(tool.AddShape(body(rng), False), name), TopLoc_Location(place)), name)
    tool.UpdateAssemblies()
    writer = STEPCAFControl_Writer()
    writer.SetNameMode(True)
    writer.Transfer(document)
    writer.Write(str(path))


if __name__ == "__main__":
    main()
