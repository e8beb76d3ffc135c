"""splinepy: Newton searches from a kd-tree of initial guesses."""

import os

import numpy as np
import splinepy

from peers.sampled import SAMPLES, SampledPeer

# Initial guesses along each direction of a surface; its documentation recommends more
# than the default for complex shapes, and the default finds wrong points on a sphere.
GUESSES = 64


class Peer(SampledPeer):
    name = "splinepy"
    settings = (
        f"`NURBS.proximities`, `initial_guess_sample_resolutions` {GUESSES} x {GUESSES} or twice the control "
        f"net if more, on all cores; {SAMPLES} x {SAMPLES} samples of every surface of A, all surfaces of B"
    )

    def distance(self):
        points = np.concatenate([surface.samples(SAMPLES) for surface in self.a])
        return float(np.min([distances(surface, points) for surface in self.b], axis=0).max())


def distances(surface, points):
    """Of all points to one surface."""
    spline = splinepy.NURBS(
        degrees=surface.degree,
        knot_vectors=surface.knots,
        # splinepy's control points go along u first.
        control_points=surface.points.transpose(1, 0, 2).reshape(-1, 3),
        weights=surface.weights.T.reshape(-1, 1),
    )
    verbose = spline.proximities(
        points,
        initial_guess_sample_resolutions=[max(GUESSES, 2 * count) for count in surface.weights.shape],
        return_verbose=True,
        nthreads=os.cpu_count(),
    )
    # Parameters, points, differences, distances, …
    return np.ravel(verbose[3])
