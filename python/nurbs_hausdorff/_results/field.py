"""Deviations at samples, as arrays and for other libraries."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Signs = Literal["solid", "faces"]


@dataclass(frozen=True)
class Statistics:
    """Estimates over the area of the sampled model, without error bounds; ``area`` is in squares
    of the model unit, all others are lengths."""

    estimate: bool
    area: float
    mean: float
    rms: float
    signed_mean: float
    median: float
    percentile_95: float
    percentile_99: float


@dataclass(frozen=True)
class FieldPart:
    """The grid of samples of one face of A, or of a piece of a trimmed face. A mesh has a grid of
    one column a group: its vertices, and points within large triangles; a cloud has its points.

    Attributes
    ----------
    face : int
        Index of the face.
    points, feet : ndarray of shape (m, n, 3)
        The samples, moved by the transform, and their closest points on B.
    distances : ndarray of shape (m, n)
        Their distances, each at most 1e-9 of the diagonal above the true one.
    signed : ndarray of shape (m, n)
        The distances with a sign, NaN where there is none.
    signs : {"solid", "faces"}
        Whether negative is inside of B, where that is a solid, or behind the normal of a face.
    areas : ndarray of shape (m, n)
        Area that each sample stands for, in squares of the model unit; 1 for a point of a cloud.
    triangles : ndarray of shape (k, 3) or None
        Of a mesh: the corners of triangles between the samples, which cover it.
    """

    face: int
    points: Floats
    feet: Floats
    distances: Floats
    signed: Floats
    signs: Signs
    areas: Floats
    triangles: NDArray[np.uint32] | None = None


@dataclass(frozen=True)
class Field:
    """The deviation of A from B at samples of A.

    Attributes
    ----------
    diagonal : float
        The larger diagonal of both models, in model units.
    statistics : Statistics or None
        Estimates over A's area, where it has one.
    parts : tuple of FieldPart
        One grid a surface.
    """

    diagonal: float
    statistics: Statistics | None
    parts: tuple[FieldPart, ...]

    def flat(self, name: str) -> Floats:
        """Return ``points`` or ``feet`` of all parts, of shape (k, 3), or another array of them,
        of shape (k,)."""
        width = (-1, 3) if name in ("points", "feet") else (-1,)
        return np.concatenate([getattr(part, name).reshape(width) for part in self.parts])

    def to_pyvista(self) -> Any:
        """Return a ``pyvista.MultiBlock`` with a structured grid a part, triangles of a mesh and
        points of a cloud, whose points have the arrays ``distance`` and ``signed``."""
        import pyvista

        blocks = pyvista.MultiBlock()
        for part in self.parts:
            if part.points.shape[1] == 1:
                corners = part.triangles
                points = part.points[:, 0]
                data = pyvista.PolyData(points) if corners is None else pyvista.PolyData.from_regular_faces(points, corners)
                data.point_data["distance"] = part.distances[:, 0]
                data.point_data["signed"] = part.signed[:, 0]
                blocks.append(data, f"face {part.face}")
                continue
            x, y, z = (part.points[:, :, axis] for axis in range(3))
            grid = pyvista.StructuredGrid(x, y, z)
            # VTK counts the first direction fastest.
            grid.point_data["distance"] = part.distances.ravel(order="F")
            grid.point_data["signed"] = part.signed.ravel(order="F")
            blocks.append(grid, f"face {part.face}")
        return blocks

    def hist(self, ax: Any = None, *, bins: int = 50, signed: bool = False) -> Any:
        """Draw the share of A's area by distance with Matplotlib, and return the axes."""
        if ax is None:
            import matplotlib.pyplot

            ax = matplotlib.pyplot.gca()
        values = self.flat("signed" if signed else "distances")
        has_sign = np.isfinite(values)
        ax.hist(values[has_sign], bins=bins, weights=self.flat("areas")[has_sign])
        ax.set_xlabel("signed distance" if signed else "distance")
        ax.set_ylabel("area")
        return ax


def field_parts(parts: list[dict[str, Any]]) -> tuple[FieldPart, ...]:
    """Shape the flat arrays of the native half."""

    def shaped(part: dict[str, Any]) -> FieldPart:
        m, n = part["counts"]
        return FieldPart(
            part["face"],
            part["points"].reshape(m, n, 3),
            part["feet"].reshape(m, n, 3),
            part["distances"].reshape(m, n),
            part["signed"].reshape(m, n),
            part["signs"],
            part["areas"].reshape(m, n),
            part["triangles"].reshape(-1, 3) if part["triangles"].size else None,
        )

    return tuple(shaped(part) for part in parts)
