"""Spheres as exact rational surfaces, and a sphere's polynomial fit."""

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation

from nurbs import Surface
from pairs import Pair

W = np.sqrt(0.5)
# Points [x, y] of the unit circle in four quadratic quarters with their weights
# (Piegl and Tiller, The NURBS Book, section 7.5).
CIRCLE = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]], float)
CIRCLE_WEIGHTS = np.array([1, W, 1, W, 1, W, 1, W, 1])
CIRCLE_KNOTS = np.array([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], float) / 4
ARC_KNOTS = np.array([0, 0, 0, 1, 1, 1], float)


def sphere(radius=1.0):
    """The whole sphere as one biquadratic surface, its poles on the z axis."""
    half, half_weights = CIRCLE[[6, 7, 0, 1, 2]], CIRCLE_WEIGHTS[:5][[0, 1, 2, 3, 4]]
    knots = (CIRCLE_KNOTS, np.array([0, 0, 0, 1, 1, 2, 2, 2], float) / 2)
    return revolved(CIRCLE, CIRCLE_WEIGHTS, radius * half, half_weights, knots)


def revolved(turn, turn_weights, profile, profile_weights, knots):
    """A profile of points [radius, height] swept along arcs about the z axis."""
    points = np.empty((len(turn), len(profile), 3))
    points[..., :2] = turn[:, None, :] * profile[None, :, :1]
    points[..., 2] = profile[:, 1]
    return Surface((2, 2), knots, points, np.outer(turn_weights, profile_weights))


def octant():
    """An eighth of the unit sphere."""
    quarter, weights = CIRCLE[:3], CIRCLE_WEIGHTS[:3]
    return revolved(quarter, weights, quarter, weights, (ARC_KNOTS, ARC_KNOTS))


def fitted(surface, count=8):
    """The bicubic spline through `count` x `count` points of a surface: polynomial."""
    u, v = (np.linspace(*ends, count) for ends in surface.domain)
    along_u = make_interp_spline(u, surface.grid(u, v), k=3)
    along_v = make_interp_spline(v, along_u.c.transpose(1, 0, 2), k=3)
    points = along_v.c.transpose(1, 0, 2)
    return Surface((3, 3), (along_u.t, along_v.t), points, np.ones(points.shape[:2]))


def offset_spheres():
    """All points have the same distance."""
    return Pair(
        "spheres-1-1.1", "concentric spheres of radius 1 and 1.1", [sphere()], [sphere(1.1)], truth=0.1
    )


def rotated_sphere():
    """The same set of points with its seam and poles elsewhere."""
    rotation = Rotation.from_rotvec([0.3, 0.5, 0.2]).as_matrix()
    turned = sphere().moved(rotation=rotation)
    return Pair(
        "sphere-rotated", "a sphere to itself turned: other seam and poles", [turned], [sphere()], truth=0.0
    )


def octant_fit():
    """A rational surface and what a polynomial export makes of it."""
    exact = octant()
    return Pair("octant-fit", "a bicubic fit of a sphere's octant to the octant", [fitted(exact)], [exact])
