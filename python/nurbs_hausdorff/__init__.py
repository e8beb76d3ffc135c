"""Certified distances between CAD models, as intervals that contain them.

>>> import nurbs_hausdorff as nh
>>> result = nh.distance("a.step", "b.step", symmetric=True)  # doctest: +SKIP
>>> result.lower, result.upper  # doctest: +SKIP
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _names, _native, _transform, testing
from ._errors import NurbsHausdorffError
from ._field import Field, FieldPart, Signs, field_parts
from ._model import Mesh, Model, ReadReport, Remark, model, read
from ._progress import Event, ProgressBar, reporter
from ._results import (
    DiffResult,
    DistanceResult,
    FaceDifference,
    Statistics,
    SurfacePoint,
    Witness,
    diff_result,
    distance_result,
)
from ._transform import Transform

__all__ = [
    "ClosestPoints", "DiffResult", "DistanceResult", "FaceDifference", "Field", "FieldPart",
    "Mesh", "Model", "NurbsHausdorffError", "ReadReport", "Remark", "Statistics", "SurfacePoint",
    "Transform", "Witness", "closest_points", "diff", "distance", "field", "model", "read",
    "testing",
]  # fmt: skip


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
    """

    distances: NDArray[np.float64]
    bounds: NDArray[np.float64]
    signed: NDArray[np.float64]
    signs: Signs
    feet: NDArray[np.float64]
    faces: NDArray[np.uint32]
    parameters: NDArray[np.float64]


def distance(
    a: Any,
    b: Any,
    *,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
    **options: Any,
) -> DistanceResult:
    """Return an interval that contains the directed distance from A to B, or with
    ``symmetric=True`` the larger of both directions.

    Options are those of the command ``distance`` in snake case, such as ``tolerance``,
    ``relative_tolerance``, ``limit``, ``max_seconds``, ``symmetric``, ``method``.

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` with the interval reached.
    """
    data = _native.distance(
        model(a)._native, model(b)._native, _names.options(**options),
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
    parts = data.pop("deviations")
    return distance_result(_names.snake(data), parts)


def diff(
    a: Any,
    b: Any,
    *,
    limit: float = 1e-3,
    max_cells: int | None = None,
    max_seconds: float | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> DiffResult:
    """Return the state of every face of both models at a limit, in model units."""
    options = _names.options(
        limit=limit, max_cells=max_cells, max_seconds=max_seconds, scale_units=scale_units
    )
    data = _native.diff(
        model(a)._native, model(b)._native, options,
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
    return diff_result(_names.snake(data))


def field(
    a: Any,
    b: Any,
    *,
    samples: int | None = None,
    sampling: Literal["uniform", "arc-length"] | None = None,
    upper: float | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> Field:
    """Return the deviation of A from B at a grid of samples of every surface of A."""
    options = _names.options(
        samples=samples, sampling=sampling, upper=upper, scale_units=scale_units
    )
    data = _native.field(
        model(a)._native, model(b)._native, options,
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
    statistics = _names.snake(data["statistics"])
    return Field(
        data["diagonal"],
        None if statistics is None else Statistics(**statistics),
        field_parts(data["deviations"]),
    )


def closest_points(
    part: Any,
    points: ArrayLike,
    *,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> ClosestPoints:
    """Return the closest points of a model to points of shape (n, 3), in model units."""
    given = np.asarray(points, dtype=np.float64)
    if given.ndim != 2 or given.shape[1] != 3:
        raise NurbsHausdorffError(
            "ARGUMENT_INVALID", f"points have shape {given.shape}, expected (n, 3)"
        )
    options = _names.options(tolerance=tolerance, relative_tolerance=relative_tolerance)
    found = _native.closest_points(
        model(part)._native, np.ascontiguousarray(given).reshape(-1), options,
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
    found["feet"] = found["feet"].reshape(-1, 3)
    found["parameters"] = found["parameters"].reshape(-1, 2)
    return ClosestPoints(**found)
