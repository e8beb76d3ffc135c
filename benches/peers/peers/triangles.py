"""OpenCASCADE's triangles for the peers that need them: a step before theirs, not a peer."""

import numpy as np

import opencascade
from nurbs import diagonal
from peers.base import Answer, Base
from peers.tessellated import ANGLE, DEFLECTION, MESHES


class Peer(Base):
    name = "tessellation"

    def prepare(self, paths, a, b):
        MESHES.unlink(missing_ok=True)
        self.models = {"a": a, "b": b}
        self.deflection = DEFLECTION * max(diagonal(a), diagonal(b))

    def measure(self):
        made, seconds = {}, 0.0
        for side, surfaces in self.models.items():
            geometry = [opencascade.surface(surface) for surface in surfaces]
            vertices, triangles, took = opencascade.triangles(geometry, self.deflection, ANGLE)
            made |= {f"v{side}": vertices, f"f{side}": triangles}
            seconds += took
        np.savez(MESHES, seconds=seconds, **made)
        return Answer(float(sum(map(len, made.values()))), seconds, {"tessellate": seconds})
