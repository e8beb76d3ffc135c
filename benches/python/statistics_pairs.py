"""Statistics of the distances of balls, whose values are known by formula, and of given models.

    python statistics_pairs.py COMMAND FOLDER [A B [X,Y,Z]]…

For each pair prints the number of parts, the widths of the mean, of the root mean square and of the percentiles in
units of the tolerance, whether the search converged, and CPU seconds with reading. Of balls it says whether each
interval holds the value by formula. X,Y,Z moves A. It needs cadquery.
"""

import argparse
import json
import math
import resource
import subprocess
from pathlib import Path

import cadquery as cq

#: The radius of the first ball, and of each other one its radius and the distance of its centre.
RADIUS, OTHERS = 2.0, ((2.1, 0.0), (2.0, 0.55), (1.0, 3.0), (1.0, 0.5))
#: The intervals of the rule of middles by which formulas are integrated.
STEPS = 400_000


def by_formula(radius, distance):
    """Return the mean, the root mean square and the percentiles of the distances of the first sphere from another one.

    The height of a point of a sphere along a diameter is spread evenly.
    """
    heights = (2 * (k + 0.5) / STEPS - 1 for k in range(STEPS))
    far = RADIUS**2 + distance**2
    found = sorted(abs(math.sqrt(far - 2 * RADIUS * distance * h) - radius) for h in heights)
    percentiles = [found[int(part * STEPS)] for part in (0.5, 0.95, 0.99)]
    return [sum(found) / STEPS, math.sqrt(sum(d * d for d in found) / STEPS), *percentiles]


def measured(command, files, moved):
    """Return the command's answer and its CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    arguments = [command, "statistics", *map(str, files), "--translate", moved, "--json"]
    answer = json.loads(subprocess.run(arguments, capture_output=True, text=True, check=True).stdout)
    return answer, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def line(name, answer, seconds, expected=None):
    """Print what is known of a pair."""
    intervals = [answer["mean"], answer["rms"], *(of["distance"] for of in answer["percentiles"])]
    widths = ", ".join(f"{(of['upper'] - of['lower']) / answer['tolerance']:.2f}" for of in intervals)
    # The rule has an error of about a step.
    slack = 4 * RADIUS / STEPS
    holds = expected is None or all(
        of["lower"] - slack <= value <= of["upper"] + slack for of, value in zip(intervals, expected, strict=True)
    )
    ended = "converged" if answer["converged"] else "not converged"
    print(
        f"{name}: {answer['cells']} parts, {widths}, {ended}, {seconds:.1f} CPU s",
        "" if holds else f"WRONG: {expected}",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("folder", type=Path)
    parser.add_argument("models", nargs="*")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)

    def ball(radius, distance):
        file = arguments.folder / f"ball-{radius}-{distance}.step"
        cq.exporters.export(cq.Workplane(origin=(distance, 0, 0)).sphere(radius), str(file))
        return file

    first = ball(RADIUS, 0.0)
    for radius, distance in OTHERS:
        answer, seconds = measured(arguments.command, [first, ball(radius, distance)], "0,0,0")
        line(f"balls of {RADIUS} and {radius}, {distance} apart", answer, seconds, by_formula(radius, distance))
    models = list(arguments.models)
    while models:
        files, models = models[:2], models[2:]
        moved = models.pop(0) if models and models[0].count(",") == 2 else "0,0,0"
        answer, seconds = measured(arguments.command, files, moved)
        line(" to ".join(Path(file).name for file in files) + f", moved by {moved}", answer, seconds)


if __name__ == "__main__":
    main()
