"""Bicubic sheets: large nets, a ridge, a spike, a saddle's cusp."""

import numpy as np

from nurbs import Surface, clamped_knots
from pairs import Pair

DEGREE = 3

# A seed, so that every run measures the same bumps.
SEED = 20121121


def sheet(count, height, low=-1.0, high=1.0):
    """The sheet whose control points lie evenly over a square at the heights `height(x, y)`."""
    line = np.linspace(low, high, count)
    x, y = np.meshgrid(line, line, indexing="ij")
    knots = clamped_knots(DEGREE, count)
    z = np.broadcast_to(height(x, y), x.shape)
    return Surface((DEGREE, DEGREE), (knots, knots), np.stack([x, y, z], axis=2), np.ones_like(x))


def large_nets():
    """Random bumps under a hill, so that the farthest point is inside and no grid hits it."""
    rough = np.random.default_rng(SEED).uniform(-0.06, 0.06, (100, 100))
    bumpy = sheet(100, lambda x, y: 0.3 * np.exp(-3 * (x * x + y * y)) + rough)
    smooth = sheet(100, lambda x, y: 0.1 * np.sin(2 * x) * np.cos(2 * y))
    return Pair(
        "nets-100x100", "a bumpy sheet of 100 x 100 control points to a smooth one", [bumpy], [smooth]
    )


def ridge():
    """A sheet on which the nearer of two sheets changes all over: |distance| has a ridge."""
    middle = sheet(12, lambda x, y: 0.02 * np.sin(4 * x) * np.cos(3 * y))
    upper = sheet(12, lambda x, y: 0.5 + 0.1 * np.sin(3 * x + 1) * np.cos(2 * y), -1.2, 1.2)
    lower = sheet(12, lambda x, y: -0.5 + 0.1 * np.cos(2 * x) * np.sin(3 * y), -1.2, 1.2)
    return Pair("ridge", "a sheet midway between two sheets", [middle], [upper, lower])


def spike():
    """One control point of a flat sheet raised: the farthest point is in one span of many."""

    def height(x, _):
        z = np.zeros_like(x)
        z[17, 23] = 1.0
        return z

    flat = sheet(6, lambda x, y: -0.01 * (x * x + y * y))
    return Pair(
        "spike",
        "a sheet of 40 x 40 control points, one of them raised, to a sheet",
        [sheet(40, height)],
        [flat],
    )


def saddle_in_ellipsoid(sphere):
    """A saddle near the middle of a long ellipsoid, where its nearest points change sides."""
    saddle = sheet(4, lambda x, y: x * x - y * y, -0.4, 0.4).moved((0.05, 0.1, 0.3))
    ellipsoid = Surface(sphere.degree, sphere.knots, sphere.points * [1.0, 1.2, 3.0], sphere.weights)
    return Pair(
        "saddle-in-ellipsoid",
        "a saddle to the ellipsoid of half axes 1, 1.2, 3 around it",
        [saddle],
        [ellipsoid],
    )
