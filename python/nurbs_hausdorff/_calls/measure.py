"""The measurements of two models."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from numpy.typing import ArrayLike

from .._values import names as _names
from .ask import ask
from .._results.bodies.clearance import ClearanceResult, GapsResult, clearance_result, gaps_result
from .._results.diff import DiffResult, diff_result
from .._results.distance import DistanceResult, distance_result
from .._results.field import Field, Statistics, field_parts
from .._results.bodies.overlap import OverlapResult, overlap_result
from .._results.statistics import CertifiedStatistics, statistics_result
from .._values.progress import Event, ProgressBar
from .._values.transform import Transform

Sampling = Literal["uniform", "arc-length"]


def distance(
    a: Any,
    b: Any,
    *,
    symmetric: bool = False,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    limit: float | None = None,
    max_seconds: float | None = None,
    max_cells: int | None = None,
    audit: Literal["share", "all"] | None = None,
    method: Literal["certified", "iteration", "hierarchy"] = "certified",
    deviations: bool = False,
    samples: int | None = None,
    sampling: Sampling | None = None,
    flatness: Literal["none", "loose", "tight", "curvature"] | None = None,
    projection: Literal["newton", "tangent-plane"] | None = None,
    culling: Literal["tree", "none"] | None = None,
    iterations: int | None = None,
    step_tolerance: float | None = None,
    grid: int | None = None,
    memory_budget: int | None = None,
    backend: Literal["auto", "gpu", "cpu"] | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> DistanceResult:
    """Return an interval that contains the directed distance from A to B.

    Parameters
    ----------
    a, b : anything that `model` takes
    symmetric : bool
        The larger of both directions.
    tolerance, relative_tolerance : float, optional
        Permitted width of the interval, in model units or as a fraction of the larger diagonal;
        1e-6 of it if neither is given.
    limit : float, optional
        Length that the verdict ``within`` is about, in model units; the search ends with it.
    max_seconds, max_cells : optional
        Budgets of each direction, after which the interval reached is returned.
    audit : {"share", "all"}, optional
        Upper bounds that are checked by certified closest points while the search runs: a share
        of those beyond the simplest, or all.
    method : {"certified", "iteration", "hierarchy"}
        The two others replicate papers. ``samples``, ``sampling``, ``flatness``, ``projection``,
        ``culling``, ``iterations`` and ``step_tolerance`` are for ``iteration``, ``grid`` and
        ``memory_budget`` (in MiB) for ``hierarchy``.
    deviations : bool
        Adds the deviation at a grid of ``samples``.
    backend : {"auto", "gpu", "cpu"}, optional
        Processor of the kernels.
    scale_units : bool
        Scales B to the unit of A where both state different ones; else that is an error.
    transform : Transform or array of shape (4, 4), optional
        Moves A before it is measured.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` with the interval reached.
    """
    options = _names.options(
        symmetric=symmetric, tolerance=tolerance, relative_tolerance=relative_tolerance,
        limit=limit, max_seconds=max_seconds, max_cells=max_cells, audit=audit, method=method,
        deviations=deviations, samples=samples, sampling=sampling, flatness=flatness,
        projection=projection, culling=culling, iterations=iterations,
        step_tolerance=step_tolerance, grid=grid, memory_budget=memory_budget, backend=backend,
        scale_units=scale_units,
    )  # fmt: skip
    data = ask("distance", a, b, options, transform, progress, cancel)
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
    """Return the state of every face of both models at a limit.

    Parameters
    ----------
    a, b : anything that `model` takes
    limit : float
        Length up to which a face is unchanged, in model units.
    max_cells : int, optional
        Cells after which a face is given up as undecided.
    max_seconds : float, optional
        Seconds after which the faces that are not decided yet are given up as undecided.
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
    options = _names.options(
        limit=limit, max_cells=max_cells, max_seconds=max_seconds, scale_units=scale_units
    )
    data = ask("diff", a, b, options, transform, progress, cancel)
    return diff_result(_names.snake(data))


def clearance(
    a: Any,
    b: Any,
    *,
    limit: float | None = None,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    max_seconds: float | None = None,
    max_cells: int | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> ClearanceResult:
    """Return an interval that contains the least distance of both boundaries, and whether the
    solids overlap.

    Parameters
    ----------
    a, b : anything that `model` takes
    limit : float, optional
        Length that the verdict ``at_least`` is about, in model units; the search ends with it.
    tolerance, relative_tolerance : float, optional
        Permitted width of the interval, in model units or as a fraction of the larger diagonal;
        1e-6 of it if neither is given.
    max_seconds, max_cells : optional
        Budgets, after which the interval reached is returned.
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
    options = _names.options(
        limit=limit, tolerance=tolerance, relative_tolerance=relative_tolerance,
        max_seconds=max_seconds, max_cells=max_cells, scale_units=scale_units,
    )  # fmt: skip
    data = ask("clearance", a, b, options, transform, progress, cancel)
    return clearance_result(_names.snake(data))


def overlap(
    a: Any,
    b: Any,
    *,
    tolerance: float | None = None,
    max_seconds: float | None = None,
    max_cells: int | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> OverlapResult:
    """Return the volumes that two solids have in common and apart, and their ratio, as intervals.

    Parameters
    ----------
    a, b : anything that `model` takes
    tolerance : float, optional
        Permitted width of the common volume, as a fraction of the union's; 1e-3 if not given.
    max_seconds, max_cells : optional
        Budgets, after which the intervals reached are returned.
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
    options = _names.options(
        tolerance=tolerance, max_seconds=max_seconds, max_cells=max_cells, scale_units=scale_units
    )
    data = ask("overlap", a, b, options, transform, progress, cancel)
    return overlap_result(_names.snake(data))


def statistics(
    a: Any,
    b: Any,
    *,
    percentiles: Sequence[float] | None = None,
    limit: float | None = None,
    part_tolerance: float | None = None,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    max_seconds: float | None = None,
    max_cells: int | None = None,
    audit: Literal["share", "all"] | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> CertifiedStatistics:
    """Return statistics of the distances from all points of A to B, each as an interval that
    contains it: of a cloud by count, else by area.

    Parameters
    ----------
    a, b : anything that `model` takes
    percentiles : sequence of float, optional
        Parts of the whole above 0 and below 1; 0.5, 0.95 and 0.99 if not given.
    limit : float, optional
        Distance, in model units: the part of A that is farther is returned as ``beyond``.
    part_tolerance : float, optional
        Permitted width of the interval of that part; 1e-3 if not given.
    tolerance, relative_tolerance : float, optional
        Permitted width of the other intervals, in model units or as a fraction of the larger
        diagonal; 1e-4 of it if neither is given.
    max_seconds, max_cells : optional
        Budgets, after which the intervals reached are returned.
    audit : {"share", "all"}, optional
        Parts whose bounds are compared with certified distances of their points at the end.
    scale_units : bool
        Scales B to the unit of A where both state different ones; else that is an error.
    transform : Transform or array of shape (4, 4), optional
        Moves A before it is measured.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``NO_AREA`` for an A whose area may be 0; ``CANCELLED``
        if ``cancel`` was set.
    """
    options = _names.options(
        percentiles=None if percentiles is None else [float(part) for part in percentiles],
        limit=limit, part_tolerance=part_tolerance,
        tolerance=tolerance, relative_tolerance=relative_tolerance,
        max_seconds=max_seconds, max_cells=max_cells, audit=audit, scale_units=scale_units,
    )  # fmt: skip
    data = ask("statistics", a, b, options, transform, progress, cancel)
    return statistics_result(_names.snake(data))


def gaps(
    a: Any,
    b: Any,
    *,
    below: float,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    max_seconds: float | None = None,
    max_cells: int | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> GapsResult:
    """Return the pairs of faces, one of each model, that come nearer to each other than a length.

    Parameters
    ----------
    a, b : anything that `model` takes
    below : float
        The length, in model units, 0 or more.
    tolerance, relative_tolerance : float, optional
        Permitted width of each pair's interval, in model units or as a fraction of the larger
        diagonal; 1e-6 of it if neither is given.
    max_seconds : float, optional
        Seconds after which the pairs so far are returned; ``complete`` is False then.
    max_cells : int, optional
        Pairs of cells, for each pair of faces, after which its interval so far is taken.
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
    options = _names.options(
        below=below, tolerance=tolerance, relative_tolerance=relative_tolerance,
        max_seconds=max_seconds, max_cells=max_cells, scale_units=scale_units,
    )  # fmt: skip
    data = ask("gaps", a, b, options, transform, progress, cancel)
    return gaps_result(_names.snake(data))


def field(
    a: Any,
    b: Any,
    *,
    samples: int | None = None,
    sampling: Sampling | None = None,
    upper: float | None = None,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> Field:
    """Return the deviation of A from B at a grid of samples of every surface of A.

    Parameters
    ----------
    a, b : anything that `model` takes
    samples : int, optional
        Samples along each direction of every surface of A, 2 to 1024.
    sampling : {"uniform", "arc-length"}, optional
        Whether they are equally spaced in the parameters or along the surface.
    upper : float, optional
        Known upper bound on the distance from A to B, in model units, such as
        ``distance(a, b).upper``: no distance of the field exceeds it.
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
    options = _names.options(
        samples=samples, sampling=sampling, upper=upper, scale_units=scale_units
    )
    data = ask("field", a, b, options, transform, progress, cancel)
    statistics = _names.snake(data["statistics"])
    return Field(
        data["diagonal"],
        None if statistics is None else Statistics(**statistics),
        field_parts(data["deviations"]),
    )
