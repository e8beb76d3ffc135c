"""Scores of candidates, as intervals that contain their numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from .._calls.fit import BestFit, fit_result, motion
from .._values.interval import Interval
from .._values.transform import Transform
from .common import Seconds, table


@dataclass(frozen=True)
class Placement:
    """How the candidate was laid on the truth: its coordinates times ``scale``, then ``transform``.

    ``fit`` is the best fit with the other poses that fit as well, if that was the rule.
    """

    align: Literal["none", "box", "best-fit"]
    scale: float
    transform: Transform
    fit: BestFit | None = None


@dataclass(frozen=True)
class ScoredModel:
    """A model as a score sees it.

    Attributes
    ----------
    valid : Interval
        1 if it is closed, oriented, without copies of faces, and all its bodies are embedded; 0 if
        it certainly is not.
    closed : bool
        Whether there is a body, and every edge of every face has a partner.
    oriented : bool or None
        Whether the normals of all faces point out of their bodies; None where that is not decided.
    duplicates : int
        Number of faces with the surface and the loops of an earlier face of the same body, together
        with all faces of bodies that repeat an earlier body. Of a mesh, number of triangles with the
        corners of an earlier one.
    embedded : bool or None
        Whether all bodies are certainly embedded up to their gaps, or one certainly is not; None
        where neither is known.
    self_overlaps : int
        Number of bodies that certainly meet themselves.
    bodies, sheets, voids : int
        Numbers of bodies that close, of those that do not, and of voids.
    volume, area, centroid : optional
        None where there is none.
    """

    valid: Interval
    closed: bool
    oriented: bool | None
    duplicates: int
    embedded: bool | None
    self_overlaps: int
    bodies: int
    sheets: int
    voids: int
    extents: tuple[Interval, ...]
    volume: Interval | None = None
    area: Interval | None = None
    centroid: tuple[Interval, ...] | None = None


@dataclass(frozen=True)
class Difference:
    """A number of the candidate less that of the truth, and the smaller over the larger."""

    difference: Interval
    ratio: Interval


@dataclass(frozen=True)
class SurfaceScore:
    """The mean and the mean square of the distances of one model's points from the other model."""

    mean: Interval
    mean_square: Interval


@dataclass(frozen=True)
class AtThreshold:
    """The parts of both areas within a threshold of the other model, and their harmonic mean.

    Those with normals are of points that have a like counterpart: a point of the other model within
    the threshold whose tangent plane forms at most ``normal_angle`` degrees. They are None for
    clouds. Those of edges are of the lengths of both models' feature edges; they are None for
    clouds, and for meshes of more than 250,000 triangles.
    """

    threshold: float
    precision: Interval
    recall: Interval
    f1: Interval
    normal_angle: float | None = None
    normal_precision: Interval | None = None
    normal_recall: Interval | None = None
    normal_f1: Interval | None = None
    edge_precision: Interval | None = None
    edge_recall: Interval | None = None
    edge_f1: Interval | None = None


@dataclass(frozen=True)
class EdgeLengths:
    """The lengths of all feature edges, where a surface turns by more than the angle or ends."""

    feature_angle: float
    candidate: Interval
    truth: Interval


@dataclass(frozen=True)
class HausdorffScore:
    """The Hausdorff distance to the truth, back, and the larger of both."""

    forward: Interval
    reverse: Interval
    distance: Interval


@dataclass(frozen=True)
class FaceCounts:
    """The parts of the faces that are unchanged; those certainly changed with all, by number."""

    limit: float
    candidate: Interval
    truth: Interval
    changed_of_candidate: tuple[int, int]
    changed_of_truth: tuple[int, int]


@dataclass(frozen=True)
class Requirement:
    """A number that has to be large or small enough, with what was found."""

    number: str
    found: Interval
    met: bool | None
    at_least: float | None = None
    at_most: float | None = None


