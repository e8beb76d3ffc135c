"""BREP_kernel: a Rust crate's closest points, in a program of its own."""

import json
import subprocess

from peers.base import Answer
from peers.sampled import SAMPLES, SampledPeer
from places import BREP_KERNEL


class Peer(SampledPeer):
    name = "BREP_kernel"
    settings = f"`project_point_to_surface`, release build, on all cores; {SampledPeer.how}"

    def __init__(self):
        if not BREP_KERNEL.is_file():
            raise RuntimeError("not built")

    def prepare(self, paths, a, b):
        self.paths = [str(path) for path in paths]

    def measure(self):
        command = [str(BREP_KERNEL), *self.paths, str(SAMPLES)]
        result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        return Answer(result["value"], result["seconds"], {"solve": result["seconds"]})
