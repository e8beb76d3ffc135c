"""SMLib through smlibpy: closest points of grid samples, the best polished by Nelder-Mead."""

import numpy as np
from scipy.optimize import minimize
from smlibpy import nurbs_surface

from peers.sampled import SAMPLES, Boxes, SampledPeer

# Samples from which the polish starts.
POLISHED = 5


class Peer(SampledPeer):
    name = "SMLib + polish"
    settings = (
        f"smlibpy `closest_point`, then scipy's Nelder-Mead from the {POLISHED} farthest samples within "
        f"one grid cell; {SampledPeer.how}"
    )

    def distance(self):
        sheets = [
            nurbs_surface(
                surface.points, surface.knots, surface.degree, surface.weights if surface.rational else None
            )
            for surface in self.b
        ]
        boxes = Boxes(self.b)

        def distance(point):
            point = tuple(map(float, point))
            return boxes.nearest(
                point, lambda index: np.linalg.norm(np.subtract(sheets[index].closest_point(point), point))
            )

        found = []
        for surface in self.a:
            u, v = (np.linspace(*ends, SAMPLES) for ends in surface.domain)
            points = surface.grid(u, v)
            found += [
                (distance(points[i, j]), surface, u[i], v[j]) for i in range(SAMPLES) for j in range(SAMPLES)
            ]
        found.sort(key=lambda sample: -sample[0])
        return max(polished(distance, *sample) for sample in found[:POLISHED])


def polished(distance, value, surface, u, v):
    """The largest distance near a sample, at least the sample's own."""
    steps = [(high - low) / (SAMPLES - 1) for low, high in surface.domain]
    bounds = [
        (max(t - step, ends[0]), min(t + step, ends[1]))
        for t, step, ends in zip((u, v), steps, surface.domain, strict=True)
    ]
    corners = [(u, v), (_inwards(u, *bounds[0]), v), (u, _inwards(v, *bounds[1]))]
    result = minimize(
        lambda at: -distance(surface.grid([at[0]], [at[1]])[0, 0]),
        (u, v),
        method="Nelder-Mead",
        bounds=bounds,
        options={"initial_simplex": corners, "xatol": 1e-9, "fatol": 1e-12},
    )
    return max(value, -result.fun)


def _inwards(t, low, high):
    """Half a cell from `t`, on the side with room."""
    return 0.5 * (t + high) if high > t else 0.5 * (t + low)
