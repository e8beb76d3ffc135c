"""Reads IGES files by the native command and by OpenCASCADE, and compares both readings.

    python iges.py write FOLDER      a part of each kind as IGES, in both modes of OpenCASCADE
    python iges.py compare COMMAND FOLDER

COMMAND is the `nurbs-hausdorff` executable. `compare` writes a line of JSON a file: faces, areas by OpenCASCADE's quadrature and by
the command (of the file, and of OpenCASCADE's translation as BREP text), gaps, CPU seconds, and whether
each reading is within the sum of the gaps of the other, or within 1e-5 of the diagonal.
"""

import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

from OCP.BRepGProp import BRepGProp
from OCP.BRepTools import BRepTools
from OCP.GProp import GProp_GProps
from OCP.IGESControl import IGESControl_Reader, IGESControl_Writer
from OCP.Message import Message
from OCP.TopAbs import TopAbs_FACE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from parts import KINDS, make

# Relative to the faces' areas: both quadratures' accuracy.
AREA_TOLERANCE = 2e-6
# Relative to the diagonal: a distance below it is not decided in a few seconds.
LEAST_LIMIT = 1e-5
SEARCH_SECONDS = 2
PART_SECONDS = 60


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


def areas(shape):
    found, explorer = [], TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        properties = GProp_GProps()
        BRepGProp.SurfaceProperties_s(TopoDS.Face_s(explorer.Current()), properties, 1e-9)
        found.append(abs(properties.Mass()))
        explorer.Next()
    return found


def run(command, *arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    result = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True, check=False)
    return result, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def info(command, path):
    result, seconds = run(command, "info", "--json", path)
    if result.returncode:
        return None, result.stderr.strip(), seconds
    return json.loads(result.stdout), result.stderr.strip(), seconds


def differing(faces, expected):
    """The faces whose area differs from an expected one."""
    def off(face, area):
        lower, upper = face["area"]["lower"], face["area"]["upper"]
        return abs(0.5 * (lower + upper) - area) > AREA_TOLERANCE * area + upper - lower

    return [index for index, pair in enumerate(zip(faces, expected)) if off(*pair)]


def compare(command, path):
    reader, start = IGESControl_Reader(), time.process_time()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    row = {"file": path.name, "occtSeconds": time.process_time() - start}
    text = path.with_suffix(".brep")
    BRepTools.Write_s(shape, str(text))
    expected = areas(shape)
    own, remarks, row["seconds"] = info(command, path)
    translated, _, _ = info(command, text)
    row |= {"occtFaces": len(expected), "remarks": remarks[:300]}
    if own is None:
        return row
    row |= {"faces": len(own["faces"]), "gap": own["gap"]}
    if len(expected) == row["faces"]:
        row["areas"] = differing(own["faces"], expected)
    if translated is None:
        return row
    row |= {"brepFaces": len(translated["faces"]), "brepGap": translated["gap"]}
    if row["brepFaces"] == row["faces"]:
        middle = [0.5 * (face["area"]["lower"] + face["area"]["upper"]) for face in translated["faces"]]
        row["brepAreas"] = differing(own["faces"], middle)
        limit = max(own["gap"] + translated["gap"], LEAST_LIMIT * own["diagonal"])
        arguments = ["--limit", limit, "--max-seconds", SEARCH_SECONDS]
        pairs = ((path, text), (text, path))
        row["within"] = [run(command, "distance", *pair, *arguments)[0].returncode for pair in pairs]
    return row


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write(Path(sys.argv[2]))
    else:
        Message.DefaultMessenger_s().ChangePrinters().Clear()
        for file in sorted(Path(sys.argv[3]).glob("*.ig*s")):
            print(json.dumps(compare(sys.argv[2], file)), flush=True)
