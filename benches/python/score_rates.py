"""Rates of scores beside samples and booleans.

    python score_rates.py COMMAND FOLDER [--pairs COUNT] [--jobs N]

FOLDER holds pairs of STEP files, NAME_a.step for the truth and NAME_b.step for the candidate. The
command scores them in one batch. Beside it, each pair is tessellated by OpenCASCADE to a thousandth
of the truth's diagonal, 8,192 points are drawn on each by trimesh, and the sums of mean distances and
of mean squares to the nearest samples are computed, as papers do; and OpenCASCADE's boolean
operations make the volume in common. Prints CPU seconds, what failed, and by how much the others miss
the certified intervals. It needs cadquery-ocp, numpy, scipy and trimesh.
"""

import argparse
import json
import resource
import statistics
import subprocess
import time
from pathlib import Path

#: Samples of a surface: those of CAD-Recode.
SAMPLES = 8192
#: The chord of OpenCASCADE's triangles, as a part of the diagonal, and their angle.
DEFLECTION = (1e-3, 0.2)
NUMBERS = ("precision", "recall", "normalPrecision", "normalRecall", "edgePrecision", "edgeRecall")
#: The width that is asked for.
WIDTH = 1e-3


def names(folder, most):
    found = sorted(path.name[:-7] for path in folder.glob("*_a.step"))
    return [name for name in found if (folder / f"{name}_b.step").exists()][:most]


