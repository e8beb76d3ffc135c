"""Maps of deviations, as arrays and for other libraries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .field import Floats, Signs

#: The arrays of a map that have three coordinates.
_VECTORS = ("vertices", "normals", "triangles", "points", "feet")


@dataclass(frozen=True)
class DeviationMap:
    """The triangles of a model with the deviation from the other one at each vertex; without triangles the
    points of a cloud. Between vertices the deviation is an estimate.

    Attributes
    ----------
    vertices : ndarray of shape (n, 3)
        The vertices, in the model's own coordinates.
    normals : ndarray of shape (n, 3)
        Unit normals at the vertices; 0 where the surface has none.
    triangles : ndarray of shape (k, 3)
        Three vertices a triangle.
    faces : ndarray of shape (k,)
        The face of each triangle.
    points : ndarray of shape (n, 3)
        The points of the model that were measured, in its own coordinates.
    slacks : ndarray of shape (n,)
        The most that the model is from each of these points, but for the rounding of float32.
    distances : ndarray of shape (n,)
        Their distances from the other model, in A's unit.
    signed : ndarray of shape (n,)
        The distances with a sign, NaN where there is none.
    feet : ndarray of shape (n, 3)
        The nearest points on the other model, in the coordinates of a result.
    signs : {"solid", "faces"}
        Whether negative is inside of the other model, where that is a solid, or behind the normal of a face.
    """

    vertices: Floats
    normals: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    faces: NDArray[np.uint32]
    points: Floats
    slacks: Floats
    distances: Floats
    signed: Floats
    feet: Floats
    signs: Signs

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.PolyData`` whose points have the arrays ``distance`` and ``signed``, and whose
        triangles have ``face``."""
        import pyvista

        if len(self.triangles) == 0:
            data = pyvista.PolyData(self.vertices)
        else:
            data = pyvista.PolyData.from_regular_faces(self.vertices, self.triangles)
            data.cell_data["face"] = self.faces
        data.point_data["distance"] = self.distances
        data.point_data["signed"] = self.signed
        return data


@dataclass(frozen=True)
class DeviationMaps:
    """The maps of one model or of both.

    Attributes
    ----------
    diagonal : float
        The larger diagonal of both models, in model units.
    a, b : DeviationMap or None
        The maps that were asked for.
    """

    diagonal: float
    a: DeviationMap | None
    b: DeviationMap | None


def maps_result(data: dict[str, Any]) -> DeviationMaps:
    """Shape the flat arrays of the native half."""

    def shaped(arrays: dict[str, Any] | None) -> DeviationMap | None:
        if arrays is None:
            return None
        vectors = {name: arrays[name].reshape(-1, 3) for name in _VECTORS}
        return DeviationMap(**{**arrays, **vectors})

    return DeviationMaps(data["diagonal"], shaped(data["a"]), shaped(data["b"]))
