"""Reads STEP and IGES files by the native command and by OpenCASCADE, and compares both readings.

    python readers.py write FOLDER               a part of each kind as IGES, in both modes of OpenCASCADE
    python readers.py compare COMMAND OUT FILE... a row of OUT, a CSV file, for each file

COMMAND is the `nurbs-hausdorff` executable; a file may be compressed by gzip. A row has, of the command
and of OpenCASCADE with its translation to BREP text: faces, the faces whose areas differ from OpenCASCADE's
quadrature and from the translation's, gaps, CPU seconds and MiB (of the command's process, and of what
OpenCASCADE adds to its own by reading and writing), and the bounds on the distance of both readings each way, which the sum of both gaps explains where the lower
bounds are below it.
"""

import csv
import gzip
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.GProp import GProp_GProps
from OCP.IGESControl import IGESControl_Reader, IGESControl_Writer
from OCP.Interface import Interface_Static
from OCP.Message import Message
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS
from OCP.TopTools import TopTools_IndexedMapOfShape
from parts import KINDS, make

# Relative to the faces' areas.
AREA_TOLERANCE = 1e-6
# Relative to the diagonal: what cuts and searches may add to the distance of equal models.
ROUNDING = 1e-8
# A gap exceeds the distance that it bounds by up to a tenth, and by what is not resolved of exact curves.
GAP_LOOSENESS = 1.1
GAP_ROUNDING = 1e-9
SEARCH_SECONDS = 60
PART_SECONDS = 60
FILE_SECONDS = 300
MEBIBYTE = 1024

COLUMNS = [
    "file", "occt faces", "faces", "skipped", "areas off occt", "areas off its brep", "gap", "occt gap",
    "gap no larger", "there", "back", "within gaps", "cpu s", "occt cpu s", "mib", "occt mib", "remarks",
]


def write(folder):
    """Writes a part of each kind as trimmed surfaces (mode 0) and as a solid (mode 1)."""
    folder.mkdir(parents=True, exist_ok=True)
    for seed, kind in enumerate(KINDS):
        if os.fork() == 0:  # the kernel may crash or hang
            signal.alarm(PART_SECONDS)
            shape = make(kind, seed)
            for mode in (0, 1):
                writer = IGESControl_Writer("INCH" if seed % 3 == 1 else "MM", mode)
                writer.AddShape(shape)
                writer.ComputeModel()
                writer.Write(str(folder / f"{kind}_{mode}.igs"))
            os._exit(0)
        os.wait()


def measures(shape):
    """The areas and the lengths of the edges of the distinct faces, in the order of TopExp."""
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, TopAbs_FACE, faces)
    areas, lengths = [], []
    for index in range(1, faces.Extent() + 1):
        of_area, of_length = GProp_GProps(), GProp_GProps()
        BRepGProp.SurfaceProperties_s(TopoDS.Face_s(faces.FindKey(index)), of_area, 1e-9)
        BRepGProp.LinearProperties_s(faces.FindKey(index), of_length)
        areas.append(abs(of_area.Mass()))
        lengths.append(of_length.Mass())
    return {"areas": areas, "lengths": lengths}


def translate(path, text):
    """Translates a file to BREP text by OpenCASCADE, and writes the areas beside it."""
    Message.DefaultMessenger_s().ChangePrinters().Clear()
    # The bindings of the kernel take time and memory before it reads.
    before = resource.getrusage(resource.RUSAGE_SELF)
    is_iges = path.suffix.lower() in (".igs", ".iges")
    reader = IGESControl_Reader() if is_iges else STEPControl_Reader()
    # OpenCASCADE moves a model by a placement among the items of its representation; ISO 10303-43 gives such
    # a placement no effect on the others.
    Interface_Static.SetCVal_s("read.step.root.transformation", "OFF")
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    BRepTools.Write_s(shape, str(text))
    used = resource.getrusage(resource.RUSAGE_SELF)
    measured = {"seconds": used.ru_utime - before.ru_utime, "kib": used.ru_maxrss - before.ru_maxrss}
    # The areas are no part of the reading that is measured.
    text.with_suffix(".json").write_text(json.dumps({**measures(shape), **measured}))


