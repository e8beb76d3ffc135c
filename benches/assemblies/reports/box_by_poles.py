"""A box by poles or meshes instead of the shape: CadQuery#798, 149 mm for 145.

A grid of boxes with an extent of 145 x 145 x 10 has its box 2 larger on each side there; a sphere, a ring and a spline
show what poles add. `info` states extents as intervals, and `check` decides by surfaces.
"""

import tempfile

from common import asked, checked, placed, show_pairs, written
from OCP.Bnd import Bnd_Box
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_NurbsConvert
from OCP.gp import gp_Trsf
from parts import ball, box, ring
from placement import product, translation, turn


def box_of(shape) -> list[float]:
    """Return the extents of the box that OpenCASCADE gives without a mesh."""
    found = Bnd_Box()
    BRepBndLib.Add_s(shape, found, False)
    low, high = found.CornerMin(), found.CornerMax()
    return [round(high.Coord(k) - low.Coord(k), 4) for k in (1, 2, 3)]


def main() -> None:
    grid = {
        f"cube {x} {y}": (box(10, 10, 10), translation(15 * x, 15 * y, 0)) for x in range(10) for y in range(10)
    }
    spun = BRepBuilderAPI_NurbsConvert(ball(10), True).Shape()
    torus = BRepBuilderAPI_NurbsConvert(ring(10, 3), True).Shape()
    tilt = product(turn((1, 0, 0), 35), turn((0, 0, 1), 25))
    cases = [
        ("a grid, 145 x 145 x 10", grid),
        ("a sphere of radius 10 as NURBS, turned, 20 x 20 x 20", {"ball": (spun, tilt)}),
        ("a torus of 10 and 3 as NURBS, turned", {"ring": (torus, tilt)}),
    ]
    for label, parts in cases:
        with tempfile.TemporaryDirectory() as folder:
            extents = asked("info", written(parts, folder, "box.step"))["facts"]["extents"]
        ours = [f"[{e['lower']:.6f}, {e['upper']:.6f}]" for e in extents]
        boxes = [box_of(placed(*part)) for part in parts.values()][:1]
        print(f"{label}: {' '.join(ours)}; OpenCASCADE, of the first body {boxes}")
    # Boxes of poles overlap by 2.9, the balls are 0.1 apart.
    balls = {"one": (spun, tilt), "other": (spun, translation(20.1, 0, 0))}
    show_pairs(checked(balls, "--below", "0.5"))


if __name__ == "__main__":
    main()
