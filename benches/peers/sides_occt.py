"""Compares the sides of points with OpenCASCADE's BRepClass3d_SolidClassifier.

    python3 benches/peers/sides_occt.py FOLDER

FOLDER has the STEP files that `cargo bench --bench sides -- FOLDER/*` has classified; its points are
read from target/sides. Prints, per file, how many points both put on the same side, and the distance
from the boundary of those on which they differ.
"""

import sys
import time
from pathlib import Path

from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepClass3d import BRepClass3d_SolidClassifier
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.gp import gp_Pnt
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE, TopAbs_IN, TopAbs_ON, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS_Compound

POINTS = 1000


def explored(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def main(folder):
    print("| model | solids | points | same | differ | least distance of those that differ | µs a point |")
    print("|---|---|---|---|---|---|---|")
    for path in sorted(folder.iterdir()):
        found = Path("target/sides") / f"{path.stem}.txt"
        if path.suffix.lower() not in (".step", ".stp") or not found.exists():
            continue
        lines = [line.split() for line in found.read_text().splitlines()[:POINTS]]
        if not lines:
            continue
        reader = STEPControl_Reader()
        reader.ReadFile(str(path))
        reader.TransferRoots()
        shape = reader.OneShape()
        solids = list(explored(shape, TopAbs_SOLID))
        faces, builder = TopoDS_Compound(), BRep_Builder()
        builder.MakeCompound(faces)
        for face in explored(shape, TopAbs_FACE):
            builder.Add(faces, face)
        classifiers = [BRepClass3d_SolidClassifier(solid) for solid in solids]
        same, apart, started = 0, [], time.process_time()
        for x, y, z, side in lines:
            point = gp_Pnt(float(x), float(y), float(z))
            states = []
            for classifier in classifiers:
                classifier.Perform(point, 1e-7)
                states.append(classifier.State())
            inside = sum(state == TopAbs_IN for state in states) % 2 == 1
            if TopAbs_ON in states or inside == (side == "Inside"):
                same += 1
            else:
                vertex = BRepBuilderAPI_MakeVertex(point).Vertex()
                apart.append(BRepExtrema_DistShapeShape(vertex, faces).Value())
        each = 1e6 * (time.process_time() - started) / len(lines)
        least = f"{min(apart):.1e}" if apart else ""
        print(f"| {path.name} | {len(solids)} | {len(lines)} | {same} | {len(apart)} | {least} | {each:.0f} |")


main(Path(sys.argv[1]))