def scored(command, folder, pairs, jobs):
    """Score all pairs in one batch; return the answers, seconds by the clock, and CPU seconds."""
    request, output = folder / "pairs.jsonl", folder / "answers.jsonl"
    line = {"command": "score", "maxSeconds": 60}
    files = ({"a": str(folder / f"{one}_b.step"), "b": str(folder / f"{one}_a.step")} for one in pairs)
    lines = (json.dumps({"id": one, **of, **line}) for one, of in zip(pairs, files))
    request.write_text("\n".join(lines) + "\n")
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    run = [command, "batch", str(request), "--output", str(output), "--overwrite", "--jobs", str(jobs)]
    subprocess.run(run, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    answers = [json.loads(text) for text in output.read_text().splitlines()]
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {answer["id"]: answer for answer in answers}, time.monotonic() - begun, cpu


def width(interval):
    return interval["upper"] - interval["lower"]


def report(answers, clock, cpu):
    """Print rates, and for each number how many intervals are as narrow as asked for."""
    good = [answer for answer in answers.values() if "error" not in answer]
    print(f"{len(answers)} pairs: {clock:.0f} s by the clock, {cpu:.0f} CPU s, {cpu / len(answers):.2f} each")
    seconds = sorted(answer["seconds"]["solve"] for answer in good)
    print(f"seconds each: median {statistics.median(seconds):.2f}, largest {seconds[-1]:.1f}")
    print(f"{len(answers) - len(good)} errors, {sum(answer['converged'] for answer in good)} converged")
    widths = {}
    for answer in good:
        diagonal, at = answer["diagonal"], answer["thresholds"][0]
        widths.setdefault("chamfer", []).append(width(answer["chamfer"]) / diagonal)
        widths.setdefault("hausdorff", []).append(width(answer["hausdorff"]["distance"]) / diagonal)
        for name in NUMBERS:
            if name in at:
                widths.setdefault(name, []).append(width(at[name]))
        if answer.get("iou"):
            widths.setdefault("iou", []).append(width(answer["iou"]))
    for name, of in widths.items():
        of.sort()
        # The sum of two means of the width has twice that, and a ratio of volumes about as much.
        permitted = {"chamfer": 2 * WIDTH, "iou": 2.2 * WIDTH}.get(name, 1.01 * WIDTH)
        narrow = sum(one <= permitted for one in of)
        print(f"{name:16} {narrow} of {len(of)} narrow, median {statistics.median(of):.2g}, largest {of[-1]:.2g}")


def shape(path):
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    return reader.OneShape()


def mesh(shape, diagonal):
    """Return the triangles of a shape as a mesh of trimesh."""
    import numpy as np
    import trimesh
    from OCP.BRep import BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    chord, angle = DEFLECTION
    BRepMesh_IncrementalMesh(shape, chord * diagonal, False, angle, False)
    points, triangles, found = [], [], TopExp_Explorer(shape, TopAbs_FACE)
    while found.More():
        place = TopLoc_Location()
        of = BRep_Tool.Triangulation_s(TopoDS.Face_s(found.Current()), place)
        found.Next()
        if of is None:
            continue
        moved = (of.Node(k + 1).Transformed(place.Transformation()) for k in range(of.NbNodes()))
        base = len(points)
        points.extend((at.X(), at.Y(), at.Z()) for at in moved)
        triangles.extend([base + k - 1 for k in of.Triangle(t + 1).Get()] for t in range(of.NbTriangles()))
    return trimesh.Trimesh(np.array(points), np.array(triangles), process=False)


def sampled(shapes, diagonal, seed):
    """Return the sums of both mean distances and of both mean squares, as programs compute them."""
    import numpy as np
    import trimesh
    from scipy.spatial import KDTree

    one, other = (
        trimesh.sample.sample_surface(mesh(of, diagonal), SAMPLES, seed=seed + k)[0]
        for k, of in enumerate(shapes)
    )
    there, back = KDTree(other).query(one)[0], KDTree(one).query(other)[0]
    return there.mean() + back.mean(), np.square(there).mean() + np.square(back).mean()


def ratio(shapes):
    """Return the volume of the intersection over that of the union, by boolean operations."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    def volume(of):
        found = GProp_GProps()
        BRepGProp.VolumeProperties_s(of, found)
        return found.Mass()

    common = BRepAlgoAPI_Common(*shapes)
    if not common.IsDone():
        raise ValueError("the boolean operation failed")
    one, other, both = volume(shapes[0]), volume(shapes[1]), volume(common.Shape())
    return both / (one + other - both)


def timed(compute):
    begun = time.process_time()
    try:
        return compute(), time.process_time() - begun
    except (ArithmeticError, RuntimeError, ValueError) as error:
        return error, time.process_time() - begun


def beside(folder, answers):
    """Compute samples and booleans of the pairs, and print by how much they miss our intervals."""
    seconds = {"samples": [], "booleans": []}
    missed, wrong, failed, noise = [], [], 0, []
    for name, answer in answers.items():
        if "error" in answer:
            continue
        diagonal = answer["diagonal"]
        shapes = [shape(folder / f"{name}_{which}.step") for which in "ba"]
        found, spent = timed(lambda: sampled(shapes, diagonal, 0))
        seconds["samples"].append(spent)
        if not isinstance(found, Exception):
            ours = answer["chamfer"]
            missed.append((found[0] - ours["upper"]) / diagonal)
            again = sampled(shapes, diagonal, 100)
            noise.append(abs(again[0] - found[0]) / diagonal)
        found, spent = timed(lambda: ratio(shapes))
        seconds["booleans"].append(spent)
        ours = answer.get("iou")
        if isinstance(found, Exception):
            failed += 1
        elif ours and not ours["lower"] - 1e-6 <= found <= ours["upper"] + 1e-6:
            wrong.append((name, found, ours["lower"], ours["upper"]))
    for name, of in seconds.items():
        print(f"{name}: {sum(of) / len(of):.2f} CPU s a pair, largest {max(of):.1f}")
    missed.sort()
    print(
        f"sum of mean distances to nearest samples beyond our upper end, of the diagonal:"
        f" least {missed[0]:.2g}, median {statistics.median(missed):.2g}, largest {missed[-1]:.2g};"
        f" between two seeds up to {max(noise):.2g}"
    )
    print(f"booleans: {failed} failed, {len(wrong)} outside our intervals")
    for one in wrong:
        print("  {}: {:.6f}, ours {:.6f} to {:.6f}".format(*one))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command", help="the program nurbs-hausdorff")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--alone", action="store_true", help="without samples and booleans")
    arguments = parser.parse_args()
    pairs = names(arguments.folder, arguments.pairs)
    answers, clock, cpu = scored(arguments.command, arguments.folder, pairs, arguments.jobs)
    report(answers, clock, cpu)
    if not arguments.alone:
        beside(arguments.folder, answers)


if __name__ == "__main__":
    main()
