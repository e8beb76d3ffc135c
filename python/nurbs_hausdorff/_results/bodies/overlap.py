"""Volumes that two solids have in common, as intervals that contain them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ..._values.interval import Interval
from ..common import Seconds, Stop, table

VolumesUnknown = Literal[
    "a-open", "b-open", "both-open", "too-large", "a-volume", "b-volume", "a-bodies", "b-bodies",
    "a-crossed", "b-crossed", "refuted",
]


@dataclass(frozen=True)
class OverlapVolumes:
    """Volumes of A ∩ B, A ∪ B, A without B and B without A."""

    intersection: Interval
    union: Interval
    only_a: Interval
    only_b: Interval


@dataclass(frozen=True)
class OverlapResult:
    """Volumes that two solids have in common and apart; every number is in its interval.

    Attributes
    ----------
    volumes : OverlapVolumes or None
        None where ``volumes_unknown`` says why.
    ratio : Interval or None
        The volume of the intersection over that of the union.
    converged : bool
        Whether the interval of the intersection is as narrow as requested.
    tolerance : float
        Its permitted width, as a fraction of the union's volume.
    volume_of_gap : float or None
        About the volume between the faces and their sources; an estimate, and no part of the
        intervals.
    """

    converged: bool
    stop: Stop
    tolerance: float
    gap: float
    gap_proven: bool
    cells: int
    seconds: Seconds
    volumes: OverlapVolumes | None = None
    ratio: Interval | None = None
    volumes_unknown: VolumesUnknown | None = None
    volume_of_gap: float | None = None
    unit: float | None = None
    hint: str | None = None

    def _repr_html_(self) -> str:
        if self.volumes is None:
            return table([("volumes", f"unknown: {self.volumes_unknown}")])
        rows = [("ratio", repr(self.ratio)), ("in common", repr(self.volumes.intersection))]
        rows += [("union", repr(self.volumes.union)), ("only A", repr(self.volumes.only_a))]
        return table([*rows, ("only B", repr(self.volumes.only_b))])


def overlap_result(data: dict[str, Any]) -> OverlapResult:
    """Make the result of a native dictionary in snake case."""
    volumes, ratio = data.pop("volumes", None), data.pop("ratio", None)
    data["seconds"] = Seconds(**data["seconds"])
    return OverlapResult(
        **data,
        volumes=None
        if volumes is None
        else OverlapVolumes(**{name: Interval(**found) for name, found in volumes.items()}),
        ratio=None if ratio is None else Interval(**ratio),
    )
