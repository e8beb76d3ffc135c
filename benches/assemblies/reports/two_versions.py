"""Two versions of one part, and a scan against its CAD: FreeCAD#12534, with the edits of build123d-mcp#312.

FreeCAD#12534 asks where two bodies differ, how much material was added and removed, and how a scan deviates from the
CAD. build123d-mcp#312 names edits that leave volume and box as they were, or nearly: two holes 30 apart instead of 20, a
hexagonal boss lower by 1, chamfers of 3 that become fillets of 3.
"""

import math
import tempfile
from pathlib import Path
from random import Random

from common import asked, interval, placed, volume, written
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer, BRepFilletAPI_MakeFillet
from OCP.gp import gp_Trsf
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from parts import box, cut, cylinder, fuse, is_along_z, one_solid, prism
from placement import translation

X, Y, Z = 80.0, 50.0, 10.0
POINTS = 20_000
BUMP = 0.15


def plate(holes: float = 20.0, boss: float = 6.0, edges=BRepFilletAPI_MakeChamfer):
    """A plate with rounded or bevelled corners, a hexagonal boss, and two holes at a distance."""
    solid = box(X, Y, Z)
    maker, corners = edges(solid), TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_EDGE)
    seen = []
    while corners.More():
        edge = TopoDS.Edge(corners.Current())
        if is_along_z(edge) and not any(edge.IsSame(other) for other in seen):
            maker.Add(3.0, edge)
            seen.append(edge)
        corners.Next()
    hexagon = [(6 * math.cos(k * math.pi / 3), 6 * math.sin(k * math.pi / 3)) for k in range(6)]
    raised = fuse(one_solid(maker.Shape()), placed(prism(hexagon, boss), translation(60, 25, Z)))
    return cut(raised, *(cylinder(2.5, Z, (30 + side * holes / 2, 25, 0)) for side in (-1, 1)))


def scan(rng: Random) -> list[tuple[float, float, float]]:
    """Return points of the plate's top left of the holes, with a bump of a known height, 0 at its rim."""
    points = [(5 + rng.uniform(0, 10), 5 + rng.uniform(0, 40), Z) for _ in range(POINTS)]
    raised = [(x, y, Z + BUMP * max(0.0, 1 - math.hypot(x - 10, y - 20) / 4) ** 2) for x, y, _ in points]
    return [*raised, (10.0, 20.0, Z + BUMP)]


def removed(one, other) -> float:
    """Return the volume that is in one only, by OpenCASCADE."""
    return volume(BRepAlgoAPI_Cut(one, other).Shape())


def main() -> None:
    before = plate()
    versions = [
        ("unchanged", plate(), 0.0),
        # Each hole moves by 5, and the middle of its old wall is half the thickness from the planes as well.
        ("holes 30 apart for 20", plate(holes=30.0), 5.0),
        ("boss lower by 1", plate(boss=5.0), 1.0),
        # The arc of radius 3 is as far from its centre, the chord 3 √½.
        ("fillets for chamfers", plate(edges=BRepFilletAPI_MakeFillet), 3 * (1 - math.sqrt(0.5))),
    ]
    for label, after, expected in versions:
        with tempfile.TemporaryDirectory() as folder:
            files = [
                written({"plate": (shape, gp_Trsf())}, folder, name)
                for name, shape in (("a.step", before), ("b.step", after))
            ]
            part = asked("diff", *files, "--limit", "1e-3")["parts"][0]
            volumes = asked("overlap", *files)["volumes"]
        print(f"{label}: volume {volume(before):.2f} -> {volume(after):.2f}, expected {expected:.6g}")
        faces = part["faces"]
        print(f"  {part['state']} {interval(part)}, faces {len(faces['ofA'])} of A, {len(faces['ofB'])} of B")
        for name, true in (("onlyA", removed(before, after)), ("onlyB", removed(after, before))):
            print(f"  {name}: {interval(volumes[name])}, by a boolean {true:.6g}")
    with tempfile.TemporaryDirectory() as folder:
        cad = written({"plate": (before, gp_Trsf())}, folder, "a.step")
        cloud = Path(folder, "scan.xyz")
        cloud.write_text("".join(f"{x:.9f} {y:.9f} {z:.9f}\n" for x, y, z in scan(Random(1))))
        found = asked("distance", cloud, cad)
        verdicts = {limit: asked("distance", cloud, cad, "--limit", limit)["verdict"] for limit in ("0.1", "0.2")}
    print(f"a scan with a bump of {BUMP}: {interval(found)} at {found['witness']['a']['point']}, within {verdicts}")


if __name__ == "__main__":
    main()