def run(command, *arguments):
    """Runs the command: its result, CPU seconds and MiB."""
    process = subprocess.Popen(
        [command, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    output, errors = process.communicate()
    return process.returncode, output, errors


def measured(command, path, out):
    """CPU seconds and MiB of a process that reads a file, cuts it and writes it as interchange JSON."""
    # A process counts the memory of the one that starts it, so that a small one must.
    words = ["time", "--quiet", "--format", "%U %M", command, "convert", "--overwrite", str(path), str(out)]
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    errors = subprocess.run(words, capture_output=True, text=True, env=environment).stderr
    seconds, kibibytes = errors.split("\n")[-2].split()
    return float(seconds), float(kibibytes) / MEBIBYTE


def info(command, path):
    status, output, errors = run(command, "info", "--json", path)
    return (None if status else json.loads(output)), errors.strip()


def middles(faces):
    return [0.5 * (face["area"]["lower"] + face["area"]["upper"]) for face in faces]


def differing(faces, others, lengths, expected):
    """The number of faces whose area differs from the expected one by more than the tolerance and the gaps
    of both readings along the edges of the face."""
    found = 0
    for face, other, length, area in zip(faces, others, lengths, expected):
        lower, upper = face["area"]["lower"], face["area"]["upper"]
        allowed = AREA_TOLERANCE * area + upper - lower + length * (face["gap"] + other["gap"])
        found += abs(0.5 * (lower + upper) - area) > allowed
    return found


def distance(command, a, b, limit):
    """The interval of the directed distance, found to a fraction of the limit."""
    arguments = ["--json", "--tolerance", limit, "--max-seconds", SEARCH_SECONDS, "--allow-skipped"]
    status, output, _ = run(command, "distance", a, b, *arguments)
    if status not in (0, 1, 3) or not output:
        return None
    result = json.loads(output)
    return result["lower"], result["upper"]


def compared(command, path, folder):
    """The row of a file."""
    text = folder / "translated.brep"
    row = {"file": path.name}
    # The kernel may crash or hang.
    translation = [sys.executable, __file__, "translate", str(path), str(text)]
    status = subprocess.run(["timeout", str(FILE_SECONDS), *translation], capture_output=True).returncode
    own, remarks = info(command, path)
    seconds, mebibytes = measured(command, path, folder / "own.json")
    row |= {"cpu s": f"{seconds:.2f}", "mib": f"{mebibytes:.0f}", "remarks": remarks.replace("\n", " ")[:300]}
    if own is not None:
        row |= {"faces": len(own["faces"]), "gap": f"{own['gap']:.1e}", "skipped": len(own["skipped"])}
    if status:
        return row | {"remarks": f"OpenCASCADE ends with {status}; {row['remarks']}"}
    occt = json.loads(text.with_suffix(".json").read_text())
    expected = occt["areas"]
    row |= {"occt faces": len(expected), "occt cpu s": f"{occt['seconds']:.2f}", "occt mib": f"{occt['kib'] / MEBIBYTE:.0f}"}
    if own is None:
        return row
    faces = own["faces"]
    translated, _ = info(command, text)
    if translated is None:
        return row
    row["occt gap"] = f"{translated['gap']:.1e}"
    row["gap no larger"] = own["gap"] <= GAP_LOOSENESS * translated["gap"] + GAP_ROUNDING * own["diagonal"]
    others = translated["faces"]
    if len(others) == len(faces) == len(expected):
        row["areas off occt"] = differing(faces, others, occt["lengths"], expected)
        row["areas off its brep"] = differing(faces, others, occt["lengths"], middles(others))
    limit = own["gap"] + translated["gap"] + ROUNDING * own["diagonal"]
    found = [distance(command, *pair, max(0.1 * limit, ROUNDING * own["diagonal"])) for pair in ((path, text), (text, path))]
    if None not in found:
        row["there"], row["back"] = (f"{lower:.2e} to {upper:.2e}" for lower, upper in found)
        upper, lower = max(upper for _, upper in found), max(lower for lower, _ in found)
        row["within gaps"] = "yes" if upper <= limit else "no" if lower > limit else "undecided"
    return row


def compare(command, out, paths):
    with out.open("w", newline="") as file:
        rows = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        rows.writeheader()
        for path in paths:
            with tempfile.TemporaryDirectory() as folder:
                if path.suffix == ".gz":
                    unpacked = Path(folder) / path.stem
                    unpacked.write_bytes(gzip.decompress(path.read_bytes()))
                    path = unpacked
                rows.writerow(compared(command, path, Path(folder)))
            file.flush()


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(Path(sys.argv[2]))
    elif sys.argv[1] == "translate":
        translate(Path(sys.argv[2]), Path(sys.argv[3]))
    else:
        compare(sys.argv[2], Path(sys.argv[3]), [Path(name) for name in sys.argv[4:]])
