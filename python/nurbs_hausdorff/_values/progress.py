"""Progress and cancellation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol


class ProgressBar(Protocol):
    """The interface of ``tqdm`` that is used: a total, and updates by parts of it."""

    total: Any

    def update(self, n: float = ...) -> Any:
        """Add a part of the total."""


class Event(Protocol):
    """The interface of ``threading.Event`` that is used."""

    def is_set(self) -> bool:
        """Return whether to stop."""


#: Digits of an interval beside a bar: rounded, to be read only.
DIGITS = 6


def reporter(
    progress: ProgressBar | bool | None, cancel: Event | None
) -> Callable[[float, tuple[float, float] | None], bool] | None:
    """Return the function that the native half calls about every 15 ms."""
    if progress is True:
        from tqdm.auto import tqdm

        progress = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}{postfix}")
    bar: Any = None if progress is False else progress
    if bar is None and cancel is None:
        return None
    total = 1.0 if bar is None or bar.total is None else float(bar.total)
    done = 0.0

    def report(fraction: float, interval: tuple[float, float] | None) -> bool:
        nonlocal done
        if bar is not None:
            if interval is not None and hasattr(bar, "set_postfix"):
                lower, upper = interval
                bar.set_postfix(
                    lower=f"{lower:.{DIGITS}g}", upper=f"{upper:.{DIGITS}g}", refresh=False
                )
            bar.update((fraction - done) * total)
            done = fraction
        return cancel is not None and cancel.is_set()

    return report
