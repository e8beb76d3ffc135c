"""Compares many pairs on a Ray cluster: python ray_pairs.py pairs.jsonl answers/

The lines are those of `nurbs-hausdorff batch`; all nodes must see the files that they name. Ray
repeats the batches of a worker that died, and writes each batch once.
"""

import os
import sys

import pairs
import ray

#: Lines that a worker takes at once: what is repeated if it dies.
BATCH = 64


def absolute(path):
    """Return a path of this machine as the workers need it, whose folder is another one. An
    address such as `s3://bucket/folder` stays."""
    return path if "://" in path else os.path.abspath(path)


class Compare:
    """A worker, whose prepared models live as long as it does."""

    def __call__(self, batch):
        return {"answer": [pairs.answer(line) for line in batch["text"]]}


def run(source, target, workers, compare=Compare):
    """Answer the lines of a file into JSON files in a new folder. `workers` is the least and the
    largest number of processes, a core each: fewer than the cluster has, since reading and
    writing need one."""
    source, target = absolute(source), absolute(target)
    if os.path.exists(target):
        raise SystemExit(f"{target} is there already: the answers need a folder of their own")
    answers = ray.data.read_text(source).map_batches(
        compare,
        batch_size=BATCH,
        num_cpus=1,
        compute=ray.data.ActorPoolStrategy(min_size=workers[0], max_size=workers[1]),
    )
    answers.write_json(target)


if __name__ == "__main__":
    here = os.path.dirname(os.path.abspath(__file__))
    ray.init(runtime_env={"working_dir": here})
    run(sys.argv[1], sys.argv[2], (1, max(1, int(ray.cluster_resources()["CPU"]) - 1)))
