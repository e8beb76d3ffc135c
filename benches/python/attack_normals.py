"""Parts with like normals, of random sheets with fins, beside dense samples.

    python attack_normals.py COMMAND PAIRS SEED

A is a bent square, B up to three bent plates about the plane below it, and up to two fins across it. For each, `score`
states the part of the area of A that has a like counterpart in B, and that of B in A: within a random threshold, with
normals that form at most 30 degrees. Points of the one, drawn by area, are compared with a grid of points of the other.
What the spacing of the grid may change is added to the threshold and to the angle, and four and a half standard
deviations of the share. Prints each pair whose interval does not meet the share, and their number.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

#: The largest angle of like normals, in degrees, and what two grid points' normals differ by at most, in radians.
ANGLE, ANGLE_STEP = 30.0, 0.01
#: The points of the one, and the grid of the other along each side.
POINTS, GRID = 1500, 300
#: The standard deviations by which a share may be off, and the width of the interval.
DEVIATIONS, WIDTH = 4.5, 1e-3
#: The seconds of a pair.
SECONDS = 120


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("pairs", type=int)
    parser.add_argument("seed", type=int)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    off = 0
    with tempfile.TemporaryDirectory() as folder:
        for pair in range(arguments.pairs):
            threshold = float(rng.uniform(0.05, 0.4))
            a, b = sheets(rng, threshold)
            paths = [write(Path(folder, name), patches) for name, patches in [("a.json", a), ("b.json", b)]]
            stated = score(arguments.command, paths, threshold)
            for key, one, other in [("normalPrecision", a, b), ("normalRecall", b, a)]:
                least, most = share(rng, one, other, threshold)
                slack = DEVIATIONS * np.sqrt(max(least * (1 - least), most * (1 - most), 1e-4) / POINTS) + WIDTH
                interval = stated[key]
                if most + slack < interval["lower"] or least - slack > interval["upper"]:
                    off += 1
                    print(f"pair {pair}: {key} {interval}, sampled {least:.4f} to {most:.4f}", flush=True)
    print(f"{arguments.pairs} pairs, {off} intervals off")


def sheets(rng, threshold: float):
    """Return the corners of the patches of A and of B, each in the order of its control points."""
    square = np.array([[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]], dtype=float)
    square[:, 2] = rng.uniform(0, 1.2) * threshold + rng.uniform(-0.35, 0.35, 4) * rng.uniform(0.1, 1)
    cuts = np.linspace(-0.5, 1.5, rng.integers(1, 4) + 1)
    below = []
    for low, high in zip(cuts[:-1], cuts[1:], strict=True):
        plate = np.array([[low, -0.5, 0], [low, 1.5, 0], [high, -0.5, 0], [high, 1.5, 0]])
        plate[:, 2] += rng.normal(0, 0.05, 4)
        # The first one always, so that B is not empty.
        if not below or rng.random() < 0.85:
            below.append(plate)
    for _ in range(rng.integers(0, 3)):
        middle, along = rng.uniform(-0.2, 1.2, 2), rng.normal(size=2)
        along *= rng.uniform(0.1, 1) / np.linalg.norm(along)
        lean, bottom = rng.normal(0, 0.2, 2), rng.uniform(-0.3, 0.5)
        ends = [[middle + sign * along, middle + sign * along + lean] for sign in (-1, 1)]
        corners = [[*foot, bottom] if low else [*foot, bottom + rng.uniform(0.1, 0.8)]
                   for end in ends for low, foot in [(True, end[0]), (False, end[1])]]
        below.append(np.array(corners))
    return [square], below


def write(path: Path, patches) -> Path:
    knots = [0, 0, 1, 1]

    def surface(corners):
        rows = [[[*map(float, corners[2 * row + column]), 1.0] for column in range(2)] for row in range(2)]
        return {"degree": [1, 1], "knots_u": knots, "knots_v": knots, "ctrl": rows}

    path.write_text(json.dumps({"surfaces": [surface(corners) for corners in patches]}), encoding="utf-8")
    return path


def score(command: str, paths, threshold: float):
    options = ["--threshold", repr(threshold), "--normal-angle", str(ANGLE), "--part-tolerance", str(WIDTH)]
    answer = subprocess.run([command, "score", *map(str, paths), "--json", *options],
                            capture_output=True, text=True, check=False, timeout=SECONDS)
    return json.loads(answer.stdout)["thresholds"][0]


def at(corners, s, t):
    """Return points of a patch and their normals, whose lengths are the densities of its area."""
    s, t = s[:, None], t[:, None]
    points = (1 - s) * (1 - t) * corners[0] + (1 - s) * t * corners[1] + s * (1 - t) * corners[2] + s * t * corners[3]
    along_s = (1 - t) * (corners[2] - corners[0]) + t * (corners[3] - corners[1])
    along_t = (1 - s) * (corners[1] - corners[0]) + s * (corners[3] - corners[2])
    return points, np.cross(along_s, along_t)


def share(rng, one, other, threshold: float):
    """Return the shares of the area of the one that certainly have, and that may have, like counterparts."""
    line = np.linspace(0, 1, GRID)
    s, t = (grid.ravel() for grid in np.meshgrid(line, line))
    grids = [at(corners, s, t) for corners in other]
    points = np.vstack([grid for grid, _ in grids])
    normals = np.vstack([normal / np.linalg.norm(normal, axis=1, keepdims=True) for _, normal in grids])
    tree = cKDTree(points)
    edges = [np.linalg.norm(corners[i] - corners[j]) for corners in other for i, j in [(0, 1), (0, 2), (1, 3), (2, 3)]]
    # No point of a patch is farther from the grid.
    spacing = 0.75 * max(edges) / (GRID - 1)
    least_cosine, cosine = (np.cos(np.radians(ANGLE) + sign * ANGLE_STEP) for sign in (-1, 1))
    like = unlike = area = 0.0
    for corners in one:
        for point, normal in zip(*at(corners, rng.random(POINTS), rng.random(POINTS)), strict=True):
            density = np.linalg.norm(normal)
            area += density
            near = np.array(tree.query_ball_point(point, threshold + spacing), dtype=int)
            cosines = np.abs(normals[near] @ normal) / density
            distances = np.linalg.norm(points[near] - point, axis=1)
            like += density * bool(np.any((distances <= threshold) & (cosines >= least_cosine)))
            unlike += density * (not np.any(cosines >= cosine))
    return like / area, 1 - unlike / area


if __name__ == "__main__":
    main()
