"""The poses that our `align` and other open-source tools find for scans of parts, as a Markdown table.

    python alignment_peers.py COMMAND PART.step …

COMMAND is our command line. It needs cadquery, numpy and scipy, and runs those of small_gicp, kiss-matcher, open3d
and py-goicp that are installed. The scans of a part, in seeded random poses, are its whole surface, the half of it on
one side of a plane, and the whole with outliers. A pose is right if it moves the scan to where the true pose puts it,
or, as parts may be symmetric, about as close to the part. The error output gets a line of JSON for each pose.
"""

import functools
import importlib.metadata
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections import namedtuple
from collections.abc import Callable, Iterator

os.environ.update(OMP_NUM_THREADS="1", RAYON_NUM_THREADS="1")

import cadquery
import numpy as np
from scipy.spatial import KDTree
from scipy.spatial.transform import RigidTransform, Rotation

KINDS, ROTATIONS = ("whole", "half", "outliers"), 6
SCAN, REFERENCE, OUTLIERS, LEFT_OUT = 5_000, 20_000, 500, 0.15
#: In diagonals: noise, the error of a right pose, the peers' voxels; and distances over those of the true pose.
NOISE, RIGHT, VOXEL, AS_GOOD, SECONDS = 0.001, 0.01, 0.015, 2.0, 30.0
#: A scan's part, kind, file and diagonal, and in diagonals its points, its true pose and the part's points.
Scan = namedtuple("Scan", "part kind file diagonal points true reference")
#: Returns a pose in diagonals, whether the tool states that it is one, and the other poses that it lists.
Finder = Callable[[Scan], tuple[RigidTransform, bool | None, list[RigidTransform]]]


def sampled(mesh: np.ndarray, count: int, random: np.random.Generator) -> np.ndarray:
    """Return points spread evenly over the area of triangles."""
    first, second, third = mesh.transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(second - first, third - first), axis=1)
    at = random.choice(len(mesh), count, p=areas / areas.sum())
    across, along = np.sqrt(random.random((count, 1))), random.random((count, 1))
    return first[at] + across * ((second - first)[at] * (1 - along) + (third - first)[at] * along)


def scans(part: str, folder: str) -> Iterator[Scan]:
    """Yield the scans of a part, of which outliers are the last points."""
    found = []
    for shape in cadquery.importers.importStep(part).vals():
        places, corners = shape.tessellate(1e-3 * shape.BoundingBox().DiagonalLength, 0.3)
        found.append(np.array([place.toTuple() for place in places])[np.array(corners)])
    diagonal = float(np.linalg.norm(np.ptp(np.concatenate(found), axis=(0, 1))))
    mesh = np.concatenate(found) / diagonal
    low, high = mesh.min(axis=(0, 1)), mesh.max(axis=(0, 1))
    reference = sampled(mesh, REFERENCE, np.random.default_rng(0))
    for number, kind in ((number, kind) for number in range(ROTATIONS) for kind in KINDS):
        random = np.random.default_rng([1, number, KINDS.index(kind)])
        points = sampled(mesh, 6 * SCAN, random)
        if kind == "half":
            points = points[(points - (low + high) / 2) @ random.normal(size=3) > 0]
        points = points[:SCAN] + random.uniform(-NOISE, NOISE, points[:SCAN].shape)
        if kind == "outliers":
            points[-OUTLIERS:] = (low + high) / 2 + random.uniform(-0.75, 0.75, (OUTLIERS, 3)) * (high - low)
        turn = Rotation.random(rng=random)
        placed = RigidTransform.from_components(random.normal(size=3), turn)
        file = f"{folder}/{os.path.basename(part)}_{kind}_{number}.xyz"
        np.savetxt(file, placed.apply(points) * diagonal)
        yield Scan(part, kind, file, diagonal, placed.apply(points), placed.inv(), reference)


