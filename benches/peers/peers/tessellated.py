"""What the peers for triangle meshes share: OpenCASCADE's triangles of both models."""

import numpy as np

from nurbs import diagonal
from peers.base import Answer, Base
from places import WORK

# Largest distance of a triangle from its surface, relative to the larger diagonal:
# the accuracy at which a peer counts as accurate.
DEFLECTION = 1e-4
# Largest angle in radians between neighbouring triangles: OpenCASCADE's default.
ANGLE = 0.5

MESHES = WORK / "meshes.npz"


def kept():
    """(vertices, triangles) of both models, and the seconds that they took."""
    if not MESHES.is_file():
        raise RuntimeError("no triangles within the limit")
    made = np.load(MESHES)
    return (made["va"], made["fa"]), (made["vb"], made["fb"]), float(made["seconds"])


class MeshPeer(Base):
    """Tessellates, then calls `distance`, which returns the value and its own seconds."""

    how = f"triangles by BRepMesh_IncrementalMesh, deflection {DEFLECTION:g} of the diagonal, angle {ANGLE:g}"

    def prepare(self, paths, a, b):
        self.a, self.b, self.tessellation = kept()
        self.diagonal = max(diagonal(a), diagonal(b))

    def measure(self):
        value, seconds = self.distance()
        parts = {"tessellate": self.tessellation, "solve": seconds}
        return Answer(value, self.tessellation + seconds, parts)
