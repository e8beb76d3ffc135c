"""Answers pairs on local clusters of two nodes: seconds, and how many of them are the solver's.

    python clusters.py ray|spark pairs.jsonl

Each node compares on one core. Starting the cluster is not counted.
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

BATCH = Path(__file__).parents[2] / "examples" / "batch"
sys.path.insert(0, str(BATCH))


def on_ray(source: str, target: str) -> float:
    import ray
    import ray_pairs
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 2, "include_dashboard": False})
    cluster.add_node(num_cpus=2)
    ray.init(address=cluster.address, runtime_env={"env_vars": {"PYTHONPATH": str(BATCH)}})
    begun = time.perf_counter()
    ray_pairs.run(source, target, (2, 2))
    seconds = time.perf_counter() - begun
    ray.shutdown()
    cluster.shutdown()
    return seconds


def on_spark(source: str, target: str) -> float:
    import spark_pairs
    from pyspark.sql import SparkSession

    os.environ |= {"PYSPARK_PYTHON": sys.executable, "SPARK_LOCAL_IP": "127.0.0.1"}
    session = SparkSession.builder.master("local-cluster[2,1,1024]").getOrCreate()
    for name in ("pairs.py", "spark_pairs.py"):
        session.sparkContext.addPyFile(str(BATCH / name))
    begun = time.perf_counter()
    spark_pairs.run(session, source, target)
    seconds = time.perf_counter() - begun
    session.stop()
    return seconds


def main() -> None:
    engine, source = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "answers"
        seconds = {"ray": on_ray, "spark": on_spark}[engine](source, str(target))
        files = target.glob({"ray": "*.json", "spark": "part-*"}[engine])
        lines = [line for file in files for line in file.read_text().splitlines()]
    answers = [json.loads(line) for line in lines]
    if engine == "ray":
        answers = [json.loads(answer["answer"]) for answer in answers]
    solved = sum(answer["seconds"]["solve"] for answer in answers if "seconds" in answer)
    print(
        f"{engine}: {len(answers)} answers, {sum('error' in answer for answer in answers)} errors,",
        f"{seconds:.1f} s, {len(answers) / seconds:.0f} pairs a second;",
        f"the solver's seconds are {solved:.1f}",
    )


if __name__ == "__main__":
    main()
