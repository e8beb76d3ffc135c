"""The states of faces at a limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .common import Seconds, Witness, place, table, witness

State = Literal["unchanged", "undecided", "changed"]


@dataclass(frozen=True)
class FaceDifference:
    """A face with the interval of its distance from the other model, and its state.

    Attributes
    ----------
    face : int
        Index of the face.
    state : {"unchanged", "undecided", "changed"}
        Whether the interval is up to the limit, on both sides of it, or beyond it.
    lower, upper : float
        Interval that contains the largest distance of the face's points from the other model,
        in model units; the search ends when it decides the state.
    gap : float
        Distance of the face and the other model from their sources together, in model units.
    with_gaps : {"unchanged", "undecided", "changed"}
        State that holds for the sources too.
    witness : Witness
        The face's farthest point that was found, and the closest point of the other model.
    cells : int
        Number of cells examined.
    """

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
    hint: str | None = None

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
                    at = face.witness.a if name == "A" else face.witness.b
                    rows.append((f"{state} in {name}", f"{interval}, {place(at)}"))
        return table(rows)


def diff_result(data: dict[str, Any]) -> DiffResult:
    """Make the result of a native dictionary in snake case."""
    for name in ("faces_of_a", "faces_of_b"):
        data[name] = tuple(
            FaceDifference(**{**face, "witness": witness(face["witness"])}) for face in data[name]
        )
    data["seconds"] = Seconds(**data["seconds"])
    return DiffResult(**data)
