"""What partcad#621 checks of an assembly, with the cases that it, partcad#629 and build123d-mcp#461 state.

Two cubes of 10 that overlap by 5 share 500 mm³, and two face to face nothing; a bracket around a shaft and an L around a
corner have boxes that meet and share nothing. A part whose faces look inward; one part placed twice; a part that is flat,
and a slab of 20 x 20 x 0.00001, which passes as a solid; a part that is handed back as its shell, of which a boolean has no
volume.
"""

import tempfile

from common import asked, interval, leaf, placed, show_pairs, volume, written
from check_files_peers import solids
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
from OCP.gp import gp_Dir, gp_Pln, gp_Pnt, gp_Trsf
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from parts import box, cut, cylinder, fuse
from placement import translation, turn


def shell_of(solid):
    return TopoDS.Shell(TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_SHELL).Current())


def reported(parts, label: str, expected: str) -> dict:
    """Print what `check` says of the two parts beside the volume of a boolean's solids, and return it."""
    with tempfile.TemporaryDirectory() as folder:
        result = asked("check", written(parts, folder, "assembly.step"), "--below", "2")
    boolean = BRepAlgoAPI_Common(*(placed(*part) for part in parts.values())).Shape()
    shared = sum(volume(solid) for solid in solids(boolean))
    print(f"{label}; expected {expected}; by a boolean {shared:.6g}")
    show_pairs(result)
    return result


def main() -> None:
    here = gp_Trsf()
    cube = box(10, 10, 10)
    reported({"a": (cube, here), "b": (cube, translation(5, 0, 0))}, "overlapping by 5", "clash of 500")
    reported({"a": (cube, here), "b": (cube, translation(10, 0, 0))}, "face to face", "touching")
    around = cut(box(20, 20, 8, (-10, -10, 0)), cylinder(5.2, 8))
    shaft = cylinder(5, 40, (0, 0, -16))
    reported({"bracket": (around, here), "shaft": (shaft, here)}, "a bracket around a shaft", "near, 0.2")
    corner = fuse(box(40, 10, 10), box(10, 40, 10))
    reported({"L": (corner, here), "block": (cube, translation(10.5, 10.5, 0))}, "an L around a corner", "near, 0.5")
    tilted = turn((0, 0, 1), 45)
    beams = {"one": (box(40, 4, 4), tilted), "other": (box(40, 4, 4), translation(8, 0, 0).Multiplied(tilted))}
    reported(beams, "two tilted beams whose boxes meet", "near, 8 sin 45° - 4 = 1.65685")
    bodies = reported({"a": (cube, here), "again": (cube, here)}, "placed twice", "clash of 1000, duplicates")["bodies"]
    print(f"  duplicates: {[[leaf(b['name']), b['duplicates']] for b in bodies]}")

    flat = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 0, 20, 0, 20).Face()
    singles = {
        "inward": (cube.Reversed(), "closed, insideOut"),
        "flat": (flat, "not closed"),
        "slab of 1e-5": (box(20, 20, 1e-5), "closed; degenerate if below the tolerance"),
        "shell": (shell_of(cube), "closed"),
    }
    for label, (shape, expected) in singles.items():
        with tempfile.TemporaryDirectory() as folder:
            file = written({"part": (shape, here)}, folder, "part.step")
            result = asked("check", file)
            body = result["bodies"][0]
            facts = asked("info", file)["bodies"][0]["facts"]
        ours = f"{body['kind']}, closed {body['closed']}, {body['orientation']}, degenerate {body['degenerate']}"
        extents = " x ".join(interval(extent) for extent in facts["extents"])
        print(f"{label}; expected {expected}; OpenCASCADE's volume {volume(shape):.6g}")
        print(f"  {ours}, volume {interval(facts.get('volume'))}, {extents}; tolerance {result['tolerance']:.3g}")
    other = shell_of(box(10, 10, 10, (5, 0, 0)))
    reported({"cube": (cube, here), "shell": (other, here)}, "a cube and a shell", "clash of 500")


if __name__ == "__main__":
    main()
