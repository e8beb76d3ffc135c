"""Files, threads, cancelling and other libraries."""

import io
import json
import multiprocessing
import pickle
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version

import numpy as np
import pytest

import nurbs_hausdorff as nh

#: A bicubic sheet over the unit square with a weight of its own: a large one makes a search
#: against another take long.
KNOTS = [0, 0, 0, 0, 1, 1, 1, 1]


def sheet(weight=1.0, height=0.0):
    x, y = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 1, 4), indexing="ij")
    ctrl = np.stack([x, y, height + 0.3 * np.sin(5 * x) * np.cos(4 * y), np.ones((4, 4))], axis=2)
    ctrl[1, 1, 3] = weight
    return {"degree": [3, 3], "knots_u": KNOTS, "knots_v": KNOTS, "ctrl": ctrl}


def long_search(**options):
    return nh.distance(sheet(1e8), sheet(), relative_tolerance=1e-12, **options)


def test_files_bytes_and_streams_are_the_same_model(tmp_path):
    text = nh.model(sheet()).to_json()
    path = tmp_path / "sheet.json"
    path.write_text(text)
    models = [nh.read(path), nh.read(str(path)), nh.read(text.encode()), nh.read(io.BytesIO(text.encode()))]
    for model in models:
        assert (model.kind, model.face_count, model.report.faces) == ("json", 1, 1)
        assert model.to_json() == text
    lower, upper = models[0].area
    assert lower <= upper and upper - lower < 1e-6 * upper
    with pytest.raises(nh.NurbsHausdorffError, match="nothing-here") as raised:
        nh.read(tmp_path / "nothing-here.step")
    assert raised.value.code == "FILE_UNREADABLE"
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.read(b"ISO-10303-21; broken")
    assert raised.value.code.startswith("STEP_")


def test_faces_have_paths_and_colours():
    data = json.loads(nh.model(sheet()).to_json())
    [face] = data["surfaces"]
    named = {**face, "part": "machine / in // out / face 3", "color": [1.0, 0.5, 0.0]}
    model = nh.read(json.dumps({**data, "surfaces": [named, face]}).encode())
    assert model.face_paths == [["machine", "in / out", "face 3"], []]
    assert model.face_colors == [(1.0, 0.5, 0.0), None]


def test_documents_go_back_and_forth_with_colours_and_shells():
    data = json.loads(nh.model(sheet()).to_json())
    [face] = data["surfaces"]
    data["surfaces"] = [{**face, "color": [1.0, 0.5, 0.0], "shell": 4, "solid": 2}, face]
    again = json.loads(nh.model(data).to_json())
    assert [face.get("shell") for face in again["surfaces"]] == [4, None]
    assert [face.get("solid") for face in again["surfaces"]] == [2, None]
    assert [face.get("color") for face in again["surfaces"]] == [[1.0, 0.5, 0.0], None]


def test_wrong_arguments_are_refused_by_a_code():
    for part, code in [
        (3.0, "ARGUMENT_INVALID"),
        ({**sheet(), "colour": "red"}, "ARGUMENT_INVALID"),
        ({**sheet(), "knots_u": [1, 0, 0, 0, 1, 1, 1, 1]}, "KNOTS_DECREASING"),
    ]:
        with pytest.raises(nh.NurbsHausdorffError) as raised:
            nh.model(part)
        assert raised.value.code == code
    with pytest.raises(TypeError, match="tolerence"):
        nh.distance(sheet(), sheet(), tolerence=1e-3)
    # Of another method.
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.distance(sheet(), sheet(), grid=8)
    assert raised.value.code == "OPTION_INVALID"
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.closest_points(sheet(), [1.0, 2.0])
    assert raised.value.code == "ARGUMENT_INVALID"


@pytest.mark.parametrize("method", ["iteration", "hierarchy"])
def test_the_methods_of_the_papers_bound_the_distance(method):
    result = nh.distance(sheet(), sheet(height=0.25), method=method, backend="cpu")
    assert result.lower <= 0.25 + 1e-12 and result.details
    assert result.method == method


def test_a_transform_moves_a():
    turned = nh.Transform.from_matrix([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]])
    flat = {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1]}
    corners = np.array([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], float)
    turned_corners = corners[..., [1, 0, 2]] * [-1, 1, 1] + [0, 0, 5]
    there = nh.distance({**flat, "ctrl": corners}, {**flat, "ctrl": turned_corners}, transform=turned)
    assert there.upper < 1e-6
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        nh.Transform.from_matrix(2 * np.eye(4))
    assert raised.value.code == "TRANSFORM_NOT_RIGID"


