"""The position of one model that fits another best."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _transform
from ._errors import NurbsHausdorffError
from ._measure import Sampling, field
from ._progress import Event, ProgressBar, Share, reporter
from ._results.field import Field
from ._sources import model
from ._transform import Transform

#: The damping of the first step, relative to unit weights, and how it changes.
FIRST_DAMPING = 1e-3
DAMPING_FACTOR = 10.0

#: The smallest damping: directions from feet are off by 1e-8, and where the samples determine
#: nothing, a step is that error over the damping.
MIN_DAMPING = 1e-6

#: The part of the mean square by which a step has to lower it: above its rounding.
MIN_GAIN = 1e-12

#: The length of a step that ends the fit, as a fraction of the diagonal: the accuracy of the
#: distances.
DEFAULT_RELATIVE_TOLERANCE = 1e-9

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class BestFit:
    """The position of A that fits B best, near the one at first.

    Attributes
    ----------
    transform : Transform
        Moves A there.
    rms, rms_before : float
        Root mean square of the samples' distances, weighted by area: estimates.
    steps : int
        Number of steps.
    converged : bool
        Whether a step was below the tolerance or had nothing to gain.
    """

    transform: Transform
    rms: float
    rms_before: float
    steps: int
    converged: bool


def best_fit(
    a: Any,
    b: Any,
    *,
    samples: int = 16,
    sampling: Sampling | None = None,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    max_steps: int = 100,
    scale_units: bool = False,
    transform: Transform | ArrayLike | None = None,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> BestFit:
    """Return the position of A, near its first one, at which the mean square of its samples'
    distances from B is least.

    Damped Gauss-Newton steps (Levenberg-Marquardt) over a shift and a rotation vector.

    Parameters
    ----------
    a, b : anything that `model` takes
    samples, sampling : optional
        Grid of samples of every surface of A, as for `field`.
    tolerance, relative_tolerance : float, optional
        Length of a step that ends the fit, in model units or as a fraction of the larger
        diagonal; 1e-9 of it if neither is given.
    max_steps : int
        Largest number of steps.
    scale_units : bool
        Scales B to the unit of A where both state different ones; else that is an error.
    transform : Transform or array of shape (4, 4), optional
        Position of A at first.
    progress : bool or tqdm, optional
        Shows the steps as parts of the largest number of them, and the whole at the end.
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused; ``CANCELLED`` if ``cancel`` was set.
    """
    if tolerance is not None and relative_tolerance is not None:
        raise NurbsHausdorffError(
            "OPTION_INVALID", "found both tolerance and relative_tolerance, expected one of them"
        )
    a, b = model(a), model(b)
    report = reporter(progress, None)
    # The first position is evaluated too.
    share = 1.0 / (max_steps + 1)

    def evaluate(motion: Transform, step: int) -> tuple[float, _LeastSquares]:
        bar = None if report is None else Share(report, step * share, share)
        found = field(
            a, b, samples=samples, sampling=sampling, scale_units=scale_units,
            transform=motion, progress=bar, cancel=cancel,
        )  # fmt: skip
        return found.diagonal, _LeastSquares(found)

    position = Transform(*_transform.native(transform))
    diagonal, at = evaluate(position, 0)
    fraction = DEFAULT_RELATIVE_TOLERANCE if relative_tolerance is None else relative_tolerance
    smallest = fraction * diagonal if tolerance is None else tolerance
    before, damping = at.mean_square, FIRST_DAMPING
    steps, converged = max_steps, False
    for step in range(max_steps):
        shift, vector, gain = at.step(damping)
        length = float(np.linalg.norm(shift) + at.extent * np.linalg.norm(vector))
        if length <= smallest or gain <= MIN_GAIN * at.mean_square:
            steps, converged = step, True
            break
        moved = _followed(position, vector, at.center, shift)
        _, there = evaluate(moved, step + 1)
        if there.mean_square < at.mean_square:
            position, at = moved, there
            damping = max(damping / DAMPING_FACTOR, MIN_DAMPING)
        else:
            damping *= DAMPING_FACTOR
    if report is not None:
        report(1.0, None)
    return BestFit(position, at.mean_square**0.5, before**0.5, steps, converged)


class _LeastSquares:
    """The mean of the squared distances at a position, and its linearisation in a shift s and a
    rotation vector v about the samples' centre c.

    A sample p with the foot q has the distance r = |p - q|, which changes by
    u . (s + v x (p - c)) with the unit vector u = (p - q) / r. That is exact to first order, as
    the foot moves orthogonally to u.
    """

    def __init__(self, samples: Field) -> None:
        points, feet = samples.flat("points"), samples.flat("feet")
        areas = samples.flat("areas")
        weights = areas / (areas.sum() or 1.0)
        self.center = weights @ points
        arms = points - self.center
        lengths = np.linalg.norm(arms, axis=1)
        #: The root mean square of the distances from the centre: the unit of angles.
        self.radius = float(np.sqrt(weights @ lengths**2)) or 1.0
        self.extent = float(lengths.max(initial=0.0))
        offsets = points - feet
        distances = np.linalg.norm(offsets, axis=1)
        # Samples at the distance 0 have no direction; they add nothing.
        directions = offsets / np.where(distances > 0.0, distances, 1.0)[:, None]
        rows = np.hstack([directions, np.cross(arms / self.radius, directions)])
        self.mean_square = float(weights @ distances**2)
        self._matrix: Floats = rows.T @ (weights[:, None] * rows)
        self._gradient: Floats = rows.T @ (weights * distances)

    def step(self, damping: float) -> tuple[Floats, Floats, float]:
        """Return the shift, the rotation vector and the decrease of the mean square that the
        gradient alone predicts."""
        damped = self._matrix + damping * np.eye(6)
        step: Floats = np.asarray(np.linalg.solve(damped, -self._gradient), np.float64)
        return step[:3], step[3:] / self.radius, float(-step @ self._gradient)


def _followed(position: Transform, vector: Floats, center: Floats, shift: Floats) -> Transform:
    """Return a motion followed by a rotation about a centre and a shift."""
    angle = float(np.linalg.norm(vector))
    # sin(angle / 2) / angle, which is 1/2 in the limit.
    factor = np.sin(angle / 2) / angle if angle > 0.0 else 0.5
    x, y, z = (factor * vector).tolist()
    turn = Transform((x, y, z, float(np.cos(angle / 2)))).matrix()
    matrix = turn @ position.matrix()
    relative = np.array(position.translation) - center
    matrix[:3, 3] = turn[:3, :3] @ relative + center + shift
    return Transform.from_matrix(matrix)
