"""Writes the pairs of trimmed parts that `run.py` measures, as BREP text.

    python pairs.py MODELS OUT

MODELS is the folder of the shared models, OUT a folder for the files. Needs
OpenCASCADE's Python bindings (`pip install cadquery-ocp-novtk`).
"""

import gzip
import sys
import tempfile
from pathlib import Path

from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
from OCP.BRepTools import BRepTools
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.IGESControl import IGESControl_Reader, IGESControl_Writer
from OCP.STEPControl import STEPControl_Reader

STEP_FILES = ["NIST_MBE_PMI_1.stp", "NIST_MBE_PMI_2.stp", "NIST_MBE_PMI_5.stp", "NIST_MBE_PMI_11.stp", "linkrods.step"]
IGES_FILES = ["bearing.iges"]

# A threaded hole's bore of NIST_MBE_PMI_2: a point of its axis, the direction, the
# radius and the length, read from the file; and by how much it is enlarged.
BORE = ((653.17, -265.0, 185.0), (0.0, 1.0, 0.0), 4.188, 25.0)
ENLARGEMENT = 0.1


def read(reader, path):
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return reader.OneShape()


def unpacked(path):
    file = tempfile.NamedTemporaryFile(suffix=path.suffixes[0], delete=False)
    file.write(gzip.open(path).read())
    file.close()
    return file.name


def write(shape, path):
    BRepTools.Write_s(shape, str(path))


def through_iges(shape):
    """The shape as IGES keeps it: other trims and p-curves, gaps of micrometres."""
    writer = IGESControl_Writer("MM", 1)
    writer.AddShape(shape)
    writer.ComputeModel()
    path = tempfile.mktemp(".igs")
    writer.Write(path)
    return read(IGESControl_Reader(), path)


def main(models, out):
    out.mkdir(parents=True, exist_ok=True)
    shapes = {}
    for name in STEP_FILES:
        shapes[name] = read(STEPControl_Reader(), unpacked(models / "step" / f"{name}.gz"))
    for name in IGES_FILES:
        shapes[name] = read(IGESControl_Reader(), unpacked(models / "iges" / f"{name}.gz"))
    for name, shape in shapes.items():
        write(shape, out / f"{name}.brep")
    point, direction, radius, length = BORE
    axis = gp_Ax2(gp_Pnt(*point), gp_Dir(*direction))
    cylinder = BRepPrimAPI_MakeCylinder(axis, radius + ENLARGEMENT, length).Shape()
    write(BRepAlgoAPI_Cut(shapes["NIST_MBE_PMI_2.stp"], cylinder).Shape(), out / "nist_2_bore.brep")
    for name in ["NIST_MBE_PMI_1.stp", "linkrods.step"]:
        write(through_iges(shapes[name]), out / f"{name}.iges.brep")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
