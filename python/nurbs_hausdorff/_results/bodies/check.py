"""How the bodies of models lie to each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ..._values.interval import Interval
from ..common import Point, Seconds, table

PairState = Literal["clash", "undecided", "touching", "near", "apart"]
Orientation = Literal["consistent", "insideOut", "mixed", "notOrientable", "undecided"]


@dataclass(frozen=True)
class SelfOverlap:
    """A place at which the boundary of a body certainly meets itself.

    Attributes
    ----------
    point : tuple of float
        The middle of a ball without points of the boundary, larger than the gaps of the body.
    radius : float
        Its radius.
    winding : int
        How often the boundary winds about it, 1 or 0 in a body that does not meet itself: 2 or
        more in matter that counts twice, -1 or less where walls have passed through each other.
    faces : tuple of int
        The two faces that cross near by, in the body's model; none of a mesh.
    """

    point: Point
    radius: float
    winding: int
    faces: tuple[int, ...]


@dataclass(frozen=True)
class EmbeddedUnknown:
    """What is not decided of a body's boundary.

    Attributes
    ----------
    why : {"contact", "budget", "refuted", "gaps", "too-large"}
        Faces touch, cross, or come as near to each other as the gaps beside all edges and corners
        that they share; too many pairs of pieces, or too late; points contradicted what was proven
        of them, a fault of the library; a mesh has gaps; a mesh has more than 250,000 triangles.
    faces : tuple of int
        Two faces, or one, of a pair that was not decided, in the body's model; none of a mesh.
    point : tuple of float or None
        A point about where it is, if it is at one.
    """

    why: Literal["contact", "budget", "refuted", "gaps", "too-large"]
    faces: tuple[int, ...]
    point: Point | None


@dataclass(frozen=True)
class CheckedBody:
    """A body by itself.

    Attributes
    ----------
    name : str
        Its levels, joined by " / "; bodies without a name, and of equal names, are numbered.
    model : int
        Index of the model that it is of.
    kind : {"solid", "sheet"}
    closed : bool
        Whether every edge of its faces has a partner.
    orientation : str or None
        How its faces are oriented.
    degenerate : bool
        Whether it closes and certainly has no inside to speak of: less volume than a layer of the
        tolerance over half its area.
    embedded : bool or None
        Whether its boundary certainly meets itself nowhere, up to its gaps, or certainly does; none
        where neither is known.
    embedded_within : float or None
        Of a body that is embedded, the length of the way along its boundary between points of it
        that are as near to each other as its gaps, at most.
    embedded_unknown : EmbeddedUnknown or None
        Why it is not known whether it is embedded.
    self_overlap : SelfOverlap or None
        A place at which its boundary meets itself; none unless it certainly does.
    duplicates : tuple of str
        Names of the bodies that certainly have its shape in its place, within the tolerance.
    """

    name: str
    model: int
    kind: Literal["solid", "sheet"]
    closed: bool
    orientation: Orientation | None
    degenerate: bool
    embedded: bool | None
    embedded_within: float | None
    embedded_unknown: EmbeddedUnknown | None
    self_overlap: SelfOverlap | None
    duplicates: tuple[str, ...]


@dataclass(frozen=True)
class BodyPair:
    """Two bodies, and how they lie to each other.

    Attributes
    ----------
    a, b : str
        Their names.
    state : {"clash", "undecided", "touching", "near", "apart"}
        A clash is certain: ``point`` is inside both. What is near is certainly nearer than
        ``below`` and has no common inside; what touches is certainly within the tolerance.
    clearance : Interval
        The least distance of their points; 0 of a clash.
    volume : Interval or None
        Of a clash, the volume of their common part, if both have one.
    depth : Interval or None
        Of a clash, the length of the shortest motion without a turn that leaves them without a
        common inside.
    point : tuple of float
        Of a clash, a point inside both; else the point of ``a`` that is nearest to ``b``.
    intended : bool
        Whether a rule says that what happens between them is meant.
    why : str or None
        Why the state is not decided.
    """

    a: str
    b: str
    state: PairState
    clearance: Interval
    volume: Interval | None
    depth: Interval | None
    point: Point
    intended: bool
    why: str | None = None


@dataclass(frozen=True)
class UnkeptRule:
    """A rule that is not certainly kept; ``broken`` says that it certainly is not.

    ``b`` is the other body; of ``"mustTouch"``, the pattern of those that ``a`` may touch.
    """

    rule: Literal["mustTouch", "atLeast"]
    broken: bool
    a: str
    b: str
    distance: float | None = None
    clearance: Interval | None = None


@dataclass(frozen=True)
class CheckResult:
    """All pairs of bodies; those that are not listed are certainly apart.

    Attributes
    ----------
    clean : bool or None
        Whether no pair clashes that is not intended to, and all rules are kept; None where that is
        not decided. Faults of single bodies are no part of it.
    pairs : tuple of BodyPair
        The pairs whose boxes are near, clashes first.
    rules : tuple of UnkeptRule
        The rules that are not certainly kept.
    bodies : tuple of CheckedBody
    pair_count : int
        Number of all pairs.
    below, tolerance, diagonal : float
        The distance below which bodies are near, that up to which they touch, and the diagonal of
        the box of all bodies, in model units.
    """

    clean: bool | None
    pairs: tuple[BodyPair, ...]
    rules: tuple[UnkeptRule, ...]
    bodies: tuple[CheckedBody, ...]
    pair_count: int
    below: float
    tolerance: float
    diagonal: float
    seconds: Seconds
    unit: float | None = None

    def in_state(self, state: PairState) -> tuple[BodyPair, ...]:
        """Return the pairs in a state, without those whose clashes are intended."""
        return tuple(pair for pair in self.pairs if pair.state == state and not pair.intended)

    def _repr_html_(self) -> str:
        return table(
            [("pairs", f"{self.pair_count} of {len(self.bodies)} bodies")]
            + [(pair.state, pair_text(pair)) for pair in self.pairs]
            + [("broken" if rule.broken else "undecided", rule_text(rule)) for rule in self.rules]
        )


def pair_text(pair: BodyPair) -> str:
    """Return the names of a pair with the place and what was measured."""
    names = f"{pair.a} and {pair.b}"
    if pair.state != "clash":
        return f"{names}: {pair.clearance!r} apart, at {pair.point}"
    measured = [("common volume", pair.volume), ("depth", pair.depth)]
    found = "".join(f"; {name} {of!r}" for name, of in measured if of is not None)
    return f"{names}: both have {pair.point} inside{found}"


def rule_text(rule: UnkeptRule) -> str:
    """Return what a rule asks for, and what was found."""
    if rule.rule == "mustTouch":
        return f"{rule.a} must touch {rule.b}"
    return f"{rule.a} and {rule.b} must be at least {rule.distance!r} apart: {rule.clearance!r}"


def check_result(data: dict[str, Any]) -> CheckResult:
    """Make the result of a native dictionary in snake case."""
    data["seconds"] = Seconds(**data["seconds"])
    data["pairs"] = tuple(
        BodyPair(**{**_bounded(pair), "point": tuple(pair["point"])}) for pair in data["pairs"]
    )
    data["rules"] = tuple(UnkeptRule(**_bounded(rule)) for rule in data["rules"])
    data["bodies"] = tuple(_checked_body(body) for body in data["bodies"])
    return CheckResult(**data)


def _checked_body(data: dict[str, Any]) -> CheckedBody:
    found = data["self_overlap"]
    if found is not None:
        found = SelfOverlap(**{**found, "point": tuple(found["point"]), "faces": tuple(found["faces"])})
    unknown = data["embedded_unknown"]
    if unknown is not None:
        point = unknown["point"] and tuple(unknown["point"])
        unknown = EmbeddedUnknown(unknown["why"], tuple(unknown["faces"]), point)
    return CheckedBody(
        **{
            **data,
            "embedded_unknown": unknown,
            "self_overlap": found,
            "duplicates": tuple(data["duplicates"]),
        }
    )


def _bounded(data: dict[str, Any]) -> dict[str, Any]:
    """Return the dictionary with its intervals as `Interval`."""
    return {
        name: Interval(**value) if isinstance(value, dict) else value for name, value in data.items()
    }
