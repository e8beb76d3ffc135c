"""Triangles and points of what other packages hold.

Nothing of them is imported: a part is known by what it has.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._values.arrays import plain, refused, rows
from ._errors import NurbsHausdorffError
from ._model import Facets

#: Names of meshio for cells that are triangles or plane polygons, and for those without area.
_SURFACES = ("triangle", "quad", "polygon")
_NO_SURFACE = ("vertex", "line")

#: First of VTK's types of cells that are not linear.
_FIRST_CURVED = 21

#: Corners of a triangle.
_TRIANGLE = 3


def facets(part: Any) -> Facets | bytes | None:
    """Return the triangles or points of a part; the bytes of an OFF file where it has polygons of
    more corners, which the reader cuts; None if it has neither.

    Raises
    ------
    NurbsHausdorffError
        ``ARGUMENT_INVALID`` for lines alone, volumes, curved cells, and arrays that are not real
        numbers of shape (n, 3).
    """
    if hasattr(part, "vertices") and hasattr(part, "entities"):
        raise refused(f"{type(part).__name__} is a path of lines, which is no surface")
    if hasattr(part, "geometry") and hasattr(part, "dump"):
        # trimesh.Scene: its meshes at their places.
        return _joined(part.dump())
    if hasattr(part, "vertices") and hasattr(part, "faces"):
        # trimesh.Trimesh
        return of_indices(part.vertices, part.faces)
    if hasattr(part, "points") and hasattr(part, "cells_dict") and hasattr(part, "cell_data_dict"):
        # meshio.Mesh
        return _of_blocks(part.points, [(block.type, block.data) for block in part.cells])
    if hasattr(part, "regular_faces") and hasattr(part, "points"):
        # pyvista.PolyData
        return _of_poly_data(part)
    if hasattr(part, "extract_surface") and hasattr(part, "n_cells"):
        # Grids of pyvista: the surface of their cells.
        if any(kind >= _FIRST_CURVED for kind in np.unique(getattr(part, "celltypes", []))):
            raise refused(f"{type(part).__name__} has curved cells, expected linear ones")
        return _of_poly_data(part.extract_surface())
    if hasattr(part, "n_blocks") and hasattr(part, "keys"):
        # pyvista.MultiBlock
        return _joined([block for block in part if block is not None])
    if hasattr(part, "vertices") and not callable(part.vertices):
        # trimesh.PointCloud
        return Facets(rows("points", part.vertices))
    if isinstance(part, tuple) and len(part) == 2 and all(plain("pairs", one).ndim == 2 for one in part):
        return of_indices(*part)
    if hasattr(part, "columns") and hasattr(part, "to_numpy"):
        return Facets(rows("points", _of_frame(part)))
    if isinstance(part, np.ndarray) or hasattr(part, "__array__"):
        return Facets(rows("points", part))
    if isinstance(part, (list, tuple)) and part and isinstance(part[0], (Sequence, np.ndarray)):
        return Facets(rows("points", part))
    return None


def of_indices(vertices: ArrayLike, triangles: ArrayLike) -> Facets:
    """Return triangles by the indices of their corners."""
    indices = plain("triangles", triangles)
    if indices.ndim != 2 or indices.shape[1] != _TRIANGLE or indices.dtype.kind not in "iu":
        raise refused(
            f"triangles are {indices.dtype} of shape {indices.shape}, expected integers of "
            "shape (m, 3)"
        )
    if indices.size and (indices.min() < 0 or indices.max() > np.iinfo(np.uint32).max):
        raise NurbsHausdorffError(
            "TRIANGLE_INDEX", f"triangles have indices from {indices.min()} to {indices.max()}"
        )
    return Facets(rows("vertices", vertices), np.ascontiguousarray(indices, dtype=np.uint32))


def _of_frame(frame: Any) -> NDArray[Any]:
    """Return the columns x, y and z of a table, or its three columns."""
    names = {str(column).lower(): column for column in frame.columns}
    if all(axis in names for axis in "xyz"):
        frame = frame[[names[axis] for axis in "xyz"]]
    array: NDArray[Any] = frame.to_numpy()
    return array.astype(np.float64) if array.dtype.kind == "O" else array


def _of_poly_data(part: Any) -> Facets | bytes:
    if part.n_cells == part.n_verts:
        return Facets(rows("points", part.points))
    blocks = [("polygon", _lists(part.faces)), ("strip", _lists(getattr(part, "strips", [])))]
    count = int(getattr(part, "n_lines", 0))
    return _of_blocks(part.points, [*blocks, ("line", [()] * count)])


def _lists(flat: Iterable[int]) -> list[list[int]]:
    """Return lists of a flat one in which each follows its length."""
    numbers = np.asarray(flat).tolist()
    lists, at = [], 0
    while at < len(numbers):
        end = at + 1 + numbers[at]
        lists.append(numbers[at + 1 : end])
        at = end
    return lists


def _of_blocks(points: ArrayLike, blocks: list[tuple[str, Any]]) -> Facets | bytes:
    """Return the triangles of cells by meshio's names of their kinds, or an OFF file of polygons."""
    polygons: list[list[int]] = []
    lines = 0
    for kind, cells in blocks:
        if kind == "strip":
            for strip in cells:
                ends = zip(strip, strip[1:], strip[2:])
                # Every other triangle of a strip is turned over.
                polygons += [[b, a, c] if at % 2 else [a, b, c] for at, (a, b, c) in enumerate(ends)]
        elif kind in _SURFACES or kind.startswith("polygon"):
            polygons += [np.asarray(cell).tolist() for cell in cells]
        elif kind in _NO_SURFACE:
            lines += len(cells) if kind == "line" else 0
        elif len(cells):
            raise refused(f"{len(cells)} cells of the kind {kind!r}, expected triangles or polygons")
    if not polygons and lines:
        raise refused(f"{lines} lines and no polygons, expected a surface or points")
    if lines:
        warnings.warn(f"{lines} lines are no surface and are not measured", stacklevel=5)
    if not polygons:
        return Facets(rows("points", points))
    if all(len(polygon) == _TRIANGLE for polygon in polygons):
        return of_indices(points, polygons)
    return _off(rows("points", points), polygons)


def _off(points: NDArray[np.float64], polygons: list[list[int]]) -> bytes:
    """Return an OFF file, with every coordinate in full precision."""
    lines = [f"OFF\n{len(points)} {len(polygons)} 0"]
    lines += [" ".join(map(repr, point)) for point in points.tolist()]
    lines += [f"{len(polygon)} {' '.join(map(str, polygon))}" for polygon in polygons]
    return "\n".join(lines).encode() + b"\n"


def _joined(parts: Iterable[Any]) -> Facets | bytes:
    """Return the triangles of several meshes as one."""
    found = [facets(part) for part in parts]
    meshes = [one for one in found if isinstance(one, Facets) and one.triangles is not None]
    if len(meshes) < len(found) or not meshes:
        raise refused(f"{len(meshes)} of {len(found)} parts are meshes of triangles, expected all")
    counts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    moved = [mesh.triangles + first for mesh, first in zip(meshes, counts)]
    return of_indices(np.vstack([mesh.vertices for mesh in meshes]), np.vstack(moved))
