"""The pairs that are measured: names, models and, where a formula gives it, the true distance."""

from dataclasses import dataclass

from nurbs import Surface


@dataclass(frozen=True)
class Pair:
    """Two models; the distance measured is the directed one from `a` to `b`."""

    name: str
    what: str
    a: list[Surface]
    b: list[Surface]
    truth: float | None = None