@dataclass(frozen=True)
class Score:
    """The score of a candidate against the truth; every number is in its interval.

    What is None was not measured: a model that does not close has no volume, and work that ended
    early leaves the rest out.
    """

    placement: Placement
    diagonal: float
    candidate: ScoredModel
    truth: ScoredModel
    extent_differences: tuple[Interval, ...]
    thresholds: tuple[AtThreshold, ...]
    requirements: tuple[Requirement, ...]
    met: bool | None
    ended_early: bool
    converged: bool
    tolerance: float
    seconds: Seconds
    volume: Difference | None = None
    area: Difference | None = None
    centroid_distance: Interval | None = None
    forward: SurfaceScore | None = None
    reverse: SurfaceScore | None = None
    chamfer: Interval | None = None
    chamfer_squared: Interval | None = None
    edge_length: EdgeLengths | None = None
    hausdorff: HausdorffScore | None = None
    iou: Interval | None = None
    faces: FaceCounts | None = None
    unit: float | None = None
    hint: str | None = None

    def _repr_html_(self) -> str:
        named = [("chamfer", self.chamfer), ("chamfer squared", self.chamfer_squared)]
        named += [(f"f1 at {at.threshold!r}", at.f1) for at in self.thresholds]
        named += [(f"normal f1 at {at.threshold!r}", at.normal_f1) for at in self.thresholds]
        named += [(f"edge f1 at {at.threshold!r}", at.edge_f1) for at in self.thresholds]
        if self.hausdorff is not None:
            named.append(("hausdorff", self.hausdorff.distance))
        if self.volume is not None:
            named.append(("volume ratio", self.volume.ratio))
        named.append(("valid", self.candidate.valid))
        return table([(name, f"{of.lower!r} to {of.upper!r}") for name, of in named if of])


def score_result(data: dict[str, Any]) -> Score:
    """Make the result of a native dictionary in snake case."""
    fit = data["placement"].pop("fit", None)
    placement = Placement(
        align=data["placement"]["align"],
        scale=data["placement"]["scale"],
        transform=motion(data["placement"]),
        fit=fit_result(fit) if fit is not None else None,
    )
    made: dict[str, Any] = {name: value for name, value in data.items() if value is not None}
    made["met"] = data.get("met")
    made["placement"] = placement
    made["seconds"] = Seconds(**data["seconds"])
    for name in ("candidate", "truth"):
        made[name] = _model(data[name])
    for name in ("volume", "area"):
        if name in made:
            made[name] = Difference(**_bounded(made[name]))
    kinds = {"forward": SurfaceScore, "reverse": SurfaceScore, "hausdorff": HausdorffScore}
    for name, kind in {**kinds, "edge_length": EdgeLengths}.items():
        if name in made:
            made[name] = kind(**_bounded(made[name]))
    for name in ("centroid_distance", "chamfer", "chamfer_squared", "iou"):
        if name in made:
            made[name] = Interval(**made[name])
    if "faces" in made:
        counts = {
            name: tuple(value) if isinstance(value, list) else value
            for name, value in made["faces"].items()
        }
        made["faces"] = FaceCounts(**_bounded(counts))
    made["extent_differences"] = tuple(Interval(**one) for one in data["extent_differences"])
    # The names in snake case part a letter and a digit.
    made["thresholds"] = tuple(
        AtThreshold(**{name.replace("f_1", "f1"): value for name, value in _bounded(at).items()})
        for at in data["thresholds"]
    )
    made["requirements"] = tuple(Requirement(**_bounded(one)) for one in data["requirements"])
    return Score(**made)


def _bounded(data: dict[str, Any]) -> dict[str, Any]:
    """Return the dictionary with its intervals as `Interval`."""
    return {
        name: Interval(**value) if isinstance(value, dict) else value for name, value in data.items()
    }


def _model(data: dict[str, Any]) -> ScoredModel:
    lists = {
        name: tuple(Interval(**one) for one in data[name])
        for name in ("extents", "centroid")
        if data.get(name) is not None
    }
    return ScoredModel(**{**_bounded(data), **lists})
