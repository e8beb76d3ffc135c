"""Ray and Spark with a worker that is killed in the middle: every pair answered exactly once."""

import importlib.util
import json
import os
import re
import signal
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

#: Pairs of the tests, and the one at which the first worker that comes to it is killed.
PAIRS = 1000
FATAL = 333

#: The first of the pairs that are scored, every hundredth from it on.
SCORED = 53

needs = {
    name: pytest.mark.skipif(importlib.util.find_spec(name) is None, reason=f"there is no {name}")
    for name in ("ray", "pyspark")
}


def has_java():
    """Whether the Java on PATH is one that Spark 4 runs on."""
    try:
        told = subprocess.run(["java", "--version"], capture_output=True, text=True)
    except FileNotFoundError:
        return False
    version = re.match(r"\S+ (\d+)", told.stdout)
    return version is not None and int(version[1]) >= 17


needs_java = pytest.mark.skipif(not has_java(), reason="there is no Java 17 or newer")

#: Bytes of shared memory for each node of Ray: near the least it accepts, as small machines and
#: containers have little.
SHARED_MEMORY = 100_000_000


def square(height):
    """The unit square at a height, as interchange JSON."""
    ctrl = [[[x, y, height, 1] for y in (0, 1)] for x in (0, 1)]
    surface = {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": ctrl}
    return json.dumps({"surfaces": [surface]})


@pytest.fixture
def lines(tmp_path):
    """A file of pairs: pair i is i % 10 apart, but for one whose file is missing."""
    for height in range(10):
        (tmp_path / f"{height}.json").write_text(square(height))
    path = tmp_path / "pairs.jsonl"
    text = [
        {"id": index, "a": str(tmp_path / "0.json"), "b": str(tmp_path / f"{index % 10}.json")}
        for index in range(PAIRS)
    ]
    text[7]["b"] = "missing.step"
    for line in text[SCORED::100]:
        line |= {"command": "score", "thresholds": [4.0]}
    path.write_text("".join(json.dumps(line) + "\n" for line in text))
    return path


def check(answers):
    """Fail unless every pair is answered once, and rightly."""
    assert Counter(answer["id"] for answer in answers) == Counter(range(PAIRS))
    for answer in answers:
        if answer["id"] == 7:
            assert answer["error"]["code"] == "FILE_UNREADABLE"
        elif answer["id"] % 100 == SCORED:
            # Squares at the distance 3, and their borders.
            (at,) = answer["thresholds"]
            for found, expected in ((answer["chamfer"], 6), (at["normalF1"], 1), (at["edgeF1"], 1)):
                assert found["lower"] <= expected <= found["upper"]
        else:
            assert answer["lower"] <= answer["id"] % 10 <= answer["upper"]


def die_once(marker, line):
    """End this process as a lost machine does, at the fatal pair, the first time."""
    if json.loads(line)["id"] == FATAL and not os.path.exists(marker):
        Path(marker).touch()
        os.kill(os.getpid(), signal.SIGKILL)


@needs["ray"]
def test_ray_with_two_nodes_and_a_killed_worker(lines, tmp_path):
    import pairs
    import ray
    import ray_pairs
    from ray.cluster_utils import Cluster

    marker = str(tmp_path / "killed")

    class Mortal(ray_pairs.Compare):
        def __call__(self, batch):
            for line in batch["text"]:
                die_once(marker, line)
            return super().__call__(batch)

    node = {"num_cpus": 2, "object_store_memory": SHARED_MEMORY}
    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"
    cluster = Cluster(initialize_head=True, head_node_args={**node, "include_dashboard": False})
    cluster.add_node(**node)
    path = os.pathsep.join([str(HERE), os.environ.get("PYTHONPATH", "")])
    ray.init(address=cluster.address, runtime_env={"env_vars": {"PYTHONPATH": path}})
    # The class of the test is sent by value: its module is not on the workers' path.
    ray.cloudpickle.register_pickle_by_value(sys.modules[__name__])
    try:
        ray_pairs.run(str(lines), str(tmp_path / "answers"), (2, 2), Mortal)
    finally:
        ray.shutdown()
        cluster.shutdown()
    assert os.path.exists(marker) and pairs.KEPT > 0
    written = [
        json.loads(json.loads(line)["answer"])
        for file in sorted((tmp_path / "answers").glob("*.json"))
        for line in file.read_text().splitlines()
    ]
    check(written)


@pytest.fixture(scope="module")
def spark():
    """Two executors, each a process with a core of its own."""
    from pyspark.sql import SparkSession

    os.environ |= {"PYSPARK_PYTHON": sys.executable, "SPARK_LOCAL_IP": "127.0.0.1"}
    session = (
        SparkSession.builder.master("local-cluster[2,1,1024]")
        .config("spark.ui.enabled", "false")
        .config("spark.task.maxFailures", "4")
        .getOrCreate()
    )
    session.sparkContext.addPyFile(str(HERE / "pairs.py"))
    session.sparkContext.addPyFile(str(HERE / "spark_pairs.py"))
    yield session
    session.stop()


def texts(folder):
    """The lines of the committed parts."""
    assert (folder / "_SUCCESS").exists()
    return [
        json.loads(line)
        for file in sorted(folder.glob("part-*"))
        for line in file.read_text().splitlines()
    ]


@needs["pyspark"]
@needs_java
def test_spark_with_two_executors_and_a_killed_worker(spark, lines, tmp_path):
    import spark_pairs

    marker = str(tmp_path / "killed")

    def mortal(batches):
        import pairs

        for batch in batches:
            for line in batch["value"]:
                if json.loads(line)["id"] == FATAL and not os.path.exists(marker):
                    Path(marker).touch()
                    os.kill(os.getpid(), signal.SIGKILL)
            yield batch.assign(value=[pairs.answer(line) for line in batch["value"]])

    spark_pairs.run(spark, str(lines), str(tmp_path / "answers"), mortal)
    assert os.path.exists(marker)
    check(texts(tmp_path / "answers"))


@needs["pyspark"]
@needs_java
@pytest.mark.skipif("NURBS_HAUSDORFF" not in os.environ, reason="there is no native command")
def test_spark_pipes_lines_through_the_native_command(spark, lines, tmp_path):
    command = os.environ["NURBS_HAUSDORFF"]
    # A wrapper that is killed at the first start, with the command below it.
    marker = tmp_path / "killed"
    script = tmp_path / "batch.sh"
    script.write_text(f"#!/bin/sh\nmkdir {marker} 2>/dev/null && kill -9 $$\nexec {command} batch - --jobs 1\n")
    script.chmod(0o755)
    # A pair with an error makes the command end with status 1, which Spark takes for a failure.
    script.write_text(script.read_text().replace("exec ", "") + "[ $? -le 1 ]\n")
    piped = spark.sparkContext.textFile(str(lines), 8).pipe(str(script), checkCode=True)
    piped.saveAsTextFile(str(tmp_path / "answers"))
    assert marker.exists()
    check(texts(tmp_path / "answers"))


def test_lines_have_the_options_of_the_command(tmp_path):
    import pairs

    for height in (0, 2):
        (tmp_path / f"{height}.json").write_text(square(height))
    line = {"id": "x", "a": str(tmp_path / "0.json"), "b": str(tmp_path / "2.json")}
    moved = {"transform": {"translation": [0, 0, 1]}, "relativeTolerance": 1e-3, "symmetric": True}
    found = json.loads(pairs.answer(json.dumps({**line, **moved})))
    assert found["lower"] <= 1 <= found["upper"]
    found = json.loads(pairs.answer(json.dumps({**line, "command": "diff", "limit": 3})))
    assert found["state"] == "unchanged"


@pytest.mark.skipif("NURBS_HAUSDORFF" not in os.environ, reason="there is no native command")
def test_scores_are_summarized_by_the_command(tmp_path):
    import pairs

    for height in range(3):
        (tmp_path / f"{height}.json").write_text(square(height))
    answers = tmp_path / "answers.jsonl"
    lines = [
        {"id": height, "command": "score", "thresholds": [1.5], "atMost": {"chamfer": 9}}
        | {"a": str(tmp_path / f"{height}.json"), "b": str(tmp_path / "0.json")}
        for height in range(3)
    ]
    answers.write_text("".join(pairs.answer(json.dumps(line)) + "\n" for line in lines))
    command = [os.environ["NURBS_HAUSDORFF"], "summary", str(answers), "--format", "json"]
    summary = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    assert summary["pairs"] == 3 and summary["errors"] == 0
    means = {of["number"]: of["mean"] for of in summary["numbers"]}
    # Squares at the distances 0, 1 and 2, of which two are near with their borders.
    for number, mean in (("normalPrecision", 2 / 3), ("edgeRecall", 2 / 3), ("chamfer", 2)):
        assert means[number]["lower"] <= mean <= means[number]["upper"], number


def test_what_is_wrong_with_a_line_is_its_error(tmp_path):
    import pairs

    (tmp_path / "0.json").write_text(square(0))
    path = str(tmp_path / "0.json")
    pair = {"id": 1, "a": path, "b": path}
    wrong = [
        {**pair, "symetric": True},
        {**pair, "command": "measure"},
        {"id": 1, "a": path},
        {**pair, "transform": {"angle": 3}},
    ]
    for line in wrong:
        found = json.loads(pairs.answer(json.dumps(line)))
        assert (found["id"], found["error"]["code"]) == (1, "OPTION_INVALID"), line
    for text in ["no JSON", "[1, 2]", '{"a": "x", "b": "y"}']:
        found = json.loads(pairs.answer(text))
        assert (found["id"], found["error"]["code"]) == (None, "OPTION_INVALID"), text


@needs["ray"]
def test_ray_writes_where_it_is_told(tmp_path, monkeypatch):
    import ray_pairs

    monkeypatch.chdir(tmp_path)
    assert ray_pairs.absolute("answers") == str(tmp_path / "answers")
    assert ray_pairs.absolute("s3://bucket/answers") == "s3://bucket/answers"
    (tmp_path / "answers").mkdir()
    with pytest.raises(SystemExit, match="there already"):
        ray_pairs.run("pairs.jsonl", "answers", (1, 1))


def test_the_score_is_one_only_of_what_is_unchanged(tmp_path):
    for height in (0, 0.0005, 0.5):
        (tmp_path / f"{height}.json").write_text(square(height))
    (tmp_path / "broken.json").write_text("{")
    names = [str(tmp_path / f"{name}.json") for name in (0, 0.0005, 0.5, "broken")]
    script = HERE.parent / "python" / "score.py"
    done = subprocess.run([sys.executable, str(script), names[0], *names], capture_output=True, text=True)
    scores = [json.loads(line) for line in done.stdout.splitlines()]
    assert [line["score"] for line in scores] == [1.0, 1.0, 0.0, 0.0]
    assert scores[2]["truth"][0]["face"] == 0 and scores[3]["error"] == "JSON_SHAPE"


def test_candidates_are_those_of_equal_area_and_place(tmp_path):
    def write(name, side, height):
        ctrl = [[[side * x, y, height, 1] for y in (0, 1)] for x in (0, 1)]
        surface = {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1], "ctrl": ctrl}
        (tmp_path / name).write_text(json.dumps({"surfaces": [surface]}))

    for name, side, height in [("a", 1, 0), ("near", 1, 0.0005), ("high", 1, 5), ("long", 2, 0)]:
        write(f"{name}.json", side, height)
    files = sorted(map(str, tmp_path.glob("*.json")))

    def found(*options):
        command = [sys.executable, str(HERE / "candidates.py"), *files, *options]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        return {frozenset(Path(line[side]).stem for side in "ab") for line in lines}

    assert found() == {frozenset(pair) for pair in [("a", "near"), ("a", "high"), ("near", "high")]}
    assert found("--placed") == {frozenset(("a", "near"))}
