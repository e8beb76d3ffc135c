"""Radii that `info` states of faces, beside those of the surfaces that STEP files have.

    python benches/python/forms.py COMMAND FILE...

Prints for each file how many faces of each kind of its source lie on which form, the largest relative
width of a radius, and of faces that are spheres, cylinders or tori in the file too the radii that none
of these has.
Files may be compressed by gzip. Only the standard library is used: the text is read by patterns.
"""

import collections
import gzip
import json
import pathlib
import re
import subprocess
import sys

SURFACES = {
    "cylinder": re.compile(r"CYLINDRICAL_SURFACE\s*\(\s*'[^']*'\s*,\s*#\d+\s*,\s*([-\d.Ee+]+)"),
    "sphere": re.compile(r"SPHERICAL_SURFACE\s*\(\s*'[^']*'\s*,\s*#\d+\s*,\s*([-\d.Ee+]+)"),
    "torus": re.compile(r"TOROIDAL_SURFACE\s*\(\s*'[^']*'\s*,\s*#\d+\s*,\s*[-\d.Ee+]+\s*,\s*([-\d.Ee+]+)"),
}
#: Units of the file in those of the model: the same, inches and centimetres in millimetres.
FACTORS = (1.0, 25.4, 10.0, 1000.0)
#: Lengths are multiplied once and rounded.
ROUNDING = 4e-16


def main():
    command, *files = sys.argv[1:]
    for file in map(pathlib.Path, files):
        ran = subprocess.run([command, "info", file, "--json"], capture_output=True, text=True)
        if ran.returncode != 0:
            print(f"{file.name}: {ran.stderr.splitlines()[0]}")
            continue
        opened = gzip.open(file, "rt", errors="replace") if file.suffix == ".gz" else open(file, errors="replace")
        with opened as text:
            content = text.read()
        stated = {kind: {float(one) for one in found.findall(content)} for kind, found in SURFACES.items()}
        report(file.name, json.loads(ran.stdout)["faces"], stated)


def report(name, faces, stated):
    kinds = collections.Counter((face.get("kind"), face.get("form", {}).get("kind")) for face in faces)
    round_faces = [face for face in faces if "radius" in face.get("form", {})]
    radii = [face["form"]["radius"] for face in round_faces]
    widths = [(one["upper"] - one["lower"]) / one["upper"] for one in radii]
    same = [face["form"] for face in round_faces if face.get("kind") == face["form"]["kind"]]
    unstated = [(form["kind"], form["radius"]) for form in same if not is_stated(form["radius"], stated[form["kind"]])]
    counts = ", ".join(f"{count} {source} on {form}" for (source, form), count in kinds.most_common())
    print(f"{name}: {counts}; {len(radii)} radii, width up to {max(widths, default=0.0):.1e}; {len(same)} compared")
    for kind, one in unstated:
        print(f"    {kind} {one['lower']!r} … {one['upper']!r} is no radius of the file's surfaces")


def is_stated(radius, stated):
    return any(
        radius["lower"] <= one * factor * (1 + ROUNDING) and one * factor * (1 - ROUNDING) <= radius["upper"]
        for one in stated
        for factor in FACTORS
    )


if __name__ == "__main__":
    main()
