"""The package's own shapes, of several surfaces each, written by its example `shapes`."""

import subprocess

from nurbs import load
from pairs import Pair
from places import REPOSITORY, WORK

PAIRS = [
    ("wigley-hulls", "a Wigley hull to a wider one", "wigley-hull", "wigley-hull-wider"),
    ("naca-wings", "a wing of NACA 2412 to one of NACA 2415", "naca-wing", "naca-wing-thicker"),
    ("glass-bottle", "a glass to a bottle", "glass", "bottle"),
]


def pairs():
    """Pairs of shapes by name."""
    folder = WORK / "shapes"
    command = ["cargo", "run", "--release", "--quiet", "--example", "shapes", "--", str(folder)]
    subprocess.run(command, cwd=REPOSITORY, check=True)
    for name, what, a, b in PAIRS:
        yield Pair(name, what, load(folder / f"{a}.json"), load(folder / f"{b}.json"))
