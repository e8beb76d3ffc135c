"""Generated parts as BREP text against the STEP that OpenCASCADE wrote of them.

    python formats.py COMMAND OUT.csv [--kinds A,B] [--seeds 0:10] [--seconds 20]

OpenCASCADE writes STEP without curves in the parameters, which the reader then makes anew. A line
of OUT.csv has a part's user seconds with reading, those of the search, and its cells, there and back.
"""

import argparse
import csv
import os
import sys
import tempfile
from pathlib import Path

import parts
from parts import KINDS
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_Controller

import cost
from sweep.shapes import through_step, write_brep


def made(kind, seed, base):
    """Writes both files in a process of its own, as OpenCASCADE may end it; whether that went well."""
    child = os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        try:
            STEPControl_Controller.Init_s()
            Interface_Static.SetIVal_s("write.surfacecurve.mode", 0)
            shape = parts.make(kind, seed)
            write_brep(shape, Path(f"{base}.brep"))
            through_step(shape, Path(f"{base}.step"), "MM")
        except Exception:
            os._exit(1)
        os._exit(0)
    return os.waitpid(child, 0)[1] == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--kinds", default=",".join(KINDS), help="names with commas, all by default")
    parser.add_argument("--seeds", default="0:10", help="first and the one after the last; those from 900 are kept for checking")
    parser.add_argument("--seconds", type=int, default=20, help="longest search")
    options = parser.parse_args()
    first, last = map(int, options.seeds.split(":"))
    with options.out.open("w", newline="") as file, tempfile.TemporaryDirectory() as folder:
        table = csv.writer(file)
        table.writerow(["part", "seed", "run", "end", "user s", "search s", "cells"])
        for seed in range(first, last):
            for kind in options.kinds.split(","):
                base = Path(folder) / f"{kind}_{seed}"
                if not made(kind, seed, base):
                    table.writerow([kind, seed, "", "OpenCASCADE makes no such part"])
                    continue
                files = [Path(f"{base}.brep"), Path(f"{base}.step")]
                for run, (a, b) in {"there": files, "back": files[::-1]}.items():
                    found = cost.distance(options.command, a, b, options.seconds)
                    row = [kind, seed, run, found.status, f"{found.seconds:.2f}", f"{found.solve:.2f}", found.cells]
                    table.writerow(row)
                file.flush()
                for path in files:
                    path.unlink()


if __name__ == "__main__":
    main()
