"""Statistics of random pairs of models, each of whose parts is audited.

    python audit_statistics.py COMMAND PAIRS SEED MODEL…

Draws two of the models, or one twice, moves A by up to half of its size and 40 degrees, and asks for statistics with
a random limit, a budget of 300 or 2,000 parts, and `audit: "all"`: certified distances of points of each part, and its
mean by a rule, are compared with what is stated of it. Prints the numbers of pairs, parts and points, and each pair of
which something is refuted.
"""

import argparse
import json
import math
import random
import subprocess
import tempfile
from pathlib import Path

#: The largest seconds of a pair.
SECONDS = 30
#: Lengths of motions, in sizes of A, and their angles in degrees.
SHIFTS, ANGLES = (0, 1e-6, 1e-3, 0.05, 0.5), (0, 0, 1e-3, 0.1, 3, 40)


def size_of(command, model):
    """Return the length of the diagonal of a model's box."""
    answer = subprocess.run([command, "info", model, "--json"], capture_output=True, text=True, check=True)
    return math.hypot(*(extent["upper"] for extent in json.loads(answer.stdout)["facts"]["extents"]))


def question(draw, models, sizes):
    """Return a line of a batch."""
    a = draw.choice(models)
    b = a if draw.random() < 0.5 else draw.choice(models)
    shift = draw.choice(SHIFTS) * sizes[a]
    half = math.radians(draw.choice(ANGLES) * draw.random()) / 2
    axis = [draw.gauss(0, 1) for _ in range(3)]
    rotation = [*(math.sin(half) * x / math.hypot(*axis) for x in axis), math.cos(half)]
    return {
        "id": 1,
        "command": "statistics",
        "a": a,
        "b": b,
        "audit": "all",
        "maxCells": draw.choice((300, 2000)),
        "limit": draw.random() * shift + 1e-9,
        "transform": {"rotation": rotation, "translation": [shift * draw.gauss(0, 1) for _ in range(3)]},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command")
    parser.add_argument("pairs", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("models", nargs="+")
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    sizes = {model: size_of(arguments.command, model) for model in arguments.models}
    late = parts = points = refuted = 0
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "pairs.jsonl"
        for _ in range(arguments.pairs):
            asked = question(draw, arguments.models, sizes)
            file.write_text(json.dumps(asked) + "\n", encoding="utf-8")
            run = [arguments.command, "batch", str(file)]
            try:
                printed = subprocess.run(run, capture_output=True, text=True, check=False, timeout=SECONDS).stdout
            except subprocess.TimeoutExpired:
                late += 1
                continue
            audit = json.loads(printed.splitlines()[-1])["audit"]
            parts, points = parts + audit["cells"], points + audit["points"]
            if audit["struck"]:
                refuted += 1
                print("REFUTED", json.dumps(asked), flush=True)
    print(f"{arguments.pairs} pairs, {late} late, {parts} parts, {points} points, {refuted} refuted")


if __name__ == "__main__":
    main()
