"""The measurements of points: given ones, and those of a grid."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from .._values import names as _names, transform as _transform
from .. import _native
from .._values.arrays import rows
from .._values.progress import Event, ProgressBar, reporter
from .._results.closest import ClosestPoints
from .._results.grid import SignedDistances
from .._sources import model
from .._values.transform import Transform


def closest_points(
    part: Any,
    points: ArrayLike,
    *,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    sign_tolerance: float | None = None,
    backend: Literal["auto", "gpu", "cpu"] | None = None,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> ClosestPoints:
    """Return the closest points of a model.

    Parameters
    ----------
    part : anything that `model` takes
    points : array of shape (n, 3)
        The points, in model units.
    tolerance, relative_tolerance : float, optional
        Permitted excess of a distance over the least one, in model units or as a fraction of
        the model's diagonal; 1e-9 of it if neither is given.
    sign_tolerance : float, optional
        Distances up to this, in model units, have the sign 0, which is then not decided; 0 if it is
        not given. Beside the faces of a solid a sign takes many times as long as the distance.
    backend : {"auto", "gpu", "cpu"}, optional
        Where feet are looked for; the CPU if it is not given. On a GPU every point of surfaces gets a
        foot and a bound, and the CPU searches where these do not decide it; "auto" takes a GPU that
        is no software.
    transform : Transform or array of shape (4, 4), optional
        Moves the points before they are measured.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` if ``cancel`` was set.
    """
    given = rows("points", points)
    options = _names.options(
        tolerance=tolerance, relative_tolerance=relative_tolerance, sign_tolerance=sign_tolerance,
        backend=backend,
    )  # fmt: skip
    found = _native.closest_points(
        model(part)._native, given.reshape(-1), options,
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
    found["feet"] = found["feet"].reshape(-1, 3)
    found["parameters"] = found["parameters"].reshape(-1, 2)
    return ClosestPoints(**found)


def signed_distances(
    part: Any,
    *,
    origin: Sequence[float] | None = None,
    spacing: float | None = None,
    counts: Sequence[int] | None = None,
    resolution: int | None = None,
    band: float | None = None,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    precision: Literal["float32", "float64"] | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> SignedDistances:
    """Return the signed distances of a solid on a grid of points, negative inside.

    What is left out of the grid follows from the model's box, which it then has in its middle.

    Parameters
    ----------
    part : anything that `model` takes
    origin : three floats, optional
        The first point.
    spacing : float, optional
        The distance of neighbours along each axis, in model units.
    counts : three ints, optional
        The number of points along x, y and z. If it is left out, the grid reaches to the band's
        width and to two spacings at least beyond the box.
    resolution : int, optional
        Instead of ``spacing``, the number of spacings along the longest side of the box; 64 if
        neither is given.
    band : float, optional
        Distances above it are not measured: their values are its width, with their sign.
    tolerance, relative_tolerance : float, optional
        Permitted excess of a distance over the least one, in model units or as a fraction of
        the model's diagonal; 1e-6 of it if neither is given.
    precision : {"float32", "float64"}, optional
        The precision of the values, float64 if it is left out.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused, as ``NOT_CLOSED`` for a model without an inside;
        ``CANCELLED`` if ``cancel`` was set.
    """
    options = _names.options(
        origin=None if origin is None else [float(x) for x in origin],
        spacing=spacing,
        counts=None if counts is None else [operator.index(count) for count in counts],
        resolution=resolution,
        band=band,
        tolerance=tolerance,
        relative_tolerance=relative_tolerance,
        precision=precision,
    )
    found = _native.signed_distances(model(part)._native, options, reporter(progress, cancel))
    shape = tuple(found.pop("counts"))
    found["values"] = found["values"].reshape(shape, order="F")
    found["undecided"] = np.column_stack(np.unravel_index(found["undecided"], shape, order="F"))
    return SignedDistances(**found)
