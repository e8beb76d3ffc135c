"""Closest points of a model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .field import Signs


@dataclass(frozen=True)
class ClosestPoints:
    """Closest points of a model to n points; lengths in model units.

    Attributes
    ----------
    distances, bounds : ndarray of shape (n,)
        The distance of point i is within ``bounds[i]`` of ``distances[i]``.
    signed : ndarray of shape (n,)
        The distances with a sign, NaN where there is none.
    signs : {"solid", "faces"}
        Whether negative is inside of the model, where that is a solid, or behind the normal of
        a face.
    feet : ndarray of shape (n, 3)
        The closest points.
    faces : ndarray of shape (n,)
        Indices of their faces.
    parameters : ndarray of shape (n, 2)
        Their parameters u, v there.
    decided_on_gpu : int
        The number of points that a GPU's feet and bounds decided; the CPU searched for the others.
    """

    distances: NDArray[np.float64]
    bounds: NDArray[np.float64]
    signed: NDArray[np.float64]
    signs: Signs
    feet: NDArray[np.float64]
    faces: NDArray[np.uint32]
    parameters: NDArray[np.float64]
    decided_on_gpu: int
