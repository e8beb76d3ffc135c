"""Distances, as intervals that contain them."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

from .common import Audit, Seconds, Stop, Witness, place, table, witness
from .field import Field, Statistics, field_parts


@dataclass(frozen=True)
class WithGaps:
    """Interval that contains the distance of the sources of both models, which differ from the
    models by up to their gaps, and the verdict that holds for them."""

    lower: float
    upper: float
    within: bool | None = None


@dataclass(frozen=True)
class DistanceResult:
    """Interval [lower, upper] that contains the distance.

    Attributes
    ----------
    lower, upper : float
        The bounds.
    converged : bool
        Whether the interval is as narrow as requested, or the limit is decided.
    witness : Witness
        A point of A and one of B; with method ``certified`` their distance is in the interval.
    within : bool or None
        With ``limit``, whether the distance is at most the limit; None if that is undecided.
    stop : str or None
        Reason for which a certified search ended.
    tolerance, min_tolerance : float or None
        Width requested, and the least that the rounding of the coordinates allows.
    with_gaps : WithGaps
        The interval for the sources of the models.
    gap, gap_proven : float, bool
        Bound on the distance of the models from their sources, and whether it is proven.
    audit : Audit or None
        Upper bounds that were checked while the search ran.
    forward, reverse : DistanceResult or None
        Both directions of a symmetric distance.
    deviations : Field or None
        The samples, with ``deviations=True`` in one direction.
    details : dict
        Figures of the methods ``iteration`` and ``hierarchy``.
    """

    method: str
    lower: float
    upper: float
    converged: bool
    computed: float
    witness: Witness
    with_gaps: WithGaps
    gap: float
    gap_proven: bool
    diagonal: float
    backend: str
    seconds: Seconds
    patches: dict[str, int]
    unit: float | None = None
    hint: str | None = None
    within: bool | None = None
    stop: Stop | None = None
    tolerance: float | None = None
    min_tolerance: float | None = None
    cells: int | None = None
    cpu_cells: int | None = None
    levels: int | None = None
    audit: Audit | None = None
    adapter: str | None = None
    notice: str | None = None
    statistics: Statistics | None = None
    forward: DistanceResult | None = None
    reverse: DistanceResult | None = None
    deviations: Field | None = dataclasses.field(default=None, repr=False, compare=False)
    details: dict[str, Any] = dataclasses.field(default_factory=dict)

    def _repr_html_(self) -> str:
        rows = [
            ("distance", f"{self.lower!r} to {self.upper!r}"),
            ("converged", f"{self.converged}" + (f" ({self.stop})" if self.stop else "")),
            ("on A", place(self.witness.a)),
            ("on B", place(self.witness.b)),
        ]
        if self.within is not None:
            rows.insert(1, ("within the limit", f"{self.within}"))
        return table(rows)


#: Figures of the methods that replicate papers.
_DETAILS = ("bounds", "samples", "statuses", "grid", "pairs")


def distance_result(data: dict[str, Any], parts: list[dict[str, Any]]) -> DistanceResult:
    """Make the result of a native dictionary in snake case."""
    data["witness"] = witness(data["witness"])
    data["with_gaps"] = WithGaps(**data["with_gaps"])
    data["seconds"] = Seconds(**data["seconds"])
    if data.get("audit") is not None:
        data["audit"] = Audit(**data["audit"])
    data["details"] = {name: data.pop(name) for name in _DETAILS if name in data}
    statistics = data.pop("statistics", None)
    data["statistics"] = None if statistics is None else Statistics(**statistics)
    for direction in ("forward", "reverse"):
        if data.get(direction) is not None:
            data[direction] = distance_result(data[direction], data[direction].pop("deviations", []))
    data["deviations"] = (
        Field(data["diagonal"], data["statistics"], field_parts(parts)) if parts else None
    )
    return DistanceResult(**data)


