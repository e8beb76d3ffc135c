"""Arrays of real numbers, without a loss."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._errors import NurbsHausdorffError

#: Largest integer up to which float64 has all.
_MAX_INTEGER = 2**53


def rows(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Return real numbers of shape (n, 3) in float64.

    Raises
    ------
    NurbsHausdorffError
        ``ARGUMENT_INVALID`` for another shape, for complex numbers, text and objects, masked
        values, and integers that float64 does not have.
    """
    found = plain(name, values)
    if found.ndim != 2 or found.shape[1] != 3:
        raise refused(f"{name} have shape {found.shape}, expected (n, 3)")
    if found.dtype.kind not in "iuf":
        raise refused(f"{name} are {found.dtype}, expected real numbers")
    if found.dtype.kind in "iu" and found.size:
        size = max(abs(int(found.min())), abs(int(found.max())))
        if size > _MAX_INTEGER:
            raise refused(f"{name} have {size}, expected integers of at most 2**53 in size")
    return np.ascontiguousarray(found, dtype=np.float64)


def plain(name: str, values: ArrayLike) -> NDArray[Any]:
    """Return an array of any type.

    Raises
    ------
    NurbsHausdorffError
        ``ARGUMENT_INVALID`` for masked values and rows of several lengths.
    """
    if np.ma.isMaskedArray(values) and np.ma.is_masked(values):
        count = int(np.ma.getmaskarray(values).sum())
        raise refused(f"{name} have {count} masked values, expected none")
    try:
        return np.asarray(values)
    except (TypeError, ValueError) as error:
        raise refused(f"{name}: {error}") from error


def refused(found: str) -> NurbsHausdorffError:
    """Return the error ``ARGUMENT_INVALID``."""
    return NurbsHausdorffError("ARGUMENT_INVALID", found)
