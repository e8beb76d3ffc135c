"""Signed distances on a grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SignedDistances:
    """Signed distances of a solid at the points ``origin + spacing * (i, j, k)``; model units.

    Attributes
    ----------
    values : ndarray of shape (nx, ny, nz)
        The distances, negative inside, never NaN; of float32 or float64, as asked for.
    origin : ndarray of shape (3,)
        The first point.
    spacing : float
        The distance of neighbours along each axis.
    bound : float
        A value of a size below ``band`` is within it of the true distance. Where a value has the
        band's size, the true distance is at least that less the bound.
    band : float
        The band's width; infinite if all points were measured.
    undecided : ndarray of shape (n, 3)
        The indices of the points whose side is not decided: on the boundary, or in its gaps.
        Their values are positive. All other signs are certain.
    measured : int
        The number of measured points: of each brick its middle, and its points unless they are beyond the band.
    """

    values: NDArray[np.float32] | NDArray[np.float64]
    origin: NDArray[np.float64]
    spacing: float
    bound: float
    band: float
    undecided: NDArray[np.int64]
    measured: int
