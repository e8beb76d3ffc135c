"""Models, read and prepared once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._values import names as _names
from . import _native
from ._values.arrays import rows
from ._errors import NurbsHausdorffError
from ._values.interval import Interval
from ._results.bodies.facts import (
    Body, FaceForm, Facts, body_result, facts_result, form_result,
)  # fmt: skip


@dataclass(frozen=True)
class Remark:
    """A face of a file that was left out, or read with a decision: its number in the file, or the
    shape's name in a FreeCAD document, a stable code, the reason, and the number by which the
    file calls it."""

    face: int | str
    code: str
    why: str
    entity: int | None = None


@dataclass(frozen=True)
class ReadReport:
    """What reading kept and left out.

    Attributes
    ----------
    faces, trims, exact, fitted : int
        Faces read, their trimming curves, and those exact and fitted.
    gap : float
        Largest distance of a face from the file's, in model units.
    gap_proven : bool
        Whether the gap is an upper bound.
    unit : float or None
        Metres per model unit, if they are known.
    skipped, notes : tuple of Remark
        Faces left out, and faces that the file leaves ambiguous.
    """

    faces: int
    trims: int
    exact: int
    fitted: int
    gap: float
    gap_proven: bool
    unit: float | None
    skipped: tuple[Remark, ...]
    notes: tuple[Remark, ...]


@dataclass(frozen=True)
class MeshReport:
    """Findings about a mesh that do not make it invalid: the numbers of vertices that were joined
    with an equal one and of those without a triangle, of triangles with two equal corners and of
    others whose corners lie on a line."""

    joined_vertices: int
    unused_vertices: int
    collapsed_triangles: int
    flat_triangles: int


@dataclass(frozen=True)
class Mesh:
    """Triangles of a model.

    Attributes
    ----------
    vertices : ndarray of shape (k, 3)
        Points, in model units.
    normals : ndarray of shape (k, 3)
        Unit normals, in float32.
    triangles : ndarray of shape (t, 3)
        Indices of vertices, anticlockwise about the normal.
    face_of_triangle : ndarray of shape (t,)
        Index of each triangle's face.
    """

    vertices: NDArray[np.float64]
    normals: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    face_of_triangle: NDArray[np.int64]


@dataclass(frozen=True)
class FreeEdge:
    """An edge of a face, or a part of it, that no other edge joins: its face, three points on it."""

    face: int
    start: tuple[float, float, float]
    middle: tuple[float, float, float]
    end: tuple[float, float, float]
    face_name: str | None = None


@dataclass(frozen=True)
class Shell:
    """Faces that joined edges connect, and whether none of them has a free edge."""

    faces: tuple[int, ...]
    closed: bool


@dataclass(frozen=True)
class Solid:
    """Whether a model's faces close, so that points lie inside or outside.

    Attributes
    ----------
    closed : bool
        Whether every edge of a face has a partner.
    shells : tuple of Shell
        Voids of solids among them.
    free_edges : tuple of FreeEdge
        Edges without a partner; none of a solid.
    """

    closed: bool
    shells: tuple[Shell, ...]
    free_edges: tuple[FreeEdge, ...]


@dataclass(frozen=True, eq=False)
class Facets:
    """Vertices of shape (n, 3) with triangles of shape (m, 3), or points without, and the metres
    per unit."""

    vertices: NDArray[np.float64]
    triangles: NDArray[np.uint32] | None = None
    unit: float | None = None


class Model:
    """A model that is ready for measurements, made by `read` or `model`.

    It does not change, can be used by several threads at once, and pickles by its file's bytes
    or by its arrays.
    """

    __slots__ = ("_source", "_native", "_path", "_beside", "__weakref__")

    def __init__(
        self,
        source: bytes | Facets,
        path: str = "model",
        beside: dict[str, bytes] | None = None,
    ) -> None:
        try:
            if isinstance(source, Facets):
                self._native = _native.Model.of_facets(
                    source.vertices.reshape(-1),
                    None if source.triangles is None else source.triangles.reshape(-1),
                    source.unit,
                )
            else:
                self._native = _native.Model(source, path, beside or {})
        except NurbsHausdorffError as error:
            message = error.message if path in error.message else f"{path}: {error.message}"
            raise NurbsHausdorffError(error.code, message) from None
        self._source = source
        self._path = path
        self._beside = beside

    def __reduce__(
        self,
    ) -> tuple[type[Model], tuple[bytes | Facets, str, dict[str, bytes] | None]]:
        return Model, (self._source, self._path, self._beside)

    def __repr__(self) -> str:
        return f"<Model {self.name or self._path!r}: {self._size()}>"

    def _size(self) -> str:
        count = self.facet_count
        if count is None:
            return f"{self.face_count} faces"
        return f"{count} {'triangles' if self.kind == 'mesh' else 'points'}"

    def _repr_html_(self) -> str:
        from ._results.common import table

        low, high = self.bounding_box.tolist()
        rows = [
            ("model", self.name or self._path),
            ("size", f"{self._size()}, {len(self.report.skipped)} faces left out"),
            ("box", f"{low} to {high}"),
            ("unit", "unknown" if self.unit is None else f"{self.unit!r} m"),
        ]
        return table(rows)

    @property
    def kind(self) -> str:
        """Kind of the source: ``step``, ``iges``, ``brep``, ``fcstd``, ``json``, ``mesh`` or
        ``points``."""
        return self._native.kind

    @property
    def name(self) -> str | None:
        """Name of the model."""
        return self._native.name

    @property
    def unit(self) -> float | None:
        """Metres per model unit, if they are known."""
        return self._native.unit

    @property
    def gap(self) -> float:
        """Largest distance between the model and its source, in model units."""
        return self._native.gap

    @property
    def facet_count(self) -> int | None:
        """Number of triangles of a mesh or of points; None of surfaces."""
        return self._native.facet_count

    @property
    def mesh_report(self) -> MeshReport | None:
        """Findings about a mesh; None of anything else."""
        report = self._native.mesh_report()
        return None if report is None else MeshReport(**_names.snake(report))

    @property
    def face_count(self) -> int:
        """Number of faces."""
        return len(self.face_names)

    @property
    def face_names(self) -> list[str | None]:
        """Names of the faces, in order."""
        return self._native.face_names

    @property
    def face_paths(self) -> list[list[str]]:
        """What each face stands in, from the outermost assembly on, with its own name last; empty without a name."""
        return self._native.face_paths

    @property
    def face_colors(self) -> list[tuple[float, float, float] | None]:
        """Colour of each face in sRGB from 0 to 1, as the file states it; None without one."""
        return self._native.face_colors

    @property
    def bounding_box(self) -> NDArray[np.float64]:
        """Smallest and largest coordinates of the control points, of shape (2, 3)."""
        return np.array(self._native.bounding_box)

    @property
    def report(self) -> ReadReport:
        """What reading kept and left out."""
        data = _names.snake(self._native.report())
        for name in ("skipped", "notes"):
            data[name] = tuple(Remark(**remark) for remark in data[name])
        return ReadReport(**data)

    def solid(self) -> Solid:
        """Return whether the faces close within their gaps, and where they do not."""
        data = _names.snake(self._native.solid())
        shells = tuple(Shell(tuple(one["faces"]), one["closed"]) for one in data["shells"])
        edges = tuple(
            FreeEdge(**{**edge, **{end: tuple(edge[end]) for end in ("start", "middle", "end")}})
            for edge in data["free_edges"]
        )
        return Solid(data["closed"], shells, edges)

    def sides(self, points: ArrayLike) -> NDArray[np.int8]:
        """Return the sides of points of shape (n, 3): -1 inside, 1 outside, 0 where neither is
        certain: within the gaps of the boundary, and everywhere if the model is not closed."""
        return self._native.sides(rows("points", points).reshape(-1))

    def info(self) -> dict[str, Any]:
        """Return faces, patches and areas, with the names of the command `info --json` in snake
        case. Areas are intervals in squares of the model unit."""
        info: dict[str, Any] = _names.snake(self._native.info())
        return info

    def facts(self) -> Facts:
        """Return volume, area, extents, centroid and inertia, as intervals that contain them.
        Computed at the first call."""
        return facts_result(_names.snake(self._native.facts()))

    @property
    def face_forms(self) -> tuple[FaceForm | None, ...]:
        """The plane, sphere, cylinder, cone or torus that each face lies on, with bounds on how far
        its points are from it; None for other surfaces. Empty for meshes and points."""
        forms = (_names.snake(form) for form in self._native.face_forms())
        return tuple(None if form is None else form_result(form) for form in forms)

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies with their facts: solids with their voids, sheets, or a cloud of points."""
        return tuple(body_result(body) for body in _names.snake(self._native.bodies()))

    @property
    def area(self) -> Interval | None:
        """Area, in squares of the model unit; None of points."""
        return self.facts().area

    @property
    def volume(self) -> Interval | None:
        """Volume, in cubes of the model unit; None where ``facts().volume_unknown`` says why."""
        return self.facts().volume

    @property
    def extents(self) -> tuple[Interval, Interval, Interval]:
        """Lengths along x, y and z."""
        return self.facts().extents

    @property
    def centroid(self) -> tuple[Interval, Interval, Interval] | None:
        """Centroid of the volume."""
        return self.facts().centroid

    @property
    def inertia(self) -> tuple[tuple[Interval, Interval, Interval], ...] | None:
        """Tensor of inertia about the centroid, at density 1."""
        return self.facts().inertia

    def to_json(self) -> str:
        """Return the model as interchange JSON, every number in full precision."""
        return self._native.to_json()

    def tessellate(
        self, *, tolerance: float | None = None, relative_tolerance: float | None = None
    ) -> Mesh:
        """Return triangles within a tolerance of the model, in model units, or a fraction of its
        diagonal; 2e-4 of it if neither is given. Where that takes more than about a million
        triangles it is exceeded."""
        options = _names.options(tolerance=tolerance, relative_tolerance=relative_tolerance)
        made = self._native.tessellate(options)
        ends = made["face_ends"].astype(np.int64)
        return Mesh(
            made["vertices"].reshape(-1, 3),
            made["normals"].reshape(-1, 3),
            made["triangles"].reshape(-1, 3),
            np.repeat(np.arange(len(ends)), np.diff(ends, prepend=0)),
        )

