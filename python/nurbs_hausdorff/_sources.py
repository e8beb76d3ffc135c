"""Models of files, of shapes of CAD kernels, and of arrays."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterable, Mapping
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import ArrayLike

from ._errors import NurbsHausdorffError
from ._model import Facets, Model


def read(
    source: str | os.PathLike[str] | bytes | BinaryIO, *, format: str | None = None
) -> Model:
    """Read a file of a CAD model, of a mesh or of points.

    Parameters
    ----------
    source : path, bytes or binary file object
        The file. STEP, IGES, OpenCASCADE's BREP text, FreeCAD documents and interchange JSON are
        known by their content, also where gzip compressed them; STL, PLY, OBJ, glTF, 3MF, points as text, LAS, LAZ and E57
        by the ending of the name.
    format : str, optional
        Ending that tells a mesh where there is no name: ``"stl"``, ``"ply"``, ``"obj"``,
        ``"gltf"``, ``"3mf"``, ``"xyz"``, ``"las"``, ``"e57"``.

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
    try:
        with open(path, "rb") as file:
            return Model(file.read(), f"{path}{ending}")
    except OSError as error:
        raise NurbsHausdorffError("FILE_UNREADABLE", f"{path}: {error.strerror}") from error


def model(part: Any) -> Model:
    """Make a model of anything that has surfaces, triangles or points.

    Parameters
    ----------
    part : Model, path, bytes, file object, shape, mapping, iterable of mappings, mesh or array
        A shape of build123d, CadQuery or OCP; interchange JSON as a mapping, or its surfaces:
        ``degree`` (2,), ``knots_u``, ``knots_v``, and ``ctrl`` of shape (m, n, 4) with weights
        that are not multiplied in, or (m, n, 3); the arrays may be NumPy's. A mesh of trimesh or
        pyvista, or a pair of vertices (n, 3) and triangles (m, 3); points (n, 3).

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
    facets = _facets(part)
    if facets is not None:
        return Model(facets, type(part).__name__)
    if isinstance(part, Iterable) and not hasattr(part, "dtype"):
        surfaces = list(part)
        if surfaces and all(isinstance(surface, Mapping) for surface in surfaces):
            return _of_arrays({"surfaces": surfaces})
    raise NurbsHausdorffError(
        "ARGUMENT_INVALID",
        f"found {type(part).__name__}, expected a path, bytes, a file object, a shape of "
        "build123d, CadQuery or OCP, surfaces as mappings, a mesh, or points of shape (n, 3)",
    )


def _facets(part: Any) -> Facets | None:
    """Return the triangles or points of a part, or None."""
    if hasattr(part, "vertices") and hasattr(part, "faces"):
        # trimesh.Trimesh
        return _of_indices(part.vertices, part.faces)
    if hasattr(part, "regular_faces") and hasattr(part, "points"):
        # pyvista.PolyData
        if part.n_cells == part.n_verts:
            return Facets(_rows("points", part.points))
        triangles = part if part.is_all_triangles else part.triangulate()
        return _of_indices(triangles.points, triangles.regular_faces)
    if hasattr(part, "vertices") and not callable(part.vertices):
        # trimesh.PointCloud
        return Facets(_rows("points", part.vertices))
    if isinstance(part, tuple) and len(part) == 2:
        return _of_indices(*part)
    if isinstance(part, np.ndarray):
        return Facets(_rows("points", part))
    return None


def _of_indices(vertices: ArrayLike, triangles: ArrayLike) -> Facets:
    indices = np.asarray(triangles)
    if indices.ndim != 2 or indices.shape[1] != 3 or indices.dtype.kind not in "iu":
        raise NurbsHausdorffError(
            "ARGUMENT_INVALID",
            f"triangles are {indices.dtype} of shape {indices.shape}, expected integers of "
            "shape (m, 3)",
        )
    if indices.size and (indices.min() < 0 or indices.max() > np.iinfo(np.uint32).max):
        raise NurbsHausdorffError(
            "TRIANGLE_INDEX", f"triangles have indices from {indices.min()} to {indices.max()}"
        )
    rows = np.ascontiguousarray(indices, dtype=np.uint32)
    return Facets(_rows("vertices", vertices), rows)


def _rows(name: str, values: ArrayLike) -> Any:
    rows = np.ascontiguousarray(values, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise NurbsHausdorffError(
            "ARGUMENT_INVALID", f"{name} have shape {rows.shape}, expected (n, 3)"
        )
    return rows


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
