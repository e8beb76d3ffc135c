"""This package's command line, method `certified`."""

import json
import subprocess

from peers.base import Answer, Base
from places import REPOSITORY

TOLERANCE = 1e-6


class Peer(Base):
    name = "nurbs-hausdorff"
    guarantee = "interval for the surfaces"
    settings = (
        f"`distance A B --relative-tolerance {TOLERANCE:g} --json`, a new process each time; "
        "all of `seconds` (prepare, compile, solve), from the model in memory to the interval, on all cores"
    )

    def prepare(self, paths, a, b):
        self.paths = [str(path) for path in paths]

    def measure(self):
        result = distance(self.paths, TOLERANCE)
        parts = result["seconds"]
        interval = (result["lower"], result["upper"])
        return Answer(result["computed"], sum(parts.values()), parts, interval)


def distance(paths, tolerance, max_seconds=None):
    """The JSON that the command line prints for two files."""
    command = [str(REPOSITORY / "target" / "release" / "nurbs-hausdorff"), "distance", *paths]
    command += ["--relative-tolerance", repr(tolerance), "--json"]
    if max_seconds is not None:
        command += ["--max-seconds", str(max_seconds)]
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(run.stdout)
