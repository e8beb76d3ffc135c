"""Boxes of six faces, for tests."""

import numpy as np


def face(origin, u, v):
    """A parallelogram, whose normal is along u x v."""
    origin, u, v = (np.array(vector, float) for vector in (origin, u, v))
    ctrl = np.array([[origin, origin + v], [origin + u, origin + u + v]])
    return {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": ctrl}


def box(low, size=(1.0, 1.0, 1.0)):
    """The six faces of a box, their normals outward."""
    low, size = np.array(low, float), np.array(size, float)
    x, y, z = np.diag(size)
    faces = [face(low, one, other) for one, other in ((y, x), (x, z), (z, y))]
    high = low + size
    return faces + [face(high, -one, -other) for one, other in ((x, y), (z, x), (y, z))]
