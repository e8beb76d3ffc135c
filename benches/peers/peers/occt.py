"""OpenCASCADE: `GeomAPI_ProjectPointOnSurf` of grid samples."""

from OCP.GeomAPI import GeomAPI_ProjectPointOnCurve, GeomAPI_ProjectPointOnSurf
from OCP.gp import gp_Pnt

import opencascade
from peers.sampled import SAMPLES, Boxes, SampledPeer


class Target:
    """A surface of B with its projectors, initialised once."""

    def __init__(self, arrays):
        surface = opencascade.surface(arrays)
        (u0, u1), (v0, v1) = arrays.domain
        self.inside = GeomAPI_ProjectPointOnSurf()
        self.inside.Init(surface, u0, u1, v0, v1)
        self.sides = []
        for curve, ends in (
            (surface.UIso(u0), (v0, v1)),
            (surface.UIso(u1), (v0, v1)),
            (surface.VIso(v0), (u0, u1)),
            (surface.VIso(v1), (u0, u1)),
        ):
            projector = GeomAPI_ProjectPointOnCurve()
            projector.Init(curve, *ends)
            self.sides.append(projector)
        self.corners = [surface.Value(u, v) for u in (u0, u1) for v in (v0, v1)]

    def distance(self, point):
        """To the nearest orthogonal projection on the surface or its sides, or the nearest corner."""
        least = min(point.Distance(corner) for corner in self.corners)
        for projector in (self.inside, *self.sides):
            projector.Perform(point)
            if projector.NbPoints():
                least = min(least, projector.LowerDistance())
        return least


class Peer(SampledPeer):
    name = "OpenCASCADE"
    settings = (
        "`GeomAPI_ProjectPointOnSurf`, its default algorithm, initialised once a surface, and its sides by "
        f"`GeomAPI_ProjectPointOnCurve`, called from Python; {SampledPeer.how}"
    )

    def distance(self):
        targets, boxes = [Target(surface) for surface in self.b], Boxes(self.b)
        most = 0.0
        for surface in self.a:
            for sample in surface.samples(SAMPLES):
                point = gp_Pnt(*map(float, sample))
                most = max(
                    most, boxes.nearest(sample, lambda index, point=point: targets[index].distance(point))
                )
        return most
