"""Least distances, as intervals that contain them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ..common import Point, Seconds, Stop, Witness, place, table, witness


OverlapUnknown = Literal[
    "a-open", "b-open", "both-open", "too-large", "side", "cracks", "limit", "budget", "precision"
]


@dataclass(frozen=True)
class Overlap:
    """Whether two solids share space.

    Attributes
    ----------
    kind : {"none", "touching", "intersecting", "contained"}
        ``touching`` are boundaries nearer than the tolerance without a point inside both found;
        ``contained`` is a shell of one inside the other, the boundaries apart.
    inside_both : tuple of float or None
        A point that is certainly inside both.
    """

    kind: Literal["none", "touching", "intersecting", "contained"]
    inside_both: Point | None = None


@dataclass(frozen=True)
class ClearanceWithGaps:
    """Interval that contains the least distance of the sources of both models, which differ from
    the models by up to their gaps, and the verdict that holds for them."""

    lower: float
    upper: float
    at_least: bool | None = None


@dataclass(frozen=True)
class ClearanceResult:
    """Interval [lower, upper] that contains the least distance of the boundaries.

    Attributes
    ----------
    lower, upper : float
        The bounds.
    converged : bool
        Whether the interval is as narrow as requested, or the limit is decided.
    stop : str
        Reason for which the search ended.
    at_least : bool or None
        With ``limit``, whether the clearance is at least the limit; None if that is undecided.
        Solids that overlap have none.
    overlap : Overlap or None
        Whether the solids overlap; None where ``overlap_unknown`` says why.
    overlap_unknown : str or None
        Reason for which nothing is stated of an overlap: ``a-open``, ``b-open``, ``both-open``,
        ``too-large``, ``side``, ``cracks``, ``limit``, ``budget`` or ``precision``.
    witness : Witness
        A point of each model, whose distance is ``upper`` up to rounding.
    with_gaps : ClearanceWithGaps
        The interval for the sources of the models.
    """

    lower: float
    upper: float
    converged: bool
    stop: Stop
    tolerance: float
    min_tolerance: float
    witness: Witness
    diagonal: float
    gap: float
    gap_proven: bool
    with_gaps: ClearanceWithGaps
    cells: int
    refuted: int
    seconds: Seconds
    at_least: bool | None = None
    overlap: Overlap | None = None
    overlap_unknown: OverlapUnknown | None = None
    unit: float | None = None
    hint: str | None = None

    def _repr_html_(self) -> str:
        rows = [
            ("clearance", f"{self.lower!r} to {self.upper!r}"),
            ("on A", place(self.witness.a)),
            ("on B", place(self.witness.b)),
            ("overlap", f"unknown: {self.overlap_unknown}" if self.overlap is None else self.overlap.kind),
        ]
        return table(rows)


@dataclass(frozen=True)
class FaceGap:
    """Two faces that come near each other, with an interval of their least distance and the
    points that are nearest."""

    lower: float
    upper: float
    converged: bool
    witness: Witness


@dataclass(frozen=True)
class GapsResult:
    """Pairs of faces that come nearer to each other than a distance.

    Attributes
    ----------
    below : float
        The distance.
    pairs : tuple of FaceGap
        The nearest first. Pairs that are not listed are farther apart than ``below``.
    complete : bool
        Whether all faces were compared.
    """

    below: float
    tolerance: float
    pairs: tuple[FaceGap, ...]
    complete: bool
    diagonal: float
    gap: float
    gap_proven: bool
    seconds: Seconds
    unit: float | None = None
    hint: str | None = None

    def _repr_html_(self) -> str:
        rows = [("pairs below", f"{len(self.pairs)} below {self.below!r}")]
        for pair in self.pairs:
            places = f"{place(pair.witness.a)}, {place(pair.witness.b)}"
            rows.append((f"{pair.lower!r} to {pair.upper!r}", places))
        return table(rows)


def clearance_result(data: dict[str, Any]) -> ClearanceResult:
    """Make the result of a native dictionary in snake case."""
    overlap = data.pop("overlap", None)
    if overlap is not None:
        point = overlap.get("inside_both")
        overlap = Overlap(overlap["kind"], None if point is None else tuple(point))
    data["witness"] = witness(data["witness"])
    data["with_gaps"] = ClearanceWithGaps(**data["with_gaps"])
    data["seconds"] = Seconds(**data["seconds"])
    return ClearanceResult(**data, overlap=overlap)


def gaps_result(data: dict[str, Any]) -> GapsResult:
    """Make the result of a native dictionary in snake case."""
    pairs = (FaceGap(**{**pair, "witness": witness(pair["witness"])}) for pair in data["pairs"])
    data["pairs"] = tuple(pairs)
    data["seconds"] = Seconds(**data["seconds"])
    return GapsResult(**data)
