"""What several results have."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import Any, Literal

Stop = Literal["converged", "cells", "time", "precision", "cancelled"]
Point = tuple[float, float, float]


@dataclass(frozen=True)
class SurfacePoint:
    """A point of a model.

    Attributes
    ----------
    face : int
        Index of its face.
    u, v : float
        Its parameters there; on a triangle the weights of the second and third corner.
    point : tuple of float
        Its coordinates.
    face_name : str or None
        Name of the face.
    triangle, barycentric : int and tuple of float, or None
        On a mesh, the triangle and the weights of its corners.
    index : int or None
        In a cloud, the index of the point.
    """

    face: int
    u: float
    v: float
    point: Point
    face_name: str | None = None
    triangle: int | None = None
    barycentric: Point | None = None
    index: int | None = None


@dataclass(frozen=True)
class Witness:
    """A point of each model, whose distance is about the one measured."""

    a: SurfacePoint
    b: SurfacePoint


@dataclass(frozen=True)
class Seconds:
    """Seconds of preparing, compiling for a GPU, and solving."""

    prepare: float
    solve: float
    compile: float = 0.0


@dataclass(frozen=True)
class Audit:
    """Numbers of cells and points at which upper bounds were checked, and the sections of the
    lemmas that were refuted: none, unless the library has a fault. The interval is valid without
    them."""

    cells: int
    points: int
    struck: list[str]


def place(at: SurfacePoint) -> str:
    """Return the face or the facet of a point, and its coordinates."""
    if at.index is not None:
        return f"point {at.index} at {at.point}"
    if at.triangle is not None:
        return f"triangle {at.triangle} at {at.point}"
    return f"{face(at)} at {at.point}"


def face(at: SurfacePoint) -> str:
    """Return the number of a point's face, with the name if it has one that says more."""
    number = f"face {at.face}"
    return number if at.face_name in (None, number) else f"{number} ({at.face_name})"


def table(rows: list[tuple[str, str]]) -> str:
    """Return HTML that notebooks show."""
    cells = (f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in rows)
    return f"<table>{''.join(cells)}</table>"


def witness(data: dict[str, Any]) -> Witness:
    """Make the witness of a native dictionary in snake case."""

    def at(side: dict[str, Any]) -> SurfacePoint:
        tuples: dict[str, Any] = {
            name: tuple(side[name]) for name in ("point", "barycentric") if name in side
        }
        return SurfacePoint(**{**side, **tuples})

    return Witness(at(data["a"]), at(data["b"]))
