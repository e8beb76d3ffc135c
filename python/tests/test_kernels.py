"""Shapes of build123d, CadQuery and OCP, where these are installed.

Neither build123d nor CadQuery is light, and their versions of OCP differ: each in an environment
of its own, `pip install build123d pyvista pytest` and `pip install cadquery pytest`.
"""

import math
import pickle
import re
from pathlib import Path

import pytest

import nurbs_hausdorff as nh

#: A plate of 40 x 30 x 10 with a bore of radius 4 through it, and how far that is moved.
SIZE, RADIUS, SHIFT = (40.0, 30.0, 10.0), 4.0, 0.01


#: How far the bore of a scored plate is moved.
FAR = 0.5


def ratio_of_moved_bores():
    """The volume of the intersection of two plates with moved bores over that of their union."""
    disc = math.pi * RADIUS**2
    both = 2 * RADIUS**2 * math.acos(FAR / 2 / RADIUS) - FAR / 2 * math.sqrt(4 * RADIUS**2 - FAR**2)
    plate = SIZE[0] * SIZE[1]
    return (plate - (2 * disc - both)) / (plate - both)


def holds(found, expected):
    return found.lower <= expected <= found.upper


def is_score_of_a_moved_bore(found):
    """Whether the numbers of a plate with a moved bore are those of the formulas."""
    assert found.converged and holds(found.candidate.valid, 1) and found.candidate.bodies == 1
    assert holds(found.hausdorff.distance, FAR) and holds(found.volume.ratio, 1)
    assert holds(found.iou, ratio_of_moved_bores()) and found.iou.upper - found.iou.lower < 5e-3
    length = 4 * sum(SIZE) + 2 * 2 * math.pi * RADIUS
    assert holds(found.edge_length.candidate, length) and holds(found.edge_length.truth, length)
    assert found.thresholds[0].f1.upper < 1 and found.thresholds[0].edge_f1.upper < 1
    return True


def named(message, side):
    """The faces of one side that a failed assertion names."""
    lines = (line.split(f"changed: {side} face ") for line in message.splitlines())
    return {int(line[1].split()[0].rstrip(":")) for line in lines if len(line) == 2}


def test_a_moved_bore_of_build123d_is_named_on_both_sides():
    b3d = pytest.importorskip("build123d")

    def plate(x):
        return b3d.Box(*SIZE) - b3d.Pos(x, 0, 0) * b3d.Cylinder(RADIUS, SIZE[2])

    bored, moved = plate(5), plate(5 + SHIFT)
    nh.testing.assert_shapes_close(bored, plate(5))
    nh.testing.assert_shapes_close(moved, bored, limit=1.01 * SHIFT)
    with pytest.raises(AssertionError) as raised:
        nh.testing.assert_shapes_close(moved, bored, limit=1e-3)
    for part, side in ((moved, "actual"), (bored, "expected")):
        (bore,) = [i for i, face in enumerate(part.faces()) if face.geom_type == b3d.GeomType.CYLINDER]
        assert bore in named(str(raised.value), side)
    result = nh.distance(moved, bored, symmetric=True)
    assert result.lower <= SHIFT <= result.upper


def test_shapes_and_builders_of_build123d_are_read():
    b3d = pytest.importorskip("build123d")
    with b3d.BuildPart() as builder:
        b3d.Box(*SIZE)
    for part in (b3d.Box(*SIZE), builder, b3d.Box(*SIZE).wrapped):
        model = nh.model(part)
        lower, upper = model.area
        assert model.face_count == 6 and lower <= 3800 <= upper and upper - lower < 1e-6
    assert pickle.loads(pickle.dumps(model)).kind == "brep"
    # Of different places: the shape's location counts.
    apart = nh.clearance(b3d.Box(1, 1, 1), b3d.Pos(3, 0, 0) * b3d.Box(1, 1, 1))
    assert apart.lower <= 2 <= apart.upper


def test_a_moved_bore_of_cadquery_is_named_on_both_sides():
    cq = pytest.importorskip("cadquery")

    def plate(x):
        return cq.Workplane().box(*SIZE).center(x, 0).circle(RADIUS).cutThruAll()

    bored, moved = plate(5), plate(5 + SHIFT)
    nh.testing.assert_shapes_close(bored, bored.val())
    with pytest.raises(AssertionError) as raised:
        nh.testing.assert_shapes_close(moved, bored, limit=1e-3)
    for part, side in ((moved, "actual"), (bored, "expected")):
        (bore,) = [i for i, face in enumerate(part.val().Faces()) if face.geomType() == "CYLINDER"]
        assert bore in named(str(raised.value), side)


def test_shapes_of_build123d_are_scored():
    b3d = pytest.importorskip("build123d")

    def plate(x):
        return b3d.Box(*SIZE) - b3d.Pos(x, 0, 0) * b3d.Cylinder(RADIUS, SIZE[2])

    assert is_score_of_a_moved_bore(nh.score(plate(5 + FAR), plate(5), thresholds=[0.1]))


def test_shapes_of_cadquery_are_scored_by_the_four_lines_of_the_readme(capsys):
    pytest.importorskip("cadquery")
    readme = Path(__file__).parents[1] / "README.md"
    if not readme.exists():
        pytest.skip("the tests are not beside the repository")
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(), re.DOTALL)
    [block] = [block for block in blocks if "cadquery" in block]
    names = {}
    exec(compile(block, str(readme), "exec"), names)
    assert is_score_of_a_moved_bore(names["found"])
    assert len(block.strip().splitlines()) == 4 and capsys.readouterr().out


def test_stacks_and_assemblies_of_cadquery_are_read():
    cq = pytest.importorskip("cadquery")
    boxes = cq.Workplane().rarray(3, 1, 2, 1).box(1, 1, 1)
    assert nh.model(boxes).face_count == 12
    assembly = cq.Assembly().add(cq.Workplane().box(1, 1, 1)).add(
        cq.Workplane().box(1, 1, 1), loc=cq.Location((3, 0, 0))
    )
    model = nh.model(assembly)
    assert model.face_count == 12 and model.bounding_box.tolist() == [[-0.5] * 3, [3.5, 0.5, 0.5]]


def test_files_written_by_ocp_are_what_was_written(tmp_path):
    pytest.importorskip("OCP")
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    shape = BRepPrimAPI_MakeCylinder(2.0, 3.0).Shape()
    writer = STEPControl_Writer()
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    path = tmp_path / "cylinder.step"
    assert writer.Write(str(path)) == IFSelect_ReturnStatus.IFSelect_RetDone
    nh.testing.assert_shapes_close(shape, path, limit=1e-9)
    found = nh.closest_points(shape, [[0, 0, 1.5], [5, 0, 1]])
    assert found.distances == pytest.approx([1.5, 3.0])
    assert found.signed == pytest.approx([-1.5, 3.0])
