"""Checks of one file against the shape that OpenCASCADE reads from it, and of two files of one part.

Every check returns the sentences of what it found wrong, none if all holds.
"""

import math
from dataclasses import dataclass, field
from pathlib import Path

from OCP.TopoDS import TopoDS_Shape

from .command import Command, Refused
from .meshes import mesh, write_points, write_triangles
from .shapes import Area, area, diagonal, distance, edge_tolerance, faces, write_brep

# Largest distance of OpenCASCADE's mesh from its shape, relative to the diagonal.
DEFLECTION = 1e-3
# The mesh's own distance from the surface exceeds the deflection where that is asked of
# edges only; pieces farther than this multiple are outside of the face.
MESH_SLACK = 4.0
# Distances that OpenCASCADE's own accuracy excuses, relative to the diagonal.
AGREEMENT = 1e-6
# Difference of areas that is reported, relative to the whole model's.
AREA_AGREEMENT = 1e-6
# Width of an area's interval that is reported, relative to it: twice the one aimed at.
MAX_AREA_WIDTH = 2e-6


@dataclass
class Subject:
    """A file for the command, and the shape that OpenCASCADE reads from it."""

    shape: TopoDS_Shape
    path: Path
    diagonal: float = 0.0
    tolerance: float = 0.0
    areas: list[Area] = field(default_factory=list)
    gap: float = 0.0
    readable: bool = False

    def __post_init__(self):
        self.diagonal, self.tolerance = diagonal(self.shape), edge_tolerance(self.shape)
        self.areas = [area(face) for face in faces(self.shape)]

    @classmethod
    def as_brep(cls, shape: TopoDS_Shape, path: Path) -> "Subject":
        """The shape, written as BREP text."""
        write_brep(shape, path)
        return cls(shape, path)

    @property
    def area(self) -> float:
        return math.fsum(area.value for area in self.areas)

    @property
    def slack(self) -> float:
        """Distance that the file's own gaps excuse."""
        return self.gap + self.tolerance + AGREEMENT * self.diagonal


def reading(command: Command, subject: Subject) -> list[str]:
    """The file is read, without faces left out, and has OpenCASCADE's area."""
    try:
        info, warnings = command.info(subject.path)
    except Refused as refused:
        return [f"refused ({refused.status}): {refused.message}"]
    subject.readable, subject.gap = True, info["gap"]
    # Notes name faces that the file does not define fully; warnings, those left out.
    found = [line.split(": ", 2)[-1] for line in warnings if not line.startswith("note:")]
    if len(info["faces"]) != len(subject.areas):
        found.append(f"{len(info['faces'])} of {len(subject.areas)} faces")
    return found + areas(info, subject)


def areas(info: dict, subject: Subject) -> list[str]:
    """The areas of all faces are OpenCASCADE's.

    The two number faces differently: each of OpenCASCADE's areas, the most accurate one first, goes
    with the nearest of the command's that is left. A rim that is off by the gap changes an area by at
    most its length times that.
    """

    def off(area: Area) -> float:
        return area.spread + subject.gap * area.rim

    found, allowed = [], AREA_AGREEMENT * subject.area
    whole = allowed + math.fsum(off(area) for area in subject.areas)
    lower, upper = info["area"]["lower"], info["area"]["upper"]
    if not lower - whole <= subject.area <= upper + whole:
        found.append(f"area in [{lower:.9g}, {upper:.9g}], OpenCASCADE's {subject.area:.9g}")
    if upper - lower > MAX_AREA_WIDTH * upper:
        found.append(f"area not narrow: [{lower:.9g}, {upper:.9g}]")
    ours = [(face["area"]["lower"], face["area"]["upper"]) for face in info["faces"]]
    if len(ours) == len(subject.areas):
        for theirs in sorted(subject.areas, key=lambda area: area.spread):
            lower, upper = min(ours, key=lambda bounds: abs(sum(bounds) / 2 - theirs.value))
            ours.remove((lower, upper))
            if not lower - allowed - off(theirs) <= theirs.value <= upper + allowed + off(theirs):
                found.append(f"a face's area in [{lower:.9g}, {upper:.9g}], OpenCASCADE's {theirs.value:.9g}")
    return found


def coverage(command: Command, subject: Subject) -> list[str]:
    """OpenCASCADE's points lie on the model, and the model on OpenCASCADE's triangles."""
    found = []
    deflection = DEFLECTION * subject.diagonal
    meshed = mesh(subject.shape, deflection)
    if meshed.failed:
        return [f"OpenCASCADE meshes no face {meshed.failed}: not compared"]
    points, triangles = subject.path.with_suffix(".points.json"), subject.path.with_suffix(".mesh.json")
    write_points(meshed, points)
    write_triangles(meshed, triangles)
    found += nodes(command, points, subject)
    limit = MESH_SLACK * deflection + subject.slack
    # The mesh may be coarser than it is asked to be: a point that is farther from it counts
    # only if it is far from the shape.
    return found + farther(command, subject.path, triangles, limit, "a point of the model", subject)


def nodes(command: Command, points: Path, subject: Subject) -> list[str]:
    """OpenCASCADE's nodes lie on the model, if the farthest one lies on its own shape."""
    found = farther(command, points, subject.path, subject.slack, "a point of OpenCASCADE's faces")
    if found:
        point = command.distance(points, subject.path)["witness"]["a"]["point"]
        off = distance(point, subject.shape)
        if off > subject.slack:
            return [f"OpenCASCADE's mesh leaves its faces by {off:.3g}: not compared"]
    return found


def farther(command: Command, a: Path, b: Path, limit: float, name: str, shape: Subject | None = None) -> list[str]:
    """Every point of a lies within `limit` of b, and, given a shape, the farthest is not on that."""
    try:
        result = command.distance(a, b, "--limit", repr(limit))
    except Refused as refused:
        return [f"{name}: refused ({refused.status}): {refused.message}"]
    within = result.get("within")
    at = result["witness"]["a"]
    if within or (shape and within is False and distance(at["point"], shape.shape) <= limit):
        return []
    verdict = "is farther" if within is False else "may be farther"
    bounds = f"[{result['lower']:.6g}, {result['upper']:.6g}]"
    return [f"{name} {verdict} than {limit:.3g}: {bounds} at {at['point']}, face {at['face']}"]


def agreement(command: Command, a: Subject, b: Subject) -> list[str]:
    """Two files of one part are as near to each other as their gaps state, both ways."""
    if not a.readable or not b.readable:
        return []
    limit = a.slack + b.slack
    forward = farther(command, a.path, b.path, limit, f"a point of {a.path.name}")
    return forward + farther(command, b.path, a.path, limit, f"a point of {b.path.name}")
