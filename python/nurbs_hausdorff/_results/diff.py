"""The states of faces at a limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .._values.interval import Interval
from .common import Seconds, Witness, place, table, witness

State = Literal["unchanged", "undecided", "changed"]


@dataclass(frozen=True)
class FaceCounterpart:
    """The face of the other model that a changed round face is taken to have become.

    Both changed and lie on a sphere, a cylinder or a torus, and of all such faces the box of each
    is the nearest to that of the other. Which two belong together is a guess; what is said of the
    two is certain as in :class:`FaceForm`.

    Attributes
    ----------
    face : int
        Index of the face in the other model.
    change : {"resized", "moved", "resizedAndMoved"}
        Whether the radii certainly differ by more than the limit, and whether the centre or the axis
        is farther than it from the other one.
    radius, other_radius : Interval
        The radii of this face and of the other one, in one unit; of tori those of the tubes.
    shift : tuple of float
        The way from A's centre, after the transform, to that of B; of cylinders across the axis.
    """

    face: int
    change: Literal["resized", "moved", "resizedAndMoved"]
    radius: Interval
    other_radius: Interval
    shift: tuple[float, float, float]


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
    counterpart : FaceCounterpart or None
        The face of the other model that a changed round face became.
    """

    face: int
    state: State
    lower: float
    upper: float
    gap: float
    with_gaps: State
    witness: Witness
    cells: int
    counterpart: FaceCounterpart | None = None


PartState = Literal[
    "same", "renamed", "moved", "mirrored", "changed", "movedAndChanged", "added", "removed", "undecided"
]


@dataclass(frozen=True)
class PartMotion:
    """A turn about an axis through the origin, then a move.

    Attributes
    ----------
    translation : tuple of float
        The move after the turn.
    axis : tuple of float
        Direction of the axis, of length 1.
    angle : float
        Angle in degrees, 0 to 180.
    shift : tuple of float
        The displacement of the centre of the part's box.
    """

    translation: tuple[float, float, float]
    axis: tuple[float, float, float]
    angle: float
    shift: tuple[float, float, float]


@dataclass(frozen=True)
class PartFaces:
    """The faces of a part that certainly changed, by their indices in the models."""

    of_a: tuple[int, ...]
    of_b: tuple[int, ...]


@dataclass(frozen=True)
class PartDifference:
    """What became of a part.

    Attributes
    ----------
    name_of_a, name_of_b : str or None
        Names in both models; None where it is in one model only.
    state : str
        "same", "moved" and "mirrored" are proven to the limit.
    motion : PartMotion or None
        The motion of parts that moved or are mirrored, of these after the change of the sign of x.
    lower, upper : float or None
        Interval of the Hausdorff distance after the motion.
    faces : PartFaces
        The faces that changed.
    """

    name_of_a: str | None
    name_of_b: str | None
    state: PartState
    motion: PartMotion | None
    lower: float | None
    upper: float | None
    faces: PartFaces


@dataclass(frozen=True)
class DiffResult:
    """The states of both models' faces at a limit.

    Attributes
    ----------
    state : {"unchanged", "undecided", "changed"}
        State of both models together.
    faces_of_a, faces_of_b : tuple of FaceDifference
        Every face, in order, compared with the other model.
    parts : tuple of PartDifference
        What became of each body: what moved, changed, was added or removed.
    parts_unknown : {"budget", "too-many"} or None
        Reason why the parts were not compared: the time was spent before, or a model has more than 2,000
        bodies.
    parts_summary : str or None
        That in words, ``3 of 41 parts changed: bracket (2 faces, at most 0.350 mm), ...``; None of
        two models of one part.
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
    parts: tuple[PartDifference, ...] = ()
    parts_unknown: str | None = None
    parts_summary: str | None = None
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
        if self.parts_summary is not None:
            rows.append(("parts", self.parts_summary))
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
        data[name] = tuple(_face(face) for face in data[name])
    data["parts"] = tuple(_part(part) for part in data["parts"])
    data["seconds"] = Seconds(**data["seconds"])
    return DiffResult(**data)


def _face(data: dict[str, Any]) -> FaceDifference:
    found = data.pop("counterpart", None)
    if found is not None:
        radii = {name: Interval(**found[name]) for name in ("radius", "other_radius")}
        found = FaceCounterpart(**{**found, **radii, "shift": tuple(found["shift"])})
    return FaceDifference(**{**data, "witness": witness(data["witness"])}, counterpart=found)


def _part(data: dict[str, Any]) -> PartDifference:
    motion = data["motion"]
    if motion is not None:
        vectors = {name: tuple(motion[name]) for name in ("translation", "axis", "shift")}
        motion = PartMotion(**{**motion, **vectors})
    faces = PartFaces(**{name: tuple(of) for name, of in data["faces"].items()})
    return PartDifference(**{**data, "motion": motion, "faces": faces})
