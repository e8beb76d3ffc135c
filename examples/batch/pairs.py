"""Answers one line of `nurbs-hausdorff batch` in Python, for engines that distribute lines."""

import dataclasses
import functools
import json
import os
import re

# The engine shares out the cores: a process has one. This is read at the first computation.
os.environ.setdefault("RAYON_NUM_THREADS", "1")

import nurbs_hausdorff as nh

COMMANDS = {"distance": nh.distance, "diff": nh.diff, "clearance": nh.clearance}

#: Models that each process keeps prepared.
KEPT = 128


@functools.lru_cache(maxsize=KEPT)
def model(path: str) -> nh.Model:
    """Return a model, read and prepared once a process while it is among those used last."""
    return nh.read(path)


def answer(line: str) -> str:
    """Return the line that answers a pair: its id and the result, or its id and an error."""
    request = json.loads(line)
    key = request.pop("id")
    try:
        compare = COMMANDS[request.pop("command", "distance")]
        a, b = (model(request.pop(side)) for side in "ab")
        motion = request.pop("transform", None)
        options = {re.sub(r"(?=[A-Z])", "_", name).lower(): value for name, value in request.items()}
        result = compare(a, b, transform=motion and nh.Transform(**motion), **options)
        return json.dumps({"id": key, **dataclasses.asdict(result)})
    except nh.NurbsHausdorffError as error:
        return json.dumps({"id": key, "error": {"code": error.code, "message": error.message}})
