"""Picture of where a part differs between its STEP and its STL.

    python benches/points/so101.py PART.step PART.stl OUT.jpg

Needs the package and matplotlib.
"""

import sys

import matplotlib as mpl
import nurbs_hausdorff as nh
import numpy as np

mpl.use("Agg")
import matplotlib.pyplot as plt


def main() -> None:
    step, stl, out = sys.argv[1:]
    model, mesh = nh.read(step), nh.read(stl)
    found = nh.distance(model, mesh, relative_tolerance=1e-6, scale_units=True)
    field = nh.field(model, mesh, samples=16, upper=found.upper)
    points, values = field.flat("points"), field.flat("distances")
    order = np.argsort(values)
    worst = np.asarray(found.witness.a.point)
    figure, axes = plt.subplots(1, 3, figsize=(11, 4), layout="constrained")
    for axis, (x, y) in zip(axes, [(0, 1), (0, 2), (1, 2)], strict=True):
        drawn = axis.scatter(
            points[order, x], points[order, y], c=values[order], s=2, cmap="viridis"
        )
        axis.plot(worst[x], worst[y], "o", mfc="none", mec="red", ms=14, mew=1.5)
        axis.set_aspect("equal")
        axis.set(xlabel="xyz"[x], ylabel="xyz"[y])
    figure.colorbar(drawn, ax=axes, label="distance from the STL, mm")
    figure.suptitle(f"farthest point, ringed: between {found.lower:.6f} and {found.upper:.6f} mm")
    figure.savefig(out, dpi=90, pil_kwargs={"quality": 80})
    print(len(points), found.lower, found.upper, values.max(), worst)


if __name__ == "__main__":
    main()
