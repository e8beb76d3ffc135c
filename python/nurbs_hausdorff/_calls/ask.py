"""Questions about two models."""

from __future__ import annotations

from typing import Any, Literal

from numpy.typing import ArrayLike

from .. import _native
from .._sources import model
from .._values import transform as _transform
from .._values.progress import Event, ProgressBar, reporter
from .._values.transform import Transform

Query = Literal[
    "best_fit", "clearance", "deviation_maps", "diff", "distance", "field", "gaps", "overlap",
    "score", "statistics",
]  # fmt: skip


def ask(
    query: Query,
    a: Any,
    b: Any,
    options: dict[str, Any],
    transform: Transform | ArrayLike | None,
    progress: ProgressBar | bool | None,
    cancel: Event | None,
) -> dict[str, Any]:
    """Return the native answer to a question about A, moved by the transform, and B."""
    return _native.ask(
        query, model(a)._native, model(b)._native, options,
        _transform.native(transform), reporter(progress, cancel),
    )  # fmt: skip
