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


def forget():
    """Makes the next peer tessellate again."""
    MESHES.unlink(missing_ok=True)


def meshes(a, b):
    """(vertices, triangles) of both, and the seconds to make them.

    Made once for all peers of a round, each of which counts the time.
    """
    if not MESHES.is_file():
        import opencascade

        deflection = DEFLECTION * max(diagonal(a), diagonal(b))
        made, seconds = {}, 0.0
        for name, surfaces in (("a", a), ("b", b)):
            geometry = [opencascade.surface(surface) for surface in surfaces]
            made[f"v{name}"], made[f"f{name}"], took = opencascade.triangles(geometry, deflection, ANGLE)
            seconds += took
        np.savez(MESHES, seconds=seconds, **made)
    kept = np.load(MESHES)
    return (kept["va"], kept["fa"]), (kept["vb"], kept["fb"]), float(kept["seconds"])


class MeshPeer(Base):
    """Tessellates, then calls `distance`, which tells the value and its own seconds."""

    how = f"triangles by BRepMesh_IncrementalMesh, deflection {DEFLECTION:g} of the diagonal, angle {ANGLE:g}"

    def prepare(self, paths, a, b):
        self.a, self.b, self.tessellation = meshes(a, b)
        self.diagonal = max(diagonal(a), diagonal(b))

    def measure(self):
        value, seconds = self.distance()
        parts = {"tessellate": self.tessellation, "solve": seconds}
        return Answer(value, self.tessellation + seconds, parts)
