"""Shapes of CadQuery and OCP, where these are installed: `pip install cadquery pytest`."""

import re
from pathlib import Path

import pytest

import nurbs_hausdorff as nh
from bored_plate import FAR, RADIUS, SHIFT, SIZE, is_score_of_a_moved_bore, named

cq = pytest.importorskip("cadquery")


def test_a_moved_bore_of_cadquery_is_named_on_both_sides():
    def plate(x):
        return cq.Workplane().box(*SIZE).center(x, 0).circle(RADIUS).cutThruAll()

    bored, moved = plate(5), plate(5 + SHIFT)
    nh.testing.assert_shapes_close(bored, bored.val())
    with pytest.raises(AssertionError) as raised:
        nh.testing.assert_shapes_close(moved, bored, limit=1e-3)
    for part, side in ((moved, "actual"), (bored, "expected")):
        (bore,) = [i for i, face in enumerate(part.val().Faces()) if face.geomType() == "CYLINDER"]
        assert bore in named(str(raised.value), side)


def test_shapes_of_cadquery_are_scored_by_the_four_lines_of_the_readme(capsys):
    readme = Path(__file__).parents[2] / "README.md"
    if not readme.exists():
        pytest.skip("the tests are not beside the repository")
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(), re.DOTALL)
    [block] = [block for block in blocks if "cadquery" in block]
    names = {}
    exec(compile(block, str(readme), "exec"), names)
    assert is_score_of_a_moved_bore(names["found"])
    assert len(block.strip().splitlines()) == 4 and capsys.readouterr().out


def test_stacks_and_assemblies_of_cadquery_are_read():
    boxes = cq.Workplane().rarray(3, 1, 2, 1).box(1, 1, 1)
    assert nh.model(boxes).face_count == 12
    assembly = cq.Assembly().add(cq.Workplane().box(1, 1, 1)).add(
        cq.Workplane().box(1, 1, 1), loc=cq.Location((3, 0, 0))
    )
    model = nh.model(assembly)
    assert model.face_count == 12 and model.bounding_box.tolist() == [[-0.5] * 3, [3.5, 0.5, 0.5]]


def test_assemblies_of_cadquery_have_the_names_of_their_parts():
    def pump(*names):
        parts = cq.Assembly(name="pump")
        for index, name in enumerate(names):
            place = cq.Location((0.5 * index, 0, 0))
            parts.add(cq.Workplane().box(1, 1, 1), name=name, loc=place)
        return parts

    found = nh.check(pump("housing", "shaft"))
    assert {found.pairs[0].a, found.pairs[0].b} == {"pump / housing", "pump / shaft"}
    rules = {"intended": [{"a": "**/housing", "b": "**/shaft"}]}
    assert nh.check(pump("housing", "shaft"), rules=rules).clean
    with pytest.raises(AssertionError, match="spindle"):
        nh.testing.assert_same_assembly(pump("housing", "shaft"), pump("housing", "spindle"), limit=1e-3)
    # What CadQuery names by itself has another name at each run, and the same number.
    nh.testing.assert_same_assembly(pump(None, None), pump(None, None), limit=1e-3)


def test_files_written_by_ocp_are_what_was_written(tmp_path):
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
