"""What the peers with exact closest points share: grid samples of A, and boxes of B."""

import time

import numpy as np

from peers.base import Answer, Base

# Samples along each direction of every surface of A, as in the 2012 paper.
SAMPLES = 64


class Boxes:
    """The boxes of surfaces' control points, nearest first: fewer surfaces to try."""

    def __init__(self, surfaces):
        nets = [surface.points.reshape(-1, 3) for surface in surfaces]
        self.low = np.array([net.min(axis=0) for net in nets])
        self.high = np.array([net.max(axis=0) for net in nets])

    def nearest(self, point, distance):
        """The least `distance(index)` over the surfaces whose boxes are near enough."""
        bounds = np.linalg.norm(np.maximum(0, np.maximum(self.low - point, point - self.high)), axis=1)
        best = np.inf
        for index in np.argsort(bounds):
            if bounds[index] >= best:
                break
            best = min(best, distance(index))
        return best


class SampledPeer(Base):
    """Grid samples of A, each projected on B by the peer's own closest point."""

    guarantee = "none: samples"
    how = f"{SAMPLES} x {SAMPLES} samples of every surface of A; surfaces of B in the order of their boxes"

    def prepare(self, paths, a, b):
        self.a, self.b = a, b

    def measure(self):
        start = time.perf_counter()
        value = self.distance()
        seconds = time.perf_counter() - start
        return Answer(value, seconds, {"solve": seconds})
