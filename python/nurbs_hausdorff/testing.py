"""Assertions for tests of CAD programs."""

from __future__ import annotations

from typing import Any

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
    skipped = sum(len(one.report.skipped) for one in models)
    if skipped and not allow_skipped:
        raise AssertionError(f"undecided: {skipped} faces were left out in reading")
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
