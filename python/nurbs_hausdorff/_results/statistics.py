"""Statistics of distances, as intervals that contain them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .._values.interval import Interval
from .common import Audit, Seconds, table


@dataclass(frozen=True)
class Beyond:
    """Part of A that is farther than a limit, between 0 and 1."""

    limit: float
    part: Interval


@dataclass(frozen=True)
class CertifiedStatistics:
    """Statistics of the distances from the points of A to B; every number is in its interval.

    Attributes
    ----------
    over : {"count", "area"}
        What they are over: the points of a cloud, each once, or the area.
    total : Interval
        The number of points, or the area in squares of the model unit.
    mean, rms : Interval
        The mean distance and the root of the mean square.
    percentiles : dict of float to Interval
        For each part of A the least distance that it is within.
    beyond : Beyond or None
        With ``limit``, the part of A that is farther than it.
    converged : bool
        Whether all intervals are as narrow as requested. A percentile at which distances jump stays
        as wide as the jump.
    audit : Audit
        Parts whose bounds were compared with certified distances of their points.
    notice : str or None
        A bound that the audit refuted: a fault of the library. The intervals are valid.
    """

    over: Literal["count", "area"]
    total: Interval
    mean: Interval
    rms: Interval
    percentiles: dict[float, Interval]
    converged: bool
    tolerance: float
    diagonal: float
    cells: int
    audit: Audit
    seconds: Seconds
    beyond: Beyond | None = None
    unit: float | None = None
    notice: str | None = None
    hint: str | None = None

    def _repr_html_(self) -> str:
        named = [("mean", self.mean), ("rms", self.rms)]
        named += [(f"part {part!r} within", found) for part, found in self.percentiles.items()]
        if self.beyond is not None:
            named.append(("part beyond the limit", self.beyond.part))
        return table([(name, f"{found.lower!r} to {found.upper!r}") for name, found in named])


def statistics_result(data: dict[str, Any]) -> CertifiedStatistics:
    """Make the result of a native dictionary in snake case."""
    for name in ("total", "mean", "rms"):
        data[name] = Interval(**data[name])
    data["percentiles"] = {
        found["part"]: Interval(**found["distance"]) for found in data["percentiles"]
    }
    beyond = data.pop("beyond", None)
    data["audit"] = Audit(**data["audit"])
    data["seconds"] = Seconds(**data["seconds"])
    if beyond is not None:
        beyond = Beyond(limit=beyond["limit"], part=Interval(**beyond["part"]))
    return CertifiedStatistics(**data, beyond=beyond)
