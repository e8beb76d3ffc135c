"""Maps of deviations."""

from __future__ import annotations

from typing import Any, Literal

from numpy.typing import ArrayLike

from .._values import names as _names
from .ask import ask
from .._values.progress import Event, ProgressBar
from .._results.diff import DiffResult
from .._results.distance import DistanceResult
from .._results.maps import DeviationMaps, maps_result
from .._values.transform import Transform


def deviation_maps(
    a: Any,
    b: Any,
    *,
    of: Literal["a", "b", "both"] = "a",
    known: DistanceResult | DiffResult | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> DeviationMaps:
    """Return triangles of A, of B or of both, with the deviation from the other model at each vertex,
    finer where it is not linear: what the page and reports draw.

    Parameters
    ----------
    a, b : anything that `model` takes
    of : {"a", "b", "both"}
        The model whose map is made.
    known : DistanceResult or DiffResult, optional
        A result of the same models in the same positions: no deviation of a map exceeds its upper bounds,
        which `diff` has for each face.
    scale_units : bool
        Scales B to the unit of A where both state different ones; else that is an error.
    transform : Transform or array of shape (4, 4), optional
        Moves A before it is measured.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` if ``cancel`` was set.
    """
    sides = ("a", "b") if of == "both" else (of,)
    options = _names.options(scale_units=scale_units)
    options.update({side: {"uppers": _uppers(known, side)} for side in sides})
    data = ask("deviation_maps", a, b, options, transform, progress, cancel)
    return maps_result(data)


def _uppers(known: DistanceResult | DiffResult | None, side: str) -> list[float]:
    """Return what a result knows of the distances of one model's points: one bound, one a face, or none."""
    if isinstance(known, DiffResult):
        return [face.upper for face in (known.faces_of_a if side == "a" else known.faces_of_b)]
    if known is None or (side == "b" and known.forward is None):
        # A directed distance says nothing of B.
        return []
    directed = known if known.forward is None else known.forward if side == "a" else known.reverse
    return [] if directed is None else [directed.upper]