def test_a_gap_is_beside_the_interval():
    result = nh.distance({**sheet(), "gap": 0.25}, sheet(height=3.0), limit=3.1)
    assert result.within is True and result.with_gaps.within is None
    assert result.with_gaps.lower <= result.lower - 0.25 and result.gap_proven


def test_threads_share_a_model():
    fixed = nh.model(sheet())
    heights = [0.1 * index for index in range(12)]
    with ThreadPoolExecutor(4) as threads:
        found = list(threads.map(lambda height: nh.distance(sheet(height=height), fixed), heights))
    for height, result in zip(heights, found, strict=True):
        assert result.lower <= height + 1e-12


def test_cancelling_raises_with_the_interval():
    event = threading.Event()
    threading.Timer(0.2, event.set).start()
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        long_search(cancel=event)
    assert raised.value.code == "CANCELLED"
    lower, upper = raised.value.interval
    assert 0 <= lower < upper


@pytest.mark.parametrize("measure", [nh.distance, nh.statistics, nh.clearance, nh.diff, nh.field])
def test_what_is_cancelled_before_does_not_begin(measure):
    event = threading.Event()
    event.set()
    with pytest.raises(nh.NurbsHausdorffError) as raised:
        measure(sheet(), sheet(height=1.0), cancel=event)
    assert raised.value.code == "CANCELLED"


def test_the_version_is_that_of_the_package():
    assert nh.__version__ == version("nurbs-hausdorff")


def test_progress_is_that_of_tqdm():
    class Bar:
        total = 200.0
        done = 0.0

        def update(self, part):
            self.done += part

    bar = Bar()
    nh.field(sheet(), sheet(height=1.0), samples=300, progress=bar)
    assert abs(bar.done - 200.0) < 1e-9


def test_a_true_progress_is_a_bar_of_tqdm(capsys):
    pytest.importorskip("tqdm")
    nh.distance(sheet(), sheet(height=1.0), progress=True)
    assert "|" in capsys.readouterr().err


def test_an_interrupt_ends_a_search():
    program = (
        "import signal, threading, sys; sys.path.insert(0, sys.argv[1])\n"
        "import test_use\n"
        "threading.Timer(0.5, signal.raise_signal, [signal.SIGINT]).start()\n"
        "try:\n    test_use.long_search()\nexcept KeyboardInterrupt:\n    sys.exit(7)\n"
    )
    folder = __file__.rsplit("test_use", 1)[0]
    done = subprocess.run([sys.executable, "-c", program, folder], timeout=120)
    assert done.returncode == 7


def _distance_in_fork(queue, model):
    queue.put(nh.distance(model, sheet(height=1.0)).upper)


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="processes are not forked here")
def test_forked_processes_compute():
    fixed = nh.model(sheet())
    nh.distance(fixed, sheet(height=1.0))
    forks = multiprocessing.get_context("fork")
    queue = forks.Queue()
    process = forks.Process(target=_distance_in_fork, args=(queue, fixed))
    process.start()
    assert queue.get(timeout=120) >= 1.0 - 1e-12
    process.join(60)
    assert process.exitcode == 0


def test_results_are_shown_and_pickled():
    result = nh.distance(sheet(), sheet(height=1.0))
    assert "to" in result._repr_html_() and "<table>" in nh.model(sheet())._repr_html_()
    assert pickle.loads(pickle.dumps(result)) == result
    compared = nh.diff(sheet(), sheet(height=1.0))
    assert compared.state == "changed" and "face 0" in compared._repr_html_()


def test_triangles_are_near_the_surface():
    mesh = nh.model(sheet()).tessellate(tolerance=1e-3)
    assert mesh.triangles.max() < len(mesh.vertices) == len(mesh.normals)
    assert set(mesh.face_of_triangle) == {0}
    found = nh.closest_points(sheet(), mesh.vertices)
    assert found.signs == "faces" and found.distances.max() < 1e-5


def test_a_histogram_has_the_area_of_the_model():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib.figure import Figure

    field = nh.field(sheet(), sheet(height=1.0), samples=40)
    axes = field.hist(Figure().add_subplot(), bins=20)
    drawn = sum(bar.get_height() for bar in axes.patches)
    assert len(axes.patches) == 20 and drawn == pytest.approx(field.statistics.area)
    lower, upper = nh.model(sheet()).area
    assert drawn == pytest.approx((lower + upper) / 2, rel=1e-3)
