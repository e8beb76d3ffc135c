"""The pose of one model that fits another best."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._values import names as _names
from .ask import ask
from .measure import Sampling
from .._values.progress import Event, ProgressBar
from .._values.transform import Transform


@dataclass(frozen=True)
class FitPose:
    """A pose of A that fits B, with the root mean square of the samples' distances there."""

    transform: Transform
    rms: float


@dataclass(frozen=True)
class LeftOut:
    """Samples that a fit left out.

    Attributes
    ----------
    points : array of shape (n, 3)
        Where they are in A's own file.
    beyond : float or None
        Distance beyond which a sample is left out; None where all count.
    """

    points: NDArray[np.float64]
    beyond: float | None = None


@dataclass(frozen=True)
class Zone:
    """The least, over a box of motions, of the largest distance of A's points to B: certain.

    Attributes
    ----------
    lower : float
        No motion of the box brings all points of A nearer to B than this.
    upper : float
        In the pose found no point of A is farther from B than this.
    degrees, translation : float
        The box: turns by up to this angle about ``center`` from the pose found, then shifts of up
        to this length; both only in the freedoms that datums leave.
    center : tuple of float
        Centre of the turns, in the frame of B.
    boxes : int
        Number of boxes of motions that were bounded.
    refuted : int
        Number of bounds that an audit refuted, and that were not relied on: 0, unless the library
        has a fault.
    passes : bool or None
        Whether some motion of the box brings all of A within the limit; None without a limit, and
        where it lies between the bounds.
    """

    lower: float
    upper: float
    degrees: float
    translation: float
    center: tuple[float, float, float]
    boxes: int
    refuted: int
    passes: bool | None = None


@dataclass(frozen=True)
class BestFit:
    """The pose of A that fits B best.

    Attributes
    ----------
    transform : Transform
        Moves A there.
    rms, rms_before, rms_random : float
        Root mean square of the samples' distances, weighted by area, without those left out: there,
        before, and in a pose that nothing determines. Estimates.
    steps : int
        Number of steps of the last fit.
    converged : bool
        Whether the last fit ended by itself, and its residual is at most a tenth of
        ``rms_random``, or all poses known come to it.
    ambiguous : tuple of FitPose
        The other poses found whose residual is at most twice the best one: those of symmetric parts.
    freedoms : int
        Number of independent motions that change no distance.
    tried : int
        Number of poses that the fit started from.
    samples : int
        Number of samples of A, or of ``faces_of_a``.
    counted : int
        Number of those that count in the pose found: not left out, and nearest to ``faces_of_b``.
    left_out : LeftOut
        The samples that are left out.
    largest : float
        The largest distance of the samples there: an estimate.
    zone : Zone or None
        Interval of the least largest distance, with a norm of the largest distance.
    zone_proven : bool or None
        Whether that interval is narrow: at most a hundredth of its upper bound wide.
    taken : tuple of int
        Number of freedoms, of six, that each datum took, in their order.
    """

    transform: Transform
    rms: float
    rms_before: float
    rms_random: float
    steps: int
    converged: bool
    ambiguous: tuple[FitPose, ...]
    freedoms: int
    tried: int
    samples: int
    counted: int
    left_out: LeftOut
    largest: float
    zone: Zone | None = None
    zone_proven: bool | None = None
    taken: tuple[int, ...] = ()