def ours(scan: Scan) -> tuple:
    """Return the poses that our command prints."""
    call = [sys.argv[1], "align", scan.file, scan.part, "--json"]
    call += [f"--outliers={LEFT_OUT}"] if scan.kind == "outliers" else []
    found = json.loads(subprocess.run(call, capture_output=True, check=False).stdout)
    transforms = [each["transform"] for each in (found, *found["ambiguous"])]
    turns = Rotation.from_quat([each["rotation"] for each in transforms])
    shifts = np.array([each["translation"] for each in transforms]) / scan.diagonal
    pose, *others = RigidTransform.from_components(shifts, turns)
    return pose, found["converged"], others


def kiss_matcher(scan: Scan) -> tuple:
    """Return the pose of its features and its robust solver."""
    matcher, middle = importlib.import_module("kiss_matcher").KISSMatcher(VOXEL), scan.points.mean(axis=0)
    found = matcher.estimate(scan.points - middle, scan.reference)
    pose = RigidTransform.from_components(np.ravel(found.translation), Rotation.from_matrix(found.rotation))
    return pose * RigidTransform.from_translation(-middle), bool(found.valid), []


def small_gicp(scan: Scan, first: Finder | None = None) -> tuple:
    """Return the pose of its local fit, which starts from that of a first tool, or unturned, mean on mean."""
    start = first(scan)[0] if first else RigidTransform.from_translation(scan.reference.mean(0) - scan.points.mean(0))
    settings = {"downsampling_resolution": VOXEL / 4, "max_correspondence_distance": 2 * VOXEL, "max_iterations": 100}
    found = importlib.import_module("small_gicp").align(scan.reference, scan.points, start.as_matrix(), **settings)
    return RigidTransform.from_matrix(found.T_target_source), bool(found.converged), []


def open3d(scan: Scan) -> tuple:
    """Return the pose of FPFH features and RANSAC, refined by ICP to planes, as its tutorial does."""
    package = importlib.import_module("open3d")
    fits, search = package.pipelines.registration, package.geometry.KDTreeSearchParamHybrid
    clouds, thinned, features, near = [], [], [], 1.5 * VOXEL
    for points in (scan.points, scan.reference):
        clouds.append(package.geometry.PointCloud(package.utility.Vector3dVector(points)))
        thinned.append(clouds[-1].voxel_down_sample(VOXEL))
        for each in (clouds[-1], thinned[-1]):
            each.estimate_normals(search(2 * VOXEL, 30))
        features.append(fits.compute_fpfh_feature(thinned[-1], search(5 * VOXEL, 100)))
    package.utility.random.seed(0)
    checks = [fits.CorrespondenceCheckerBasedOnEdgeLength(0.9), fits.CorrespondenceCheckerBasedOnDistance(near)]
    found = fits.registration_ransac_based_on_feature_matching(*thinned, *features, True, near, checkers=checks)
    found = fits.registration_icp(*clouds, VOXEL, found.transformation, fits.TransformationEstimationPointToPlane())
    return RigidTransform.from_matrix(found.transformation), None, []


