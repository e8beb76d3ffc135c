"""CGAL: `bounded_error_Hausdorff_distance` of two meshes, in a program of its own."""

import json
import subprocess

import numpy as np

from peers.tessellated import MeshPeer
from places import CGAL, WORK

# Relative to the larger diagonal; as the tessellation's, so that neither dominates.
ERROR_BOUND = 1e-4


class Peer(MeshPeer):
    name = "CGAL"
    guarantee = "interval for the two meshes, not for the surfaces"
    settings = (
        f"`bounded_error_Hausdorff_distance<Sequential_tag>`, error bound {ERROR_BOUND:g} of the diagonal, "
        f"EPICK, -O3 -DNDEBUG; {MeshPeer.how}"
    )

    def __init__(self):
        if not CGAL.is_file():
            raise RuntimeError("not built")

    def prepare(self, paths, a, b):
        super().prepare(paths, a, b)
        for name, (vertices, faces) in (("a", self.a), ("b", self.b)):
            with open(WORK / f"cgal-{name}.bin", "wb") as file:
                np.array([len(vertices), len(faces)], dtype=np.int64).tofile(file)
                vertices.astype(np.float64).tofile(file)
                faces.astype(np.int64).tofile(file)

    def distance(self):
        bound = ERROR_BOUND * self.diagonal
        command = [str(CGAL), str(WORK / "cgal-a.bin"), str(WORK / "cgal-b.bin"), repr(bound)]
        result = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        return result["value"], result["seconds"]
