"""A real assembly whose clashes were reported: partcad#663, the AeroAssembly of its examples, found by the checks of #621.

    python benches/assemblies/reports/imported_assembly.py COMMAND FOLDER

FOLDER holds `AeroAssembly.step` and the folder `AeroAssembly_assy_example` of github.com/partcad/partcad, as they are in
`examples/feature_import` (commit bbf642c0). The report states three common volumes of the assembly by its description,
which places the eight parts by rounded numbers; the STEP file has the places that CAD gave them. The thickness is that of the
smallest box of a boolean's result: below the tolerance, bodies in each other are `touching`.
"""

import sys
import tempfile
from itertools import combinations
from pathlib import Path

import yaml
from common import asked, interval, leaf, placed, show_pairs, volume, written
from assembly import silently
from check_files_peers import read_step, solids
from OCP.Bnd import Bnd_OBB
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepBndLib import BRepBndLib
from placement import product, translation, turn

#: What partcad#663 states, in mm³.
REPORTED = {
    frozenset(("AeroFrame_Plate", "AeroFrame_Cap")): 90.231,
    frozenset(("AeroFrame_Plate", "MirrorAeroFrameAssembly_solid1")): 12.997,
    frozenset(("MirrorAeroFrameAssembly_solid1", "MirrorAeroFrameAssembly_solid3")): 0.161,
}
LAST_DIGIT = 5e-4


def described(folder: Path):
    """Return the parts of the description with their places."""
    parts = {}

    def add(links) -> None:
        for link in links:
            if link["type"] == "assembly":
                add(link["links"])
                continue
            at, axis, angle = link["location"]
            silently(lambda: read.append(read_step(folder / f"{link['name']}.step")[0]))
            parts[link["name"]] = (next(solids(read[-1])), product(translation(*at), turn(tuple(axis), angle)))

    read = []
    add(yaml.safe_load((folder / "AeroAssembly.assy").read_text())["links"])
    return parts


def by_boolean(parts, one: str, other: str) -> tuple[float, float]:
    """Return the volume in common by OpenCASCADE, and its thickness."""
    shape = BRepAlgoAPI_Common(placed(*parts[one]), placed(*parts[other])).Shape()
    thickness = 0.0
    for solid in solids(shape):
        around = Bnd_OBB()
        BRepBndLib.AddOBB_s(solid, around, False, True, False)
        thickness = max(thickness, 2 * min(around.XHSize(), around.YHSize(), around.ZHSize()))
    return volume(shape), thickness


def main() -> None:
    folder = Path(sys.argv[2])
    print("the STEP file, in which the parts of the third pair were placed to touch:")
    show_pairs(asked("check", folder / "AeroAssembly.step"))
    parts = described(folder / "AeroAssembly_assy_example")
    with tempfile.TemporaryDirectory() as place:
        result = asked("check", written(parts, place, "assembly.step"))
    found = {frozenset(map(leaf, (pair["a"], pair["b"]))): pair for pair in result["pairs"]}
    tolerance = result["tolerance"]
    print(f"by its description, tolerance {tolerance:.3g}:")
    show_pairs(result)
    for names in map(frozenset, combinations(parts, 2)):
        pair = found.get(names, {"state": "apart"})
        shared, thickness = by_boolean(parts, *names)
        if pair["state"] != "clash" and shared == 0 and names not in REPORTED:
            continue
        is_right = pair["state"] == "touching" and thickness <= tolerance
        if pair["state"] == "clash":
            stated = REPORTED.get(names, shared)
            is_right = pair["volume"]["lower"] - LAST_DIGIT <= stated <= pair["volume"]["upper"] + LAST_DIGIT
        words = f"{pair['state']} {interval(pair.get('volume'))}, reported {REPORTED.get(names, 'nothing')}"
        boolean = f"by a boolean {shared:.6g}, {thickness:.3g} thick"
        print(f"  {' and '.join(sorted(names))}: {words}, {boolean}: {'right' if is_right else 'WRONG'}")


if __name__ == "__main__":
    main()
