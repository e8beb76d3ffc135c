"""Certified distances between CAD models, as intervals that contain them.

>>> import nurbs_hausdorff as nh
>>> result = nh.distance("a.step", "b.step", symmetric=True)  # doctest: +SKIP
>>> result.lower, result.upper  # doctest: +SKIP
"""

from __future__ import annotations

from importlib.metadata import version as _version

from . import testing
from ._calls.check import check
from ._calls.fit import BestFit, FitPose, LeftOut, Zone, best_fit
from ._calls.maps import deviation_maps
from ._calls.measure import clearance, diff, distance, field, gaps, overlap, statistics
from ._calls.points import closest_points, signed_distances
from ._calls.score import score
from ._errors import NurbsHausdorffError
from ._model import FreeEdge, Mesh, MeshReport, Model, ReadReport, Remark, Shell, Solid
from ._results.bodies.check import (
    BodyPair,
    CheckedBody,
    CheckResult,
    EmbeddedUnknown,
    SelfOverlap,
    UnkeptRule,
)
from ._results.bodies.clearance import ClearanceResult, FaceGap, GapsResult, Overlap
from ._results.bodies.facts import Body, FaceForm, Facts
from ._results.bodies.overlap import OverlapResult, OverlapVolumes
from ._results.closest import ClosestPoints
from ._results.common import SurfacePoint, Witness
from ._results.diff import (
    DiffResult, FaceCounterpart, FaceDifference, PartDifference, PartFaces, PartMotion,
)  # fmt: skip
from ._results.distance import DistanceResult
from ._results.field import Field, FieldPart, Statistics
from ._results.grid import SignedDistances
from ._results.maps import DeviationMap, DeviationMaps
from ._results.score import (
    AtThreshold, Difference, EdgeLengths, FaceCounts, HausdorffScore, Placement, Requirement, Score,
    ScoredModel, SurfaceScore,
)  # fmt: skip
from ._results.statistics import Beyond, CertifiedStatistics
from ._sources import model, read
from ._values.interval import Interval
from ._values.transform import Transform

#: The version of the package.
__version__ = _version("nurbs-hausdorff")

__all__ = [
    "AtThreshold", "BestFit", "Beyond", "Body", "BodyPair", "CertifiedStatistics", "CheckResult",
    "CheckedBody", "ClearanceResult", "ClosestPoints", "DeviationMap", "DeviationMaps",
    "DiffResult", "Difference", "DistanceResult", "EdgeLengths", "EmbeddedUnknown", "FaceCounterpart",
    "FaceCounts", "FaceDifference", "FaceForm", "FaceGap", "Facts", "Field", "FieldPart", "FitPose", "FreeEdge",
    "GapsResult", "HausdorffScore", "Interval", "LeftOut", "Mesh", "MeshReport", "Model",
    "NurbsHausdorffError", "Overlap", "OverlapResult", "OverlapVolumes", "PartDifference",
    "PartFaces", "PartMotion", "Placement", "ReadReport", "Remark", "Requirement", "Score",
    "ScoredModel", "SelfOverlap", "Shell", "SignedDistances", "Solid", "Statistics", "SurfacePoint",
    "SurfaceScore", "Transform", "UnkeptRule", "Witness", "Zone", "best_fit", "check", "clearance",
    "closest_points", "deviation_maps", "diff", "distance", "field", "gaps", "model", "overlap",
    "read", "score", "signed_distances", "statistics", "testing",
]  # fmt: skip
