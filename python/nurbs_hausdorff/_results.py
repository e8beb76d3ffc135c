"""Results, as frozen dataclasses. Lengths are in model units."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from html import escape
from typing import Any, Literal

from ._field import Field, field_parts

State = Literal["unchanged", "undecided", "changed"]
Stop = Literal["converged", "cells", "time", "precision", "cancelled"]
Point = tuple[float, float, float]


@dataclass(frozen=True)
class SurfacePoint:
    """A point of a model: the index of its face and the face's name, its parameters u and v, and
    its coordinates."""

    face: int
    u: float
    v: float
    point: Point
    face_name: str | None = None


@dataclass(frozen=True)
class Witness:
    """A point of each model, whose distance is about the one measured."""

    a: SurfacePoint
    b: SurfacePoint


@dataclass(frozen=True)
class WithGaps:
    """Interval that contains the distance of the sources of both models, which differ from the
    models by up to their gaps, and the verdict that holds for them."""

    lower: float
    upper: float
    within: bool | None = None


@dataclass(frozen=True)
class Seconds:
    """Seconds of preparing, compiling for a GPU, and solving."""

    prepare: float
    solve: float
    compile: float = 0.0


@dataclass(frozen=True)
class Statistics:
    """Estimates over the area of the sampled model, without error bounds; ``area`` is in squares
    of the model unit, all others are lengths."""

    estimate: bool
    area: float
    mean: float
    rms: float
    signed_mean: float
    median: float
    percentile_95: float
    percentile_99: float


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
    within: bool | None = None
    stop: Stop | None = None
    tolerance: float | None = None
    min_tolerance: float | None = None
    cells: int | None = None
    cpu_cells: int | None = None
    levels: int | None = None
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
            ("on A", _place(self.witness.a)),
            ("on B", _place(self.witness.b)),
        ]
        if self.within is not None:
            rows.insert(1, ("within the limit", f"{self.within}"))
        return _table(rows)


@dataclass(frozen=True)
class FaceDifference:
    """A face with the interval of its distance from the other model, and its state."""

    face: int
    state: State
    lower: float
    upper: float
    gap: float
    with_gaps: State
    witness: Witness
    cells: int


@dataclass(frozen=True)
class DiffResult:
    """The states of both models' faces at a limit.

    Attributes
    ----------
    state : {"unchanged", "undecided", "changed"}
        State of both models together.
    faces_of_a, faces_of_b : tuple of FaceDifference
        Every face, in order, compared with the other model.
    """

    state: State
    limit: float
    gap_proven: bool
    with_gaps: State
    faces_of_a: tuple[FaceDifference, ...]
    faces_of_b: tuple[FaceDifference, ...]
    seconds: Seconds
    diagonal: float
    gap: float
    unit: float | None = None

    @property
    def changed(self) -> tuple[tuple[FaceDifference, ...], tuple[FaceDifference, ...]]:
        """The changed faces of A and those of B, the farthest first."""
        return self.in_state("changed")

    @property
    def undecided(self) -> tuple[tuple[FaceDifference, ...], tuple[FaceDifference, ...]]:
        """The undecided faces of A and those of B, the farthest first."""
        return self.in_state("undecided")

    def in_state(
        self, state: State
    ) -> tuple[tuple[FaceDifference, ...], tuple[FaceDifference, ...]]:
        """Return the faces of A and those of B in a state, the farthest first."""

        def found(faces: tuple[FaceDifference, ...]) -> tuple[FaceDifference, ...]:
            chosen = (face for face in faces if face.state == state)
            return tuple(sorted(chosen, key=lambda face: -face.lower))

        return found(self.faces_of_a), found(self.faces_of_b)

    def _repr_html_(self) -> str:
        rows = [("models", f"{self.state} at a limit of {self.limit!r}")]
        for state in ("changed", "undecided"):
            for name, faces in zip("AB", self.in_state(state), strict=True):
                for face in faces:
                    interval = f"{face.lower!r} to {face.upper!r}"
                    place = face.witness.a if name == "A" else face.witness.b
                    rows.append((f"{state} in {name}", f"{interval}, {_place(place)}"))
        return _table(rows)


def _place(at: SurfacePoint) -> str:
    name = "" if at.face_name is None else f" ({at.face_name})"
    return f"face {at.face}{name} at {at.point}"


def _table(rows: list[tuple[str, str]]) -> str:
    cells = (f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in rows)
    return f"<table>{''.join(cells)}</table>"


def _witness(data: dict[str, Any]) -> Witness:
    def at(side: dict[str, Any]) -> SurfacePoint:
        return SurfacePoint(**{**side, "point": tuple(side["point"])})

    return Witness(at(data["a"]), at(data["b"]))


#: Figures of the methods that replicate papers.
_DETAILS = ("bounds", "samples", "statuses", "grid", "pairs")


def distance_result(data: dict[str, Any], parts: list[dict[str, Any]]) -> DistanceResult:
    """Make the result of a native dictionary in snake case."""
    data["witness"] = _witness(data["witness"])
    data["with_gaps"] = WithGaps(**data["with_gaps"])
    data["seconds"] = Seconds(**data["seconds"])
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


def diff_result(data: dict[str, Any]) -> DiffResult:
    """Make the result of a native dictionary in snake case."""
    for name in ("faces_of_a", "faces_of_b"):
        data[name] = tuple(
            FaceDifference(**{**face, "witness": _witness(face["witness"])}) for face in data[name]
        )
    data["seconds"] = Seconds(**data["seconds"])
    return DiffResult(**data)
