"""All pairs of bodies of one model or several."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from .._values import names as _names
from .. import _native
from .._errors import NurbsHausdorffError
from .._model import Model
from .._values.progress import Event, ProgressBar, reporter
from .._results.bodies.check import CheckResult, check_result
from .._sources import model


def check(
    *models: Any,
    names: Sequence[str] | None = None,
    below: float = 0.0,
    tolerance: float | None = None,
    relative_tolerance: float | None = None,
    rules: Mapping[str, Any] | None = None,
    max_cells: int | None = None,
    max_seconds: float | None = None,
    scale_units: bool = False,
    progress: ProgressBar | bool | None = None,
    cancel: Event | None = None,
) -> CheckResult:
    """Return how all bodies of these models lie to each other: which clash, touch or come near.

    Parameters
    ----------
    models : anything that `model` takes
        One assembly, or several models where they stand.
    names : sequence of str, optional
        The level above the names of the bodies of each model. Where there are several models, the
        names of their files without folders and endings if not given, or ``model 1`` by number.
    below : float
        Bodies nearer than this are ``"near"``; in model units, 0 or more.
    tolerance, relative_tolerance : float, optional
        Distance up to which bodies touch, and permitted width of intervals, in model units or as a
        fraction of the diagonal of all bodies; 1e-6 of it if neither is given.
    rules : mapping, optional
        What is meant, and what must be, as in a file of rules of the command:
        ``{"intended": [{"a": "**/bolt *", "b": "**/nut *"}]}``, ``must_touch`` likewise, and
        ``at_least`` with a ``distance``. In a name ``*`` is any text within a level, ``?`` any
        character, and a level ``**`` any number of levels.
    max_cells : int, optional
        Pairs of cells, for each pair of bodies, after which its interval so far is taken.
    max_seconds : float, optional
        Seconds after which pairs that are not searched yet are bounded once only.
    scale_units : bool
        Scales models to the unit of the first where they state different ones; else that is an
        error.
    progress : bool or tqdm, optional
    cancel : threading.Event, optional

    Raises
    ------
    NurbsHausdorffError
        With the code of what was refused, as ``OPTION_INVALID`` for a rule of no body;
        ``CANCELLED`` if ``cancel`` was set.
    """
    parts = [model(one) for one in models]
    if names is not None and len(names) != len(parts):
        message = f"found {len(names)} names, expected one of each of {len(parts)} models"
        raise NurbsHausdorffError("ARGUMENT_INVALID", message)
    levels = _levels(parts) if names is None else [str(name) for name in names]
    options = _names.options(
        below=below, tolerance=tolerance, relative_tolerance=relative_tolerance, rules=_rules(rules),
        max_cells=max_cells, max_seconds=max_seconds, scale_units=scale_units,
    )  # fmt: skip
    given = [(name, part._native) for name, part in zip(levels, parts, strict=True)]
    return check_result(_names.snake(_native.check(given, options, reporter(progress, cancel))))


def _levels(parts: Sequence[Model]) -> list[str | None]:
    """Return the names of files; none of one model."""
    if len(parts) == 1:
        return [None]

    def name(number: int, path: str) -> str:
        file = os.path.basename(path)
        return f"model {number}" if file == path and "." not in path else os.path.splitext(file)[0]

    return [name(number, part._path) for number, part in enumerate(parts, 1)]


def _rules(rules: Mapping[str, Any] | None) -> dict[str, Any] | None:
    if rules is None:
        return None
    try:
        return {_names.camel(name): [dict(rule) for rule in of] for name, of in rules.items()}
    except (AttributeError, TypeError, ValueError) as error:
        message = f"rules: {error}, expected lists of mappings by name, as intended"
        raise NurbsHausdorffError("ARGUMENT_INVALID", message) from error
