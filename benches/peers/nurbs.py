"""NURBS surfaces as arrays: the interchange JSON read and written, and evaluated with scipy."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import BSpline


@dataclass(frozen=True)
class Surface:
    """One surface. `points` is (n, m, 3), not multiplied by the weights, which are (n, m)."""

    degree: tuple[int, int]
    knots: tuple[np.ndarray, np.ndarray]
    points: np.ndarray
    weights: np.ndarray

    @property
    def domain(self):
        """((u0, u1), (v0, v1))."""
        return tuple((knots[p], knots[-p - 1]) for p, knots in zip(self.degree, self.knots, strict=True))

    @property
    def rational(self):
        """Whether any two weights differ."""
        return bool(np.ptp(self.weights) > 0)

    def moved(self, translation=(0, 0, 0), rotation=None):
        """Turned by a 3x3 matrix, then moved."""
        points = self.points if rotation is None else self.points @ np.asarray(rotation).T
        return Surface(self.degree, self.knots, points + np.asarray(translation, float), self.weights)

    def grid(self, u, v):
        """The points at all pairs of the parameters `u` and `v`: (len(u), len(v), 3)."""
        rows, columns = (
            BSpline.design_matrix(np.clip(t, *ends), knots, p).toarray()
            for t, ends, knots, p in zip((u, v), self.domain, self.knots, self.degree, strict=True)
        )
        homogeneous = np.concatenate([self.points * self.weights[..., None], self.weights[..., None]], axis=2)
        along_u = np.tensordot(rows, homogeneous, axes=(1, 0))
        values = np.tensordot(along_u, columns, axes=(1, 1)).transpose(0, 2, 1)
        return values[..., :3] / values[..., 3:]

    def samples(self, count):
        """`count` x `count` points, uniform in the parameters from end to end: (count^2, 3)."""
        u, v = (np.linspace(*ends, count) for ends in self.domain)
        return self.grid(u, v).reshape(-1, 3)


def load(path):
    """The surfaces of a model in the interchange JSON."""
    return [
        Surface(
            tuple(surface["degree"]),
            (np.array(surface["knots_u"], float), np.array(surface["knots_v"], float)),
            np.array(surface["ctrl"], float)[..., :3],
            np.array(surface["ctrl"], float)[..., 3],
        )
        for surface in json.loads(Path(path).read_text())["surfaces"]
    ]


def save(path, surfaces):
    """Writes a model as interchange JSON."""
    model = {
        "surfaces": [
            {
                "degree": list(surface.degree),
                "knots_u": surface.knots[0].tolist(),
                "knots_v": surface.knots[1].tolist(),
                "ctrl": np.concatenate([surface.points, surface.weights[..., None]], axis=2).tolist(),
            }
            for surface in surfaces
        ]
    }
    Path(path).write_text(json.dumps(model))


def diagonal(surfaces):
    """The diagonal of the box around all control points."""
    points = np.concatenate([surface.points.reshape(-1, 3) for surface in surfaces])
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def clamped_knots(degree, count):
    """Clamped knots over [0, 1], evenly spaced inside."""
    inside = np.linspace(0, 1, count - degree + 1)
    return np.concatenate([np.zeros(degree), inside, np.ones(degree)])
