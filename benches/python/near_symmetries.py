"""Fits of nearly symmetric parts, of which a small feature alone distinguishes the poses.

    python near_symmetries.py COMMAND FOLDER

A disc of diameter 100 has a circle of bores of which one is missing, or a pin. The command fits copies
of it, moved in several ways, to it. Prints the number of fits whose root mean square is that of rounding,
the number of other fits that the command states as converged, the largest root mean square, and CPU
seconds a fit. It needs cadquery.
"""

import argparse
import json
import resource
import subprocess
from pathlib import Path

import cadquery as cq

#: The axis of the motions, their angles in degrees, and their shift.
AXIS, ANGLES, SHIFT = (1, 2, 3), (15, 40, 65, 85, 100, 125, 150, 170), (30, -20, 10)
#: The largest root mean square that is rounding.
EXACT = 1e-6


def ring(count, radius):
    """Return a disc with all bores but one of a circle of `count`."""
    disc = cq.Workplane().circle(50).extrude(5)
    return disc.faces(">Z").workplane().polarArray(40, 0, 360 - 720 / count, count - 1).hole(2 * radius)


def pinned():
    """Return a disc with a pin of diameter 1.5 and height 2."""
    disc = cq.Workplane().circle(50).extrude(5)
    return disc.union(cq.Workplane(origin=(35, 0, 5)).circle(0.75).extrude(2))


def fit(arguments, moved, part):
    """Return the answer of the command to a moved copy and its original."""
    files = [str(arguments.folder / f"{side}.step") for side in "ab"]
    for shape, file in zip((moved, part), files, strict=True):
        cq.exporters.export(cq.Workplane(obj=shape), file)
    command = [arguments.command, "align", *files, "--json"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    parts = {"11 of 12 bores": ring(12, 2), "23 of 24 bores": ring(24, 2), "35 of 36 bores": ring(36, 2)}
    for name, part in {**parts, "a pin": pinned()}.items():
        fits, before = [], resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        for angle in ANGLES:
            moved = part.val().rotate(cq.Vector(), cq.Vector(*AXIS), angle).translate(cq.Vector(*SHIFT))
            fits.append(fit(arguments, moved, part.val()))
        spent = (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before) / len(ANGLES)
        wrong = [one for one in fits if one["rms"] > EXACT]
        stated = sum(one["converged"] for one in wrong)
        largest = max(one["rms"] for one in fits)
        print(
            f"{name}: {len(fits) - len(wrong)} of {len(fits)} right, {stated} others converged, "
            f"rms up to {largest:.2g}, {spent:.1f} CPU s",
            flush=True,
        )


if __name__ == "__main__":
    main()