def py_goicp(scan: Scan) -> tuple:
    """Return the pose of its search over all rotations with a tenth of the scan's points."""
    package = importlib.import_module("py_goicp")
    middle, centre = scan.points.mean(axis=0), scan.reference.mean(axis=0)
    some = np.random.default_rng(0).choice(scan.points, SCAN // 10, replace=False)
    model, data = ([package.POINT3D(*each) for each in 2 * s] for s in (scan.reference - centre, some - middle))
    search, shifts = package.GoICP(), package.TRANSNODE()
    search.loadModelAndData(len(model), model, len(data), data)
    search.setDTSizeAndFactor(200, 2.0)
    search.MSEThresh, search.doTrim, search.trimFraction = 1e-3, scan.kind == "outliers", LEFT_OUT
    shifts.x, shifts.y, shifts.z, shifts.w = -0.5, -0.5, -0.5, 1.0
    search.setInitNodeTrans(shifts)
    search.BuildDT()
    search.Register()
    rotation, shift = Rotation.from_matrix(search.optimalRotation()), np.array(search.optimalTranslation()) / 2
    return RigidTransform.from_components(shift + centre - rotation.apply(middle), rotation), None, []


def judged(scan: Scan, pose: RigidTransform) -> dict:
    """Return whether a pose is right, its error, and its distances over those of the true pose."""
    points = scan.points[:-OUTLIERS] if scan.kind == "outliers" else scan.points
    here, there, tree = pose.apply(points), scan.true.apply(points), KDTree(scan.reference)
    squares = (np.sum((here - there) ** 2, axis=1), tree.query(here)[0] ** 2, tree.query(there)[0] ** 2)
    error, far, least = (float(np.sqrt(np.mean(each))) for each in squares)
    return {"right": error <= RIGHT or far <= AS_GOOD * least, "error": error, "times": far / least}


def result(call: Finder, scan: Scan) -> dict:
    """Return what is known of a tool's answer, which it finds on one core in the calling process."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    before, (pose, sure, others), after = os.times(), call(scan), os.times()
    seconds = after.user + after.children_user - before.user - before.children_user
    lists = any(judged(scan, other)["right"] for other in others)
    return {**judged(scan, pose), "sure": sure, "others": len(others), "lists": lists, "seconds": seconds}


def limited(call: Finder, scan: Scan) -> dict:
    """Return the same, found in a process of its own; the answer is wrong if there is none at the limit."""
    with multiprocessing.get_context("fork").Pool(1) as pool:
        try:
            return pool.apply_async(result, (call, scan)).get(SECONDS)
        except Exception as error:
            return {"right": False, "sure": None, "lists": False, "seconds": SECONDS, "failure": repr(error)}


def row(name: str, found: list[dict]) -> str:
    """Return a tool's line of the table."""
    results = [each for each in found if each["tool"] == name]
    by_kind = [[each["right"] for each in results if each["kind"] == kind] for kind in KINDS]
    seconds = np.median([each["seconds"] for each in results])
    sure = [each["right"] for each in results if each["sure"]]
    stated = f"{len(sure)}, {sure.count(False)} wrong" if sure else "not stated"
    cells = [name, *(f"{sum(right)} of {len(right)}" for right in by_kind), f"{seconds:.2f}", stated]
    lists = [each["lists"] for each in results if not each["right"]]
    return f"| {' | '.join(cells)} | {sum(lists)} of {len(lists)} |"


def main() -> None:
    """Run each tool on each scan and print the table."""
    calls: dict[str, Finder] = {"ours": ours}
    for call in (kiss_matcher, small_gicp, open3d, py_goicp):
        try:
            importlib.import_module(call.__name__)
            calls[f"{call.__name__} {importlib.metadata.version(call.__name__.replace('_', '-'))}"] = call
        except ImportError:
            print(f"SKIPPED {call.__name__}: not installed")
    if {kiss_matcher, small_gicp} <= set(calls.values()):
        calls["kiss_matcher, then small_gicp"] = functools.partial(small_gicp, first=kiss_matcher)
    found: list[dict] = []
    with tempfile.TemporaryDirectory() as folder:
        for scan in (scan for part in sys.argv[2:] for scan in scans(part, folder)):
            for name, call in calls.items():
                head = {"tool": name, "scan": os.path.basename(scan.file), "kind": scan.kind}
                found.append(head | limited(call, scan))
                print(json.dumps(found[-1]), file=sys.stderr, flush=True)
    print("| Tool | Whole | Half | Outliers | CPU s, median | States a fit | Wrong, but lists a right pose |")
    print("\n".join(["|---|---:|---:|---:|---:|---:|---:|", *(row(name, found) for name in calls)]))


if __name__ == "__main__":
    main()
