"""The score of a candidate against the truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from numpy.typing import ArrayLike

from .._values import names as _names
from .ask import ask
from .._values.progress import Event, ProgressBar
from .._results.score import Score, score_result
from .._values.transform import Transform


def score(
    candidate: Any,
    truth: Any,
    *,
    thresholds: Sequence[float] = (),
    relative_thresholds: Sequence[float] = (),
    normal_angle: float | None = None,
    feature_angle: float | None = None,
    align: Literal["none", "box", "best-fit"] = "none",
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    part_tolerance: float | None = None,
    limit: float | None = None,
    at_least: Mapping[str, float] | None = None,
    at_most: Mapping[str, float] | None = None,
    max_cells: int | None = None,
    max_seconds: float | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> Score:
    """Return the score of a candidate against the truth, every number as an interval.

    Parameters
    ----------
    candidate, truth : anything that `model` takes
    thresholds, relative_thresholds : sequence of float
        Distances at which precision, recall and F1 are stated, in model units or as fractions of
        the diagonal of the truth's box; 0.01 of it if none is given.
    normal_angle : float, optional
        Largest angle between tangent planes that count as alike, in degrees from 0 to 90; 30 if
        not given.
    feature_angle : float, optional
        Angle by which a surface turns at a feature edge at least, in degrees from 0 to 180; 30 if
        not given.
    align : {"none", "box", "best-fit"}
        How the candidate is laid on the truth: as it is; scaled and shifted so that the middles and
        the longest sides of both boxes agree; by the best fit from any pose.
    tolerance, relative_tolerance : float, optional
        Permitted width of the intervals of lengths, in model units or as a fraction of the truth's
        diagonal; 1e-3 of it if neither is given.
    part_tolerance : float, optional
        Permitted width of the intervals of precision and recall, of areas, with normals and of
        edges; 1e-3 if not given.
    limit : float, optional
        Compares faces one by one: those within it of the other model are unchanged.
    at_least, at_most : mapping of str to float, optional
        Numbers that have to be large or small enough, such as ``{"f1": 0.99}``: ``valid``,
        ``volume_ratio``, ``area_ratio``, ``centroid_distance``, ``extent_difference``,
        ``precision``, ``recall``, ``f1``, ``normal_precision``, ``normal_recall``, ``normal_f1``,
        ``edge_precision``, ``edge_recall``, ``edge_f1``, ``chamfer``, ``chamfer_squared``,
        ``hausdorff``, ``iou``. Work ends where one is certainly missed.
    max_cells, max_seconds : optional
        Budgets, after which the intervals reached are returned.
    scale_units : bool
        Scales the truth to the unit of the candidate where both state different ones; else that is
        an error.
    transform : Transform or array of shape (4, 4), optional
        Moves the candidate before it is aligned.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` if ``cancel`` was set.
    """
    options = _names.options(
        thresholds=list(thresholds), relative_thresholds=list(relative_thresholds),
        normal_angle=normal_angle, feature_angle=feature_angle, align=align,
        tolerance=tolerance, relative_tolerance=relative_tolerance, part_tolerance=part_tolerance,
        limit=limit, at_least=_bounds(at_least), at_most=_bounds(at_most), max_cells=max_cells,
        max_seconds=max_seconds, scale_units=scale_units,
    )  # fmt: skip
    data = ask("score", candidate, truth, options, transform, progress, cancel)
    return score_result(_names.snake(data))


def _bounds(of: Mapping[str, float] | None) -> dict[str, float]:
    return {_names.camel(name): float(bound) for name, bound in (of or {}).items()}
