"""A square in space as triangles and as a surface, and what tests ask of results."""

import numpy as np
import pytest

import nurbs_hausdorff as nh

#: A square of side 2 about the origin, as two triangles.
CORNERS = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])


def flat(height):
    """The same square, at a height, as a surface."""
    ctrl = (CORNERS + [0, 0, height])[[0, 3, 1, 2]].reshape(2, 2, 3)
    return {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": ctrl}


def contains(result, expected):
    return result.lower <= expected <= result.upper and result.upper - result.lower < 1e-5


def refused(part):
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.model(part)
    return raised.value
