"""Models of files, of shapes of CAD kernels, and of arrays."""

from __future__ import annotations

import io
import json
import os
import re
import tempfile
from collections.abc import Iterable, Mapping
from typing import Any, BinaryIO

import numpy as np

from ._errors import NurbsHausdorffError
from ._facets import facets
from ._model import Model
from ._native import names_beside


def read(
    source: str | os.PathLike[str] | bytes | BinaryIO, *, format: str | None = None
) -> Model:
    """Read a file of a CAD model, of a mesh or of points.

    Parameters
    ----------
    source : path, bytes or binary file object
        The file. STEP, IGES, OpenCASCADE's BREP text, FreeCAD documents and interchange JSON are
        known by their content, also where gzip compressed them, as are STL, PLY, OFF, VTK's surfaces,
        glTF, 3MF, PCD, PTX, LAS, LAZ and E57; OBJ and points as text by the ending of the name where
        there is one. A glTF at a path has its buffers beside it.
    format : str, optional
        Ending that tells a mesh where neither content nor name does: ``"stl"``, ``"obj"``,
        ``"xyz"``, …

    Raises
    ------
    NurbsHausdorffError
        ``FILE_UNREADABLE``, or a code of the format, such as ``STEP_SYNTAX``.
    """
    ending = "" if format is None else f".{format.lstrip('.')}"
    if isinstance(source, (bytes, bytearray, memoryview)):
        return Model(bytes(source), f"model{ending}")
    if hasattr(source, "read"):
        found = source.read()
        data = found.encode() if isinstance(found, str) else bytes(found)
        return Model(data, f"{getattr(source, 'name', 'model')}{ending}")
    path = os.fspath(source)
    content, name = _bytes(path), f"{path}{ending}"
    beside: dict[str, bytes] = {}
    for other in names_beside(content, name):
        # A file that comes from elsewhere must not choose what is read.
        if not os.path.isabs(other) and ".." not in other.replace("\\", "/").split("/"):
            beside[other] = _bytes(os.path.join(os.path.dirname(path), other))
    return Model(content, name, beside)


def _bytes(path: str) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise NurbsHausdorffError("FILE_UNREADABLE", f"{path}: {error.strerror}") from error


def model(part: Any) -> Model:
    """Make a model of anything that has surfaces, triangles or points.

    Parameters
    ----------
    part : Model, path, bytes, file object, shape, mapping, iterable of mappings, mesh or array
        A shape of build123d, CadQuery or OCP, or an assembly of CadQuery, with the names of its
        parts; interchange JSON as a mapping, or its surfaces:
        ``degree`` (2,), ``knots_u``, ``knots_v``, and ``ctrl`` of shape (m, n, 4) with weights
        that are not multiplied in, or (m, n, 3); the arrays may be NumPy's. A mesh or a scene of
        trimesh, a mesh of meshio, a mesh, grid or blocks of pyvista, or a pair of vertices (n, 3)
        and triangles (m, 3); points (n, 3) as an array, a list, a table of pandas with columns x, y
        and z, or anything that has ``__array__``. Polygons are cut in their plane, and their distance
        from it is the model's `gap`; of a grid the surface is measured.

    Raises
    ------
    NurbsHausdorffError
        ``ARGUMENT_INVALID`` for anything else, and the codes of `read`.
    """
    if isinstance(part, Model):
        return part
    if isinstance(part, (str, os.PathLike, bytes)):
        return read(part)
    if isinstance(part, Mapping):
        document = part if "surfaces" in part else {"surfaces": [part]}
        return _of_arrays(document)
    if hasattr(part, "toCompound") and callable(getattr(part, "save", None)):
        return Model(_step_text(part), type(part).__name__)
    shape = _ocp_shape(part)
    if shape is not None:
        return Model(_brep_text(shape), type(part).__name__)
    found = facets(part)
    if found is not None:
        return Model(found, type(part).__name__)
    if hasattr(part, "read"):
        return read(part)
    if isinstance(part, Iterable):
        surfaces = list(part)
        if surfaces and all(isinstance(surface, Mapping) for surface in surfaces):
            return _of_arrays({"surfaces": surfaces})
    raise NurbsHausdorffError(
        "ARGUMENT_INVALID",
        f"found {type(part).__name__}, expected a path, bytes, a file object, a shape of "
        "build123d, CadQuery or OCP, surfaces as mappings, a mesh, or points of shape (n, 3)",
    )


#: Keys of a surface in the interchange JSON.
_SURFACE_KEYS = frozenset(
    "degree knots_u knots_v ctrl trim reversed part kind gap gap_measured color shell solid".split()
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
    if callable(getattr(part, "vals", None)):
        return _compound([_ocp_shape(value) for value in part.vals()])
    elif hasattr(part, "part") and hasattr(part, "_obj"):
        # A builder of build123d.
        part = part.part
    shape = getattr(part, "wrapped", part)
    return shape if type(shape).__module__.startswith("OCP.") else None


#: Names that CadQuery gives to parts without one. They differ at each run.
_GIVEN_NAME = re.compile(rb"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")


def _step_text(assembly: Any) -> bytes:
    """Return the STEP file of an assembly of CadQuery, whose compound has no names."""
    export = getattr(assembly, "export", None) or assembly.save
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "assembly.step")
        export(path)
        content = _bytes(path)
    numbers: dict[bytes, int] = {}

    def numbered(found: re.Match[bytes]) -> bytes:
        return b"part %d" % numbers.setdefault(found[0], len(numbers) + 1)

    return _GIVEN_NAME.sub(numbered, content)


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
