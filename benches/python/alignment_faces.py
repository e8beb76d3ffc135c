"""Fit scans of castings to parts, by all samples and by the faces that are true.

    python benches/python/alignment_faces.py POSES PART.step …

Of each part a random half of the faces, by area, is as it should be; the others lie 0.003 of the diagonal outside. A scan
has 4,000 points with a noise of 1e-4 of the diagonal, and 1,000 anywhere in a box half as large again, in a random pose.
Prints the root mean square of the movement from the true pose, relative to the diagonal, of the best pose listed, whether
the fit converged, its CPU seconds and the samples that counted: first with the share of outliers alone, then also with the
true faces and a largest distance of 0.002 of the diagonal.
"""

from __future__ import annotations

import sys
import time
from typing import Any

import nurbs_hausdorff as nh
import numpy as np
from numpy.typing import NDArray

POINTS, CLUTTER, NOISE, RAISED, MOST = 4000, 1000, 1e-4, 0.003, 0.002
Points = NDArray[np.float64]


class Part:
    """A part with its triangles."""

    def __init__(self, path: str) -> None:
        self.model = nh.read(path)
        mesh = self.model.tessellate()
        corners = np.asarray(mesh.vertices, float)[np.asarray(mesh.triangles)]
        self.start, self.sides = corners[:, 0], corners[:, 1:] - corners[:, :1]
        normals = np.cross(self.sides[:, 0], self.sides[:, 1])
        lengths = np.linalg.norm(normals, axis=1)
        self.area, self.normals = lengths / 2, normals / np.maximum(lengths, 1e-300)[:, None]
        self.faces = np.asarray(mesh.face_of_triangle)
        low, high = corners.min((0, 1)), corners.max((0, 1))
        self.middle, self.extent, self.diagonal = (low + high) / 2, high - low, float(np.linalg.norm(high - low))

    def true_faces(self, rng: np.random.Generator) -> list[int]:
        """Return a random half of the faces by area."""
        faces = rng.permutation(np.unique(self.faces))
        shares = np.cumsum([self.area[self.faces == face].sum() for face in faces]) / self.area.sum()
        return sorted(int(face) for face in faces[: int(np.searchsorted(shares, 0.5)) + 1])

    def scan(self, true: list[int], rng: np.random.Generator) -> Points:
        """Return points of the faces, those that are not true outside of them, and others anywhere."""
        chosen = rng.choice(len(self.area), POINTS, p=self.area / self.area.sum())
        parts = rng.random((POINTS, 2))
        parts[parts.sum(1) > 1] = 1 - parts[parts.sum(1) > 1]
        points = self.start[chosen] + np.einsum("ij,ijk->ik", parts, self.sides[chosen])
        raised = ~np.isin(self.faces[chosen], true)
        points += RAISED * self.diagonal * raised[:, None] * self.normals[chosen]
        points += rng.normal(0, NOISE * self.diagonal, points.shape)
        clutter = self.middle + 1.5 * (rng.random((CLUTTER, 3)) - 0.5) * self.extent
        return np.vstack([points, clutter])


def pose(rng: np.random.Generator, size: float) -> nh.Transform:
    """Return a random rotation with a shift of about a size."""
    turn = rng.normal(size=4)
    return nh.Transform(tuple(turn / np.linalg.norm(turn)), tuple(size * rng.normal(size=3)))


def moved(points: Points, motion: nh.Transform) -> Points:
    matrix = motion.matrix()
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def measured(part: Part, points: Points, scan: Points, options: dict[str, Any]) -> tuple[float, bool, float, int]:
    started = time.process_time()
    fit = nh.best_fit(scan, part.model, outliers=CLUTTER / (POINTS + CLUTTER), **options)
    spent = time.process_time() - started
    poses = [fit.transform, *(one.transform for one in fit.ambiguous)]
    off = [np.sqrt(((moved(scan, one) - points)[:POINTS] ** 2).sum(1).mean()) for one in poses]
    return float(min(off)) / part.diagonal, fit.converged, spent, fit.counted


def main() -> None:
    poses = int(sys.argv[1])
    for path in sys.argv[2:]:
        part, rng, rows = Part(path), np.random.default_rng(1), []
        for _ in range(poses):
            true = part.true_faces(rng)
            points = part.scan(true, rng)
            scan = moved(points, pose(rng, part.diagonal))
            chosen = {"faces_of_b": true, "max_distance": MOST * part.diagonal}
            rows.append([measured(part, points, scan, options) for options in ({}, chosen)])
        for name, found in zip(("all samples", "true faces"), zip(*rows, strict=True), strict=True):
            off, converged, spent, counted = (np.array(column, float) for column in zip(*found, strict=True))
            print(
                f"{path}, {name}: off {np.median(off):.1e}, at most {off.max():.1e}; {int(converged.sum())} of"
                f" {poses} converged; {np.median(spent):.1f} CPU s; {np.median(counted):.0f} counted",
                flush=True,
            )


if __name__ == "__main__":
    main()
