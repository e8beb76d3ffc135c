"""Facts of bodies, as intervals that contain them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ..._values.interval import Interval
from ..common import Point, table

Orientation = Literal["consistent", "insideOut", "mixed", "notOrientable", "undecided"]
VolumeUnknown = Literal["open", "notOrientable", "nesting", "points"]
Intervals3 = tuple[Interval, Interval, Interval]


@dataclass(frozen=True)
class Facts:
    """Facts of a body or of a model, in model units and at density 1; every number is in its
    interval.

    They are those of the patches that are measured; the extents hold for the faces themselves.

    Attributes
    ----------
    volume : Interval or None
        Of a model, the sum over its bodies; None where ``volume_unknown`` says why.
    volume_of_gap : float or None
        About the volume between the faces and their source; an estimate, and no part of the
        interval.
    area : Interval or None
        None of points.
    extents, min, max : tuple of Interval
        Lengths and coordinates along x, y and z.
    centroid : tuple of Interval or None
    inertia : tuple of three tuples of Interval, or None
        Tensor of inertia about the centroid.
    principal_moments : tuple of Interval or None
        Ascending.
    principal_axes, principal_angles : tuple or None
        Unit vectors, and upper bounds on their angles with the axes, in radians.
    principal_extents : tuple of Interval or None
        Lengths along these axes.
    """

    extents: Intervals3
    min: Intervals3
    max: Intervals3
    volume: Interval | None = None
    volume_unknown: VolumeUnknown | None = None
    volume_of_gap: float | None = None
    area: Interval | None = None
    centroid: Intervals3 | None = None
    inertia: tuple[Intervals3, Intervals3, Intervals3] | None = None
    principal_moments: Intervals3 | None = None
    principal_axes: tuple[Point, Point, Point] | None = None
    principal_angles: Point | None = None
    principal_extents: Intervals3 | None = None

    def _repr_html_(self) -> str:
        rows = [("volume", self.volume_unknown if self.volume is None else repr(self.volume))]
        rows.append(("area", repr(self.area)))
        rows.append(("extents", ", ".join(repr(one) for one in self.extents)))
        if self.centroid is not None:
            rows.append(("centroid", ", ".join(repr(one) for one in self.centroid)))
        return table([(name, str(text)) for name, text in rows])


@dataclass(frozen=True)
class Body:
    """An outer shell and its voids, a sheet, or a cloud of points.

    Attributes
    ----------
    full_name : str
        The name that no other body of the model has, by which comparisons and checks call it: the
        names of its path joined, else ``body 1`` by its number; equal names are numbered.
    path : tuple of str
        Names of the levels that all its faces have, from the outermost.
    kind : {"solid", "sheet", "points"}
    closed : bool
        Whether every edge of its faces has a partner.
    faces : tuple of int
        Indices of its faces.
    voids, free_edges : int
        Numbers of shells that are voids, and of edges without a partner.
    """

    name: str | None
    full_name: str
    path: tuple[str, ...]
    kind: Literal["solid", "sheet", "points"]
    closed: bool
    orientation: Orientation | None
    faces: tuple[int, ...]
    voids: int
    free_edges: int
    facts: Facts
    triangles: int | None = None
    points: int | None = None


@dataclass(frozen=True)
class FaceForm:
    """The elementary surface that all points of a face lie on, up to what is stated.

    Points and directions are numbers: what is certain is how far the face's points are from the form
    with just these. The gap between the face and its source is not in it.

    Attributes
    ----------
    kind : {"plane", "sphere", "cylinder", "cone", "torus"}
    point : tuple of float
        A point of the plane or of the cylinder's axis, a cone's apex, else the centre.
    direction : tuple of float or None
        Normal of the plane, else direction of the axis, of length 1; None of a sphere.
    radius : Interval or None
        Contains the distances of all points of the face from the centre, from the axis, or, of a
        torus, from the circle in the middle of its tube.
    major_radius : float or None
        Radius of that circle.
    half_angle : float or None
        Angle between a cone's axis and its lines, in degrees.
    deviation : float or None
        Upper bound on the distances of the face's points from the plane, or from the cone with both
        of its nappes.
    """

    kind: Literal["plane", "sphere", "cylinder", "cone", "torus"]
    point: tuple[float, float, float]
    direction: tuple[float, float, float] | None = None
    radius: Interval | None = None
    major_radius: float | None = None
    half_angle: float | None = None
    deviation: float | None = None


def _intervals(value: Any) -> Any:
    """Make intervals of dictionaries, and tuples of sequences, at every depth."""
    if isinstance(value, dict):
        return Interval(**value)
    if isinstance(value, (list, tuple)):
        return tuple(_intervals(item) for item in value)
    return value


def facts_result(data: dict[str, Any]) -> Facts:
    """Make the facts of a native dictionary in snake case."""
    return Facts(**{name: _intervals(value) for name, value in data.items()})


def form_result(data: dict[str, Any]) -> FaceForm:
    """Make the form of a native dictionary in snake case."""
    return FaceForm(**{name: _intervals(value) for name, value in data.items()})


def body_result(data: dict[str, Any]) -> Body:
    """Make the body of a native dictionary in snake case."""
    data["facts"] = facts_result(data["facts"])
    for name in ("path", "faces"):
        data[name] = tuple(data[name])
    return Body(**data)
