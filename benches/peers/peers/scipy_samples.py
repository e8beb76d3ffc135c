"""scipy: a kd-tree of dense samples of B, queried with dense samples of A."""

import numpy as np
from scipy.spatial import cKDTree

from peers.sampled import SampledPeer

# Samples of each model, shared among its surfaces.
POINTS = 100_000


class Peer(SampledPeer):
    name = "scipy"
    guarantee = "none: samples to samples"
    settings = (
        f"`cKDTree` with `workers=-1`, about {POINTS:,} samples of each model, uniform in (u, v) "
        "(what `directed_hausdorff` computes, and faster)"
    )

    def distance(self):
        distances, _ = cKDTree(dense(self.b)).query(dense(self.a), workers=-1)
        return float(distances.max())


def dense(surfaces):
    """Samples of all surfaces, equally many on each."""
    count = max(2, round((POINTS / len(surfaces)) ** 0.5))
    return np.concatenate([surface.samples(count) for surface in surfaces])
