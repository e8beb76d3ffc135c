"""Files that gzip compressed, and FreeCAD documents."""

import gzip
import io
import json
import pickle
import zipfile
from pathlib import Path

import pytest

import nurbs_hausdorff as nh

#: The unit square of the plane z = 0, written by OpenCASCADE.
SQUARE = (Path(__file__).parent / "files" / "square.brep").read_bytes()

TIP = '<Property name="Tip"/><Property name="Group"><LinkList><Link value="Pad"/></LinkList></Property>'
LINK = (
    '<Property name="LinkedObject"/><Property name="LinkPlacement">'
    '<PropertyPlacement Px="1"/></Property>'
)


def document(objects, files):
    """A FreeCAD document: objects by name with a file, properties and visibility."""
    datas, views = "", ""
    for name, file, more, visible in objects:
        shape = f'<Property name="Shape"><Part file="{file}"/></Property>' if file else ""
        datas += f'<Object name="{name}"><Properties>{shape}{more}</Properties></Object>'
        views += (
            f'<ViewProvider name="{name}"><Properties><Property name="Visibility">'
            f'<Bool value="{visible}"/></Property></Properties></ViewProvider>'
        )
    texts = {
        "Document.xml": f"<Document><ObjectData>{datas}</ObjectData></Document>",
        "GuiDocument.xml": f"<Document><ViewProviderData>{views}</ViewProviderData></Document>",
        **files,
    }
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in texts.items():
            archive.writestr(name, text)
    return stream.getvalue()


def test_the_visible_shapes_of_a_document_are_one_model(tmp_path):
    objects = [
        ("Box", "a.brp", "", "true"),
        ("Hidden", "a.brp", "", "false"),
        ("Pad", "a.brp", "", "true"),
        ("Body", "a.brp", TIP, "true"),
        ("Sketch", "empty.brp", "", "true"),
    ]
    path = tmp_path / "part.FCStd"
    path.write_bytes(document(objects, {"a.brp": SQUARE, "empty.brp": ""}))
    model = nh.read(path)
    assert (model.kind, model.face_count, model.unit) == ("fcstd", 2, 1e-3)
    assert (model.report.faces, model.report.trims, model.report.skipped) == (2, 8, ())
    # Neighbours are known by their edges: every shape has its own.
    faces = json.loads(model.to_json())["surfaces"]
    edges = [curve["edge"] for face in faces for loop in face.get("trim", []) for curve in loop]
    assert len(edges) == len(set(edges))
    lower, upper = model.area
    assert lower <= 2 <= upper
    again = pickle.loads(pickle.dumps(model))
    assert again.kind == "fcstd" and again.report == model.report
    assert nh.distance(model, nh.read(SQUARE), symmetric=True).upper < 1e-6


def test_what_a_document_has_besides_is_named():
    objects = [
        ("Box", "a.brp", "", "true"),
        ("Copy", "", LINK, "true"),
        ("Binary", "shape.bin", "", "true"),
        ("Broken", "broken.brp", "", "true"),
    ]
    files = {"a.brp": SQUARE, "shape.bin": b"", "broken.brp": "CASCADE Topology V9"}
    report = nh.read(document(objects, files)).report
    assert report.faces == 1 and {remark.face for remark in report.skipped} == {"Copy", "Binary", "Broken"}
    for part, code in [
        (document([("Hidden", "a.brp", "", "false")], {"a.brp": SQUARE}), "EMPTY_MODEL"),
        (document(objects, files)[:200], "CAD_UNREADABLE"),
        (gzip.compress(SQUARE)[:50], "CAD_UNREADABLE"),
    ]:
        with pytest.raises(nh.NurbsHausdorffError) as raised:
            nh.read(part)
        assert raised.value.code == code


def test_files_that_gzip_compressed_are_read(tmp_path):
    assert nh.read(gzip.compress(SQUARE)).kind == "brep"
    path = tmp_path / "points.xyz.gz"
    path.write_bytes(gzip.compress(b"0 0 0\n1 2 3\n"))
    assert (nh.read(path).kind, nh.read(path).facet_count) == ("points", 2)


def test_what_is_unpacked_has_a_largest_length():
    # Half a gibibyte of zeros, of which 256 MiB would be read.
    packed = gzip.compress(bytes(1 << 20), 1) * 512
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.read(packed)
    assert raised.value.code == "FILE_TOO_LARGE"