def best_fit(
    a: Any,
    b: Any,
    *,
    samples: int = 16,
    sampling: Sampling | None = None,
    start: Literal["any", "given", "axes", "boxes"] = "any",
    norm: Literal["mean", "largest", "outside", "inside", "none"] = "mean",
    pairs: Sequence[Mapping[str, Any]] = (),
    datums: Sequence[Mapping[str, Any]] = (),
    zone_translation: float | None = None,
    zone_degrees: float = 1.0,
    limit: float | None = None,
    max_boxes: int = 5000,
    outliers: float = 0.0,
    robust: Literal["none", "trimmed", "tukey", "geman-mcclure"] | None = None,
    faces_of_a: Sequence[int] = (),
    faces_of_b: Sequence[int] = (),
    max_distance: float | None = None,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    max_steps: int = 100,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> BestFit:
    """Return the pose of A at which the mean square of its samples' distances from B is least.

    It is no certified result but for ``zone``: measure ``distance`` there.

    Parameters
    ----------
    a, b : anything that `model` takes
    samples, sampling : optional
        Grid of samples of every surface of A, as for `field`.
    start : {"any", "given", "axes", "boxes"}
        Poses from which the fit starts: all rotations, ``transform`` alone, principal axes on each
        other, or ``transform`` with the middles of both boxes on each other.
    norm : {"mean", "largest", "outside", "inside", "none"}
        What is made least: the root mean square; the largest distance; the largest distance of a
        scan's points outside of B's body, or inside, which is negative if all are on the other
        side; or nothing: A then stays in its first pose, whose residual is stated.
    pairs : sequence of mappings
        ``{"a": point, "b": point, "weight": 1.0}``, three or more: the first pose lays points of A
        on those of B.
    datums : sequence of mappings
        ``{"a": feature, "b": feature}`` in their order, the primary first, where a feature is
        ``{"plane": {"point": p, "normal": n}}``, ``{"axis": {"point": p, "direction": d}}``,
        ``{"point": {"point": p}}`` or ``{"face": {"index": i}}``. A is moved only in the freedoms
        that they leave.
    zone_translation, zone_degrees : float, optional
        With a norm of the largest distance, the motions that ``zone`` is about: shifts up to this length, a
        hundredth of the larger diagonal if not given, and turns up to this angle.
    limit : float, optional
        With a norm of the largest distance, that which ``zone.passes`` is about.
    max_boxes : int
        Largest number of boxes of motions that are bounded.
    outliers : float
        Share of the samples, 0 to 0.95, that lie on nothing of B and are left out.
    robust : {"none", "trimmed", "tukey", "geman-mcclure"}, optional
        Rule by which samples far from B lose their weight; trimmed if there are outliers.
    faces_of_a, faces_of_b : sequence of int
        Faces by their indices, of models with surfaces: in the last fit the samples of those of A
        count, and those that are nearest to those of B. All if none are named.
    max_distance : float, optional
        Distance from B beyond which a sample does not count in the last fit.
    tolerance, relative_tolerance : float, optional
        Length of a step that ends the fit, in model units or as a fraction of the larger
        diagonal; 1e-9 of it if neither is given.
    max_steps : int
        Largest number of steps of the last fit.
    scale_units : bool
        Scales B to the unit of A where both state different ones; else that is an error.
    transform : Transform or array of shape (4, 4), optional
        Pose of A at first; of fits that are equally good, the one near it is taken.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` if ``cancel`` was set.
    """
    zone = _names.options(
        translation=zone_translation, degrees=zone_degrees, limit=limit, max_boxes=max_boxes
    )
    options = _names.options(
        samples=samples, sampling=sampling, start=start, norm=norm,
        pairs=[_plain(pair) for pair in pairs], datums=[_plain(datum) for datum in datums],
        zone=zone, outliers=outliers, robust=robust,
        faces_of_a=_plain(list(faces_of_a)), faces_of_b=_plain(list(faces_of_b)),
        max_distance=max_distance,
        tolerance=tolerance, relative_tolerance=relative_tolerance, max_steps=max_steps,
        scale_units=scale_units,
    )  # fmt: skip
    data = ask("best_fit", a, b, options, transform, progress, cancel)
    return fit_result(_names.snake(data))


def fit_result(data: dict[str, Any]) -> BestFit:
    """Make the result of a native dictionary in snake case."""
    left_out = data.pop("left_out")
    zone = data.pop("zone", None)
    if zone is not None:
        zone = Zone(**{**zone, "center": tuple(zone["center"])})
    points = np.asarray(left_out["points"], np.float64).reshape(-1, 3)
    poses = tuple(FitPose(motion(one["transform"]), one["rms"]) for one in data.pop("ambiguous"))
    return BestFit(
        transform=motion(data.pop("transform")),
        ambiguous=poses,
        left_out=LeftOut(points, left_out.get("beyond")),
        zone=zone,
        taken=tuple(data.pop("taken", ())),
        **data,
    )


def _plain(value: Any) -> Any:
    """Return a nested value with lists of numbers in place of arrays."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def motion(parts: dict[str, Any]) -> Transform:
    """Make the motion of a native dictionary."""
    x, y, z, w = parts["rotation"]
    a, b, c = parts["translation"]
    return Transform((x, y, z, w), (a, b, c))
