"""Answers one line of `nurbs-hausdorff batch` in Python, for engines that distribute lines."""

import dataclasses
import functools
import json
import os
import re

# The engine shares out the cores: a process has one. This is read at the first computation.
os.environ.setdefault("RAYON_NUM_THREADS", "1")

import nurbs_hausdorff as nh

COMMANDS = {"distance": nh.distance, "diff": nh.diff, "clearance": nh.clearance, "score": nh.score}

#: Models that each process keeps prepared.
KEPT = 128


@functools.lru_cache(maxsize=KEPT)
def model(path: str) -> nh.Model:
    """Return a model, read and prepared once a process while it is among those used last."""
    return nh.read(path)


def answer(line: str) -> str:
    """Return the line that answers a pair: its id and the result, or its id and an error.

    As of `nurbs-hausdorff batch`, whatever is wrong with a line is its error: the others go on.
    """
    key = None
    try:
        request = json.loads(line)
        key = request.get("id")
        return json.dumps({"id": key, **camel(dataclasses.asdict(compared(request)))})
    except nh.NurbsHausdorffError as error:
        code, message = error.code, error.message
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        # No JSON, no object, a key that is missing, an unknown command or option.
        code, message = "OPTION_INVALID", f"the line is no pair: {type(error).__name__}: {error}"
    return json.dumps({"id": key, "error": {"code": code, "message": message}})


def camel(value):
    """Return the value with its keys as the command writes them, so that `summary` reads scores."""
    if isinstance(value, dict):
        return {
            re.sub("_([a-z0-9])", lambda found: found[1].upper(), key): camel(item)
            for key, item in value.items()
            if item is not None
        }
    return [camel(item) for item in value] if isinstance(value, (list, tuple)) else value


def compared(request: dict):
    """Return the result of a pair."""
    request.pop("id")
    compare = COMMANDS[request.pop("command", "distance")]
    a, b = (model(request.pop(side)) for side in "ab")
    motion = request.pop("transform", None)
    options = {re.sub(r"(?=[A-Z])", "_", name).lower(): value for name, value in request.items()}
    return compare(a, b, transform=motion and nh.Transform(**motion), **options)
