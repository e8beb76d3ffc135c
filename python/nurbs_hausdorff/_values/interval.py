"""Intervals that contain numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

_MAX_DECIMALS = 17


@dataclass(frozen=True, eq=False)
class Interval:
    """Interval that contains a number: ``lower <= number <= upper``.

    Comparisons with a number or another interval are None where the intervals do not decide them; ``==`` with a
    number too, and with another interval it compares the ends.
    ``lower, upper = interval`` unpacks it.
    """

    lower: float
    upper: float

    def __iter__(self) -> Iterator[float]:
        yield self.lower
        yield self.upper

    def __contains__(self, number: float) -> bool:
        return self.contains(number)

    @property
    def middle(self) -> float:
        """Number in the middle."""
        return 0.5 * self.lower + 0.5 * self.upper

    @property
    def width(self) -> float:
        """Upper bound on the width."""
        width = self.upper - self.lower
        return width if width == 0.0 else math.nextafter(width, math.inf)

    def contains(self, number: float) -> bool:
        """Return whether a number is in the interval."""
        return self.lower <= number <= self.upper

    def __eq__(self, other: object) -> bool | None:  # type: ignore[override]
        # Equal to a number: None where it is one of several. Intervals are equal by their ends.
        if isinstance(other, Interval):
            return (self.lower, self.upper) == (other.lower, other.upper)
        if not isinstance(other, (int, float)):
            return NotImplemented
        if self.lower == self.upper:
            return self.lower == other
        return None if self.contains(other) else False

    def __hash__(self) -> int:
        return hash((self.lower, self.upper))

    def __lt__(self, other: Interval | float) -> bool | None:
        low, high = _ends(other)
        return True if self.upper < low else False if self.lower >= high else None

    def __le__(self, other: Interval | float) -> bool | None:
        low, high = _ends(other)
        return True if self.upper <= low else False if self.lower > high else None

    def __gt__(self, other: Interval | float) -> bool | None:
        low, high = _ends(other)
        return True if self.lower > high else False if self.upper <= low else None

    def __ge__(self, other: Interval | float) -> bool | None:
        low, high = _ends(other)
        return True if self.lower >= high else False if self.upper < low else None

    def __repr__(self) -> str:
        """Middle with the digits that are certain, and radius, rounded up: ``360.00000 ± 2e-7``."""
        middle = self.middle
        radius = max(middle - self.lower, self.upper - middle)
        if not math.isfinite(radius):
            return "unknown"
        if radius == 0.0:
            return repr(middle)
        decimals = min(max(1 - math.floor(math.log10(radius)), 0), _MAX_DECIMALS)
        written = f"{middle:.{decimals}f}"
        radius = math.nextafter(radius, math.inf) + abs(float(written) - middle)
        exponent = math.floor(math.log10(radius))
        digit = math.ceil(radius / 10.0**exponent * (1.0 + 1e-15))
        if digit == 10:
            digit, exponent = 1, exponent + 1
        return f"{written} ± {digit}e{exponent}"


def _ends(other: Interval | float) -> tuple[float, float]:
    return (other.lower, other.upper) if isinstance(other, Interval) else (other, other)
