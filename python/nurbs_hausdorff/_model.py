"""Models: files, shapes of CAD kernels and arrays, read and prepared once."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from . import _names, _native
from ._errors import NurbsHausdorffError


@dataclass(frozen=True)
class Remark:
    """A face of a file that was left out, or read with a decision: its number in the file, a
    stable code, the reason, and the number by which the file calls it."""

    face: int
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


class Model:
    """A model that is ready for measurements, made by `read` or `model`.

    It does not change, can be used by several threads at once, and pickles by its file's bytes.
    """

    __slots__ = ("_file", "_native", "_path", "__weakref__")

    def __init__(self, file: bytes, path: str = "model") -> None:
        try:
            self._native = _native.Model(file, path)
        except NurbsHausdorffError as error:
            message = error.message if path in error.message else f"{path}: {error.message}"
            raise NurbsHausdorffError(error.code, message) from None
        self._file = file
        self._path = path

    def __reduce__(self) -> tuple[type[Model], tuple[bytes, str]]:
        return Model, (self._file, self._path)

    def __repr__(self) -> str:
        return f"<Model {self.name or self._path!r}: {self.face_count} faces>"

    def _repr_html_(self) -> str:
        from ._results import _table

        low, high = self.bounding_box.tolist()
        rows = [
            ("model", self.name or self._path),
            ("faces", f"{self.face_count}, {len(self.report.skipped)} left out"),
            ("box", f"{low} to {high}"),
            ("unit", "unknown" if self.unit is None else f"{self.unit!r} m"),
        ]
        return _table(rows)

    @property
    def kind(self) -> str:
        """Kind of the source: ``step``, ``iges``, ``brep`` or ``json``."""
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
    def face_count(self) -> int:
        """Number of faces."""
        return len(self.face_names)

    @property
    def face_names(self) -> list[str | None]:
        """Names of the faces, in order."""
        return self._native.face_names

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

    def info(self) -> dict[str, Any]:
        """Return faces, patches and areas, with the names of the command `info --json` in snake
        case. Areas are intervals in squares of the model unit."""
        info: dict[str, Any] = _names.snake(self._native.info())
        return info

    def area(self) -> tuple[float, float]:
        """Return an interval that contains the area, in squares of the model unit."""
        area = self.info()["area"]
        return area["lower"], area["upper"]

    def to_json(self) -> str:
        """Return the model as interchange JSON, every number in full precision."""
        return self._native.to_json()

    def tessellate(
        self, *, tolerance: float | None = None, relative_tolerance: float | None = None
    ) -> Mesh:
        """Return triangles within a tolerance of the model, in model units, or a fraction of its
        diagonal; 2e-4 of it if neither is given."""
        options = _names.options(tolerance=tolerance, relative_tolerance=relative_tolerance)
        made = self._native.tessellate(options)
        ends = made["face_ends"].astype(np.int64)
        return Mesh(
            made["vertices"].reshape(-1, 3),
            made["normals"].reshape(-1, 3),
            made["triangles"].reshape(-1, 3),
            np.repeat(np.arange(len(ends)), np.diff(ends, prepend=0)),
        )


def read(source: str | os.PathLike[str] | bytes | BinaryIO) -> Model:
    """Read a file of STEP, IGES, OpenCASCADE's BREP text or interchange JSON, by its content.

    Parameters
    ----------
    source : path, bytes or binary file object
        The file.

    Raises
    ------
    NurbsHausdorffError
        ``FILE_UNREADABLE``, or a code of the format, such as ``STEP_SYNTAX``.
    """
    if isinstance(source, (bytes, bytearray, memoryview)):
        return Model(bytes(source))
    if hasattr(source, "read"):
        found = source.read()
        data = found.encode() if isinstance(found, str) else bytes(found)
        return Model(data, str(getattr(source, "name", "model")))
    path = os.fspath(source)
    try:
        with open(path, "rb") as file:
            return Model(file.read(), str(path))
    except OSError as error:
        raise NurbsHausdorffError("FILE_UNREADABLE", f"{path}: {error.strerror}") from error


def model(part: Any) -> Model:
    """Make a model of anything that has NURBS surfaces.

    Parameters
    ----------
    part : Model, path, bytes, file object, shape, mapping or iterable of mappings
        A shape of build123d, CadQuery or OCP; interchange JSON as a mapping, or its surfaces:
        ``degree`` (2,), ``knots_u``, ``knots_v``, and ``ctrl`` of shape (m, n, 4) with weights
        that are not multiplied in, or (m, n, 3); the arrays may be NumPy's.

    Raises
    ------
    NurbsHausdorffError
        ``ARGUMENT_INVALID`` for anything else, and the codes of `read`.
    """
    if isinstance(part, Model):
        return part
    if isinstance(part, (str, os.PathLike, bytes)) or hasattr(part, "read"):
        return read(part)
    if isinstance(part, Mapping):
        document = part if "surfaces" in part else {"surfaces": [part]}
        return _of_arrays(document)
    shape = _ocp_shape(part)
    if shape is not None:
        return Model(_brep_text(shape), type(part).__name__)
    if isinstance(part, Iterable) and not hasattr(part, "dtype"):
        surfaces = list(part)
        if surfaces and all(isinstance(surface, Mapping) for surface in surfaces):
            return _of_arrays({"surfaces": surfaces})
    raise NurbsHausdorffError(
        "ARGUMENT_INVALID",
        f"found {type(part).__name__}, expected a path, bytes, a file object, a shape of "
        "build123d, CadQuery or OCP, or surfaces as mappings",
    )


#: Keys of a surface in the interchange JSON.
_SURFACE_KEYS = frozenset(
    "degree knots_u knots_v ctrl trim reversed part kind gap gap_measured".split()
)


def _of_arrays(document: Mapping[str, Any]) -> Model:
    def surface(index: int, given: Mapping[str, Any]) -> dict[str, Any]:
        unknown = set(given) - _SURFACE_KEYS
        if unknown:
            raise NurbsHausdorffError(
                "ARGUMENT_INVALID",
                f"surface {index} has {sorted(unknown)}, expected keys of {sorted(_SURFACE_KEYS)}",
            )
        points = np.asarray(given.get("ctrl"), dtype=object if "ctrl" not in given else np.float64)
        if points.ndim == 3 and points.shape[2] == 3:
            weights = np.ones((*points.shape[:2], 1))
            points = np.concatenate([points, weights], axis=2)
        return {**given, "ctrl": points}

    try:
        surfaces = [surface(index, given) for index, given in enumerate(document["surfaces"])]
        text = json.dumps({**document, "surfaces": surfaces}, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise NurbsHausdorffError("ARGUMENT_INVALID", f"surfaces: {error}") from error
    return Model(text.encode(), str(document.get("name") or "model"))


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"found {type(value).__name__}, expected numbers and arrays")


def _ocp_shape(part: Any) -> Any:
    """Return the shape of OCP that a part has, or None."""
    if hasattr(part, "toCompound"):
        part = part.toCompound()
    elif callable(getattr(part, "vals", None)):
        return _compound([_ocp_shape(value) for value in part.vals()])
    elif hasattr(part, "part") and hasattr(part, "_obj"):
        # A builder of build123d.
        part = part.part
    shape = getattr(part, "wrapped", part)
    return shape if type(shape).__module__.startswith("OCP.") else None


def _compound(shapes: list[Any]) -> Any:
    if any(shape is None for shape in shapes):
        return None
    if len(shapes) == 1:
        return shapes[0]
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Compound

    compound, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(compound)
    for shape in shapes:
        builder.Add(compound, shape)
    return compound


def _brep_text(shape: Any) -> bytes:
    from OCP.BRepTools import BRepTools

    write = getattr(BRepTools, "Write_s", None) or BRepTools.Write
    stream = io.BytesIO()
    write(shape, stream)
    return stream.getvalue()
