"""Scores of 200 generated parts against edits of known size.

    python edits.py COMMAND FOLDER [--plot FILE]

It needs cadquery and, for the plot, matplotlib. 40 plates with a boss and a bore are made by random
numbers of a fixed seed, and each is edited in one way by five sizes, from 0.6 to 10 % of its
diagonal: 200 candidates, that the command scores in one batch. The edits are deeper extrusions,
bores that move, bosses that grow, bosses that turn, and cubes beside the part. For each part every
number has to get worse with the size, or stay: no interval of a larger edit may lie wholly on the
better side of that of a smaller one. Prints the pairs of neighbours that are certainly in order,
that overlap, and that are certainly against it.
"""

import argparse
import json
import math
import random
import subprocess
import sys
from pathlib import Path

import cadquery as cq

SEED = 20261127
PARTS = 40
#: Sizes of edits, as parts of the diagonal: none, nor its half, is the threshold of 0.01 itself, at
#: which faces are undecided.
SIZES = (0.006, 0.012, 0.025, 0.05, 0.1)
EDITS = ("deeper", "bore moved", "boss larger", "boss turned", "more material")
#: Numbers that rise with the quality, and those that fall.
RISING = ("f1", "normalF1", "edgeF1", "iou", "volume ratio")
FALLING = ("chamfer", "chamferSquared", "hausdorff")


def part(dimensions, edit=None, size=0.0):
    """Return a plate with a rectangular boss and a bore, edited by a length."""
    x, y, z = dimensions["plate"]
    deep = z + (size if edit == "deeper" else 0.0)
    body = cq.Workplane().box(x, y, deep, centered=(True, True, False)).translate((0, 0, z - deep))
    width, depth, height = dimensions["boss"]
    if edit == "boss larger":
        width, depth = width + size, depth + size
    # The corners of the turned boss move by about the size.
    turn = math.degrees(2 * size / math.hypot(width, depth)) if edit == "boss turned" else 0.0
    boss = cq.Workplane().box(width, depth, height, centered=(True, True, False))
    boss = boss.rotate((0, 0, 0), (0, 0, 1), turn)
    body = body.union(boss.translate((-x / 4, 0, z)))
    at = x / 4 + (size if edit == "bore moved" else 0.0)
    bore = cq.Workplane().circle(dimensions["radius"]).extrude(3 * (z + deep))
    body = body.cut(bore.translate((at, 0, -z - deep)))
    if edit == "more material":
        beside = cq.Workplane().box(size, size, size).translate((0, 0.6 * y + size / 2, z / 2))
        body = cq.Workplane(cq.Compound.makeCompound([body.val(), beside.val()]))
    return body


def made(folder):
    """Write the files of all parts and edits, and yield a line for each pair."""
    numbers = random.Random(SEED)
    for index in range(PARTS):
        x = numbers.uniform(60, 120)
        plate = (x, numbers.uniform(0.5, 0.8) * x, numbers.uniform(0.1, 0.3) * x)
        ranges = ((0.1, 0.2), (0.2, 0.3), (0.1, 0.3))
        boss = tuple(numbers.uniform(low, high) * x for low, high in ranges)
        dimensions = {"plate": plate, "boss": boss, "radius": numbers.uniform(0.05, 0.1) * x}
        truth = folder / f"{index}.step"
        solid = part(dimensions)
        cq.exporters.export(solid, str(truth))
        diagonal = solid.val().BoundingBox().DiagonalLength
        edit = EDITS[index % len(EDITS)]
        for size in SIZES:
            candidate = folder / f"{index}-{size}.step"
            cq.exporters.export(part(dimensions, edit, size * diagonal), str(candidate))
            files = {"a": str(candidate), "b": str(truth)}
            yield {"id": [index, edit, size], "command": "score", **files, "maxSeconds": 60}


