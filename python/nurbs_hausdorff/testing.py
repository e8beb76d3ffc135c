"""Assertions for tests of CAD programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ._model import Model
from ._results.bodies.check import PairState, pair_text, rule_text
from ._results.common import face as named


def assert_shapes_close(
    actual: Any, expected: Any, *, limit: float = 1e-3, allow_skipped: bool = False
) -> None:
    """Raise AssertionError unless every face of both models is proven within the limit, in model
    units, of the other model. The message names the faces, how far they are, and where.

    Files with faces that could not be read fail, unless ``allow_skipped``.
    """
    from . import diff, model

    models = [model(actual), model(expected)]
    _require_whole(models, allow_skipped)
    result = diff(*models, limit=limit)
    if result.state == "unchanged":
        return
    lines = [f"shapes are {result.state} at a limit of {limit!r}"]
    for state in ("changed", "undecided"):
        for name, faces in zip(("actual", "expected"), result.in_state(state), strict=True):
            for face in faces:
                at = face.witness.a if name == "actual" else face.witness.b
                interval = f"[{face.lower!r}, {face.upper!r}]"
                lines.append(f"{state}: {name} {named(at)}: {interval} at {at.point}")
    raise AssertionError("\n".join(lines))


def assert_no_clashes(
    *models: Any,
    names: Sequence[str] | None = None,
    below: float = 0.0,
    tolerance: float | None = None,
    rules: Mapping[str, Any] | None = None,
    scale_units: bool = False,
    allow_skipped: bool = False,
) -> None:
    """Raise AssertionError unless certainly no two bodies of these models clash, and all rules are
    kept: one assembly, or several models where they stand. The arguments are those of `check`. The
    message names the bodies, how deep they are in each other, and where.

    With ``below``, bodies that come nearer than it fail, too, unless they touch. Files with faces
    that could not be read fail, unless ``allow_skipped``.
    """
    from . import check, model

    parts = [model(one) for one in models]
    _require_whole(parts, allow_skipped)
    found = check(
        *parts, names=names, below=below, tolerance=tolerance, rules=rules, scale_units=scale_units
    )
    lines = []
    states: tuple[PairState, ...] = ("clash", "near", "undecided")
    for state in states:
        lines += [f"{state}: {pair_text(pair)}" for pair in found.in_state(state)]
    for rule in found.rules:
        lines.append(f"{'broken' if rule.broken else 'undecided'}: {rule_text(rule)}")
    if lines:
        counts = ((state, len(found.in_state(state))) for state in states)
        first = ", ".join(f"{count} {state}" for state, count in counts if count)
        first = first or f"{len(found.rules)} rules are not kept"
        raise AssertionError("\n".join([f"of {found.pair_count} pairs: {first}", *lines]))


def assert_same_assembly(
    actual: Any,
    expected: Any,
    *,
    limit: float = 1e-3,
    scale_units: bool = False,
    allow_skipped: bool = False,
) -> None:
    """Raise AssertionError unless every part of both assemblies is certainly within the limit, in
    model units, of one of the other assembly, in its place and under its name. The message says
    what became of the others: what moved, changed, was renamed, added or removed.

    Files with faces that could not be read fail, unless ``allow_skipped``.
    """
    from . import diff, model

    models = [model(actual), model(expected)]
    _require_whole(models, allow_skipped)
    found = diff(*models, limit=limit, scale_units=scale_units)
    if not found.parts:
        raise AssertionError("undecided: the parts of these models are not compared")
    others = [part for part in found.parts if part.state != "same"]
    if not others:
        return
    summary = found.parts_summary or f"the only part is {others[0].state}"
    lines = [f"{summary}, at a limit of {limit!r}"]
    for part in others:
        interval = "" if part.lower is None else f": [{part.lower!r}, {part.upper!r}]"
        lines.append(f"{part.state}: {part.name_of_a or part.name_of_b}{interval}")
    raise AssertionError("\n".join(lines))


def _require_whole(models: Sequence[Model], allow_skipped: bool) -> None:
    skipped = sum(len(one.report.skipped) for one in models)
    if skipped and not allow_skipped:
        raise AssertionError(f"undecided: {skipped} faces were left out in reading")
