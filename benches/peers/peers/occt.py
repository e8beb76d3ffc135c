"""OpenCASCADE: `GeomAPI_ProjectPointOnSurf` of grid samples."""

from OCP.Extrema import Extrema_ExtAlgo
from OCP.Geom import Geom_BSplineSurface
from OCP.GeomAPI import GeomAPI_ProjectPointOnCurve, GeomAPI_ProjectPointOnSurf
from OCP.gp import gp_Pnt

import opencascade
from peers.sampled import SAMPLES, Boxes, SampledPeer


class Target:
    """A surface of B with its projector."""

    def __init__(self, arrays):
        self.surface: Geom_BSplineSurface = opencascade.surface(arrays)
        u, v = arrays.domain
        self.sides = [self.surface.UIso(t) for t in u] + [self.surface.VIso(t) for t in v]
        self.projector = GeomAPI_ProjectPointOnSurf()
        self.projector.Init(self.surface, *u, *v, Extrema_ExtAlgo.Extrema_ExtAlgo_Tree)

    def distance(self, point):
        """To the nearest orthogonal projection; where there is none, to the boundary."""
        self.projector.Perform(point)
        if self.projector.NbPoints():
            return self.projector.LowerDistance()
        return min(distance_to_curve(point, side) for side in self.sides)


def distance_to_curve(point, curve):
    """The distance of a bounded curve: of orthogonal projections and its ends."""
    ends = (curve.Value(curve.FirstParameter()), curve.Value(curve.LastParameter()))
    nearest = min(point.Distance(end) for end in ends)
    projector = GeomAPI_ProjectPointOnCurve(point, curve)
    return min(nearest, projector.LowerDistance()) if projector.NbPoints() else nearest


class Peer(SampledPeer):
    name = "OpenCASCADE"
    settings = (
        "`GeomAPI_ProjectPointOnSurf`, initialised once a surface, Extrema_ExtAlgo_Tree (as right as the "
        f"default _Grad here, and faster), called from Python; {SampledPeer.how}"
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