def number(answer, name):
    """Return the interval of a number, lengths as parts of the diagonal; None if it is missing."""
    at, diagonal = answer["thresholds"][0], answer["diagonal"]
    if name == "volume ratio":
        found, unit = answer.get("volume", {}).get("ratio"), 1.0
    elif name == "hausdorff":
        found, unit = answer["hausdorff"]["distance"], diagonal
    elif name in ("chamfer", "chamferSquared"):
        found, unit = answer[name], diagonal if name == "chamfer" else diagonal**2
    else:
        found, unit = at.get(name, answer.get(name)), 1.0
    return found and (found["lower"] / unit, found["upper"] / unit)


def order(answers, name):
    """Count neighbouring sizes of a part certainly in order, overlapping, and not in order."""
    counts = [0, 0, 0]
    for index in range(PARTS):
        of_part = [number(answers[index, size], name) for size in SIZES]
        for smaller, larger in zip(of_part, of_part[1:]):
            if smaller is None or larger is None:
                continue
            if name in RISING:
                smaller, larger = larger, smaller
            if smaller[1] < larger[0]:
                counts[0] += 1
            elif smaller[0] > larger[1]:
                counts[2] += 1
            else:
                counts[1] += 1
    return counts


def plot(answers, target):
    """Draw the means over the parts of each edit by the size."""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "edits"
    matplotlib.rcParams["svg.fonttype"] = "none"
    from matplotlib import pyplot

    names = (*RISING[:4], "chamfer", "hausdorff")
    figure, axes = pyplot.subplots(2, 3, figsize=(9, 5), sharex=True)
    for axis, name in zip(axes.flat, names):
        for position, edit in enumerate(EDITS):
            parts = range(position, PARTS, len(EDITS))
            means = []
            for size in SIZES:
                found = [number(answers[index, size], name) for index in parts]
                found = [one for one in found if one is not None]
                mean = [sum(end) / len(found) for end in zip(*found)]
                means.append(mean or [math.nan] * 2)
            lower, upper = zip(*means)
            percent = [100 * size for size in SIZES]
            line = axis.plot(percent, upper, marker="o", markersize=3, linewidth=1, label=edit)[0]
            axis.fill_between(percent, lower, upper, alpha=0.3, color=line.get_color(), linewidth=0)
        axis.set_title(name, fontsize=9)
        axis.set_xscale("log")
        axis.set_xticks(percent, [f"{one:g}" for one in percent], fontsize=7)
        axis.minorticks_off()
        axis.tick_params(axis="y", labelsize=7)
    for axis in axes[1]:
        axis.set_xlabel("size of the edit, % of the diagonal", fontsize=7)
    axes[0, 0].legend(fontsize=6, loc="lower left")
    figure.tight_layout()
    figure.savefig(target, metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command", help="the program nurbs-hausdorff")
    parser.add_argument("folder", type=Path, help="for the files")
    parser.add_argument("--plot", help="an SVG file to write")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    pairs, output = arguments.folder / "pairs.jsonl", arguments.folder / "answers.jsonl"
    if not pairs.exists():
        pairs.write_text("".join(json.dumps(line) + "\n" for line in made(arguments.folder)))
    subprocess.run([arguments.command, "batch", str(pairs), "--output", str(output)], check=True)
    answers, seconds = {}, []
    for line in output.read_text().splitlines():
        answer = json.loads(line)
        if "error" in answer:
            sys.exit(f"{answer['id']}: {answer['error']}")
        index, _, size = answer["id"]
        answers[index, size] = answer
        seconds.append(answer["seconds"]["prepare"] + answer["seconds"]["solve"])
    print(f"{len(answers)} scores, {sum(seconds):.1f} s, {max(seconds):.2f} s at most")
    for name in (*RISING, *FALLING):
        certain, overlapping, against = order(answers, name)
        print(f"{name:15} {certain} in order, {overlapping} overlap, {against} against it")
    if arguments.plot:
        plot(answers, arguments.plot)


if __name__ == "__main__":
    main()
