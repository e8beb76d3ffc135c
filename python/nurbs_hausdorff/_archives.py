"""Files within others: what gzip compressed, and the shapes of FreeCAD documents."""

from __future__ import annotations

import gzip
import io
import zipfile
import zlib
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from ._errors import NurbsHausdorffError

#: The longest file that is unpacked, as of the package in JavaScript.
MAX_BYTES = 256 << 20

_GZIP, _ZIP = b"\x1f\x8b", b"PK\x03\x04"

_PLACED = "its parts are placed by a container: export the document as STEP"
_BINARY = "its shape is stored in binary: export the document as STEP"


def inflated(source: bytes, path: str) -> tuple[bytes, str]:
    """Return what gzip compressed, and its name; anything else as it is."""
    if not source.startswith(_GZIP):
        return source, path
    try:
        with gzip.open(io.BytesIO(source)) as stream:
            content = stream.read(MAX_BYTES + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise NurbsHausdorffError("CAD_UNREADABLE", f"{path}: {error}") from error
    _check_length(len(content), path)
    return content, path.removesuffix(".gz")


def _check_length(length: int, path: str) -> None:
    if length > MAX_BYTES:
        raise NurbsHausdorffError(
            "FILE_TOO_LARGE", f"{path}: found more than {MAX_BYTES} bytes when unpacked"
        )


#: Metres per unit of FreeCAD's shapes.
FREECAD_UNIT = 0.001

_IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]


@dataclass(frozen=True)
class Document:
    """The visible shapes of a FreeCAD document by their names, as BREP text, and those that are
    not read with the reason."""

    shapes: list[tuple[str, bytes]]
    skipped: list[tuple[str, str]]


def freecad_document(source: bytes, path: str) -> Document | None:
    """Return the shapes of a FreeCAD document, or None for any other file. A body's features
    are left out, as the body's own shape is that of the last."""
    if not source.startswith(_ZIP):
        return None
    try:
        with zipfile.ZipFile(io.BytesIO(source)) as archive:
            if "Document.xml" not in archive.namelist():
                return None
            return _document(archive, path)
    except (zipfile.BadZipFile, ElementTree.ParseError, zlib.error, NotImplementedError) as error:
        raise NurbsHausdorffError("CAD_UNREADABLE", f"{path}: {error}") from error


def _document(archive: zipfile.ZipFile, path: str) -> Document:
    def content(name: str) -> bytes:
        if name not in archive.namelist():
            return b""
        _check_length(archive.getinfo(name).file_size, path)
        return archive.read(name)

    objects = _named(content("Document.xml"), "ObjectData", "Object")
    views = _named(content("GuiDocument.xml") or b"<Document/>", "ViewProviderData", "ViewProvider")
    hidden = {name for name, view in views if _is_hidden(view)}
    members = {
        link.get("value")
        for _, one in objects
        if _property(one, "Tip") is not None
        for link in one.iterfind(".//Property[@name='Group']//Link")
    }
    found = Document([], [])
    for name, one in objects:
        if name in hidden or name in members:
            continue
        part = one.find(".//Part[@file]")
        file = "" if part is None else part.get("file", "")
        if _is_container(one):
            found.skipped.append((name, _PLACED))
        elif file.endswith(".bin"):
            found.skipped.append((name, _BINARY))
        elif file:
            found.shapes.append((name, content(file)))
    return found


def _named(xml: bytes, group: str, tag: str) -> list[tuple[str, Element]]:
    root = ElementTree.fromstring(xml)
    return [(one.get("name", ""), one) for one in root.iterfind(f"{group}/{tag}")]


def _property(one: Element, name: str) -> Element | None:
    return one.find(f".//Property[@name='{name}']")


def _is_hidden(view: Element) -> bool:
    value = view.find(".//Property[@name='Visibility']/Bool")
    return value is not None and value.get("value") == "false"


def _is_container(one: Element) -> bool:
    """Whether the object moves others: a link, or a part whose placement is not the identity."""
    is_link = _property(one, "LinkedObject") is not None
    moves = is_link or any(_property(one, name) is not None for name in ("OriginFeatures", "Origin"))
    placement = one.find(".//Property[@name='LinkPlacement']/PropertyPlacement")
    if placement is None:
        placement = one.find(".//Property[@name='Placement']/PropertyPlacement")
    if not moves or _property(one, "Tip") is not None or placement is None:
        return False
    # The fourth of the quaternion is 1 or -1 where the others are 0.
    parts = (placement.get(key) or "0" for key in ("Px", "Py", "Pz", "Q0", "Q1", "Q2"))
    return is_link or any(float(part) != 0.0 for part in parts)


def joined(models: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the faces and placements of several interchange models as those of one, with their
    own numbers of edges."""
    surfaces: list[dict[str, Any]] = []
    instances: list[dict[str, Any]] = []
    edges = 0
    for model in models:
        first, own = len(surfaces), model["surfaces"]
        whole = {"surfaces": list(range(len(own))), "transform": _IDENTITY}
        for one in model.get("instances") or [whole]:
            instances.append({**one, "surfaces": [first + index for index in one["surfaces"]]})
        loops = (loop for face in own for loop in face.get("trim") or [])
        curves = [curve for loop in loops for curve in loop if "edge" in curve]
        for curve in curves:
            curve["edge"] += edges
        edges = max([edges, *(curve["edge"] + 1 for curve in curves)])
        surfaces += own
    document = {"unit": FREECAD_UNIT, "surfaces": surfaces}
    has_instances = any(model.get("instances") for model in models)
    return {**document, "instances": instances} if has_instances else document
