"""CADGenBench's sampled scores of its own fixtures, beside the intervals of `nh.score`.

    python sampled_scores.py CHECKOUT

needs build123d, open3d, manifold3d and scipy, and a checkout of huggingface/cadgenbench. For each
pair of its fixtures with a truth: the parts of samples within 0.5 % of the truth's diagonal of the
other mesh, without its test of normals, for growing numbers of samples and ten seeds; its own F1,
with the test; and its intersection over union. Prints a line a pair, and whether our intervals hold
what its samples tend to. Ends with 1 if they do not.
"""

import sys
import time
from pathlib import Path

import numpy as np
import nurbs_hausdorff as nh

COUNTS = (1_000, 10_000, 100_000)
SEEDS = range(10)
#: Standard deviations of a part of so many samples.
DEVIATIONS = 5.0
#: The chord error of its triangles moves a rim of each face by so much of the threshold at most.
RIM = 0.1


def pairs(checkout):
    for truth in sorted(checkout.glob("tests/fixtures/jig_metric/*/gt.step")):
        for candidate in sorted((truth.parent / "candidates").glob("*.step")):
            yield f"{truth.parent.name}/{candidate.stem}", candidate, truth
    boxes = checkout / "tests" / "eval" / "fixtures"
    for one, other in (("10_20_30", "12_22_32"), ("10_20_30", "10_20_31"), ("10_10_10", "10_10_50")):
        yield f"{one}/{other}", boxes / f"cd_box_{other}.step", boxes / f"cd_box_{one}.step"


def context(path, deflection, count, seed):
    from cadgenbench.common.validity import analyze_step
    from cadgenbench.eval.shape_similarity import MetricContext

    found = analyze_step(path)
    return MetricContext(
        step_path=path,
        validation=found.validation,
        measurements=found.measurements,
        linear_deflection_mm=deflection,
        _pc_n_points=count,
        _pc_seed=seed,
    )


def parts(candidate, truth, threshold, count, seed):
    """Return the parts of samples of both meshes within the threshold of the other one."""
    from cadgenbench.eval.sampling import (
        closest_point_distances_and_normals,
        sample_points_and_normals_from_mesh,
    )

    found = []
    for one, other in ((candidate, truth), (truth, candidate)):
        points, _ = sample_points_and_normals_from_mesh(one.vertices, one.triangles, count, seed)
        distances, _ = closest_point_distances_and_normals(points, other.vertices, other.triangles)
        found.append(float(np.mean(distances <= threshold)))
    return found


def main():
    checkout = Path(sys.argv[1])
    sys.path.insert(0, str(checkout / "src"))
    from cadgenbench.common.mesh import deflection_for_bbox
    from cadgenbench.common.validity import analyze_step
    from cadgenbench.eval import shape_similarity as theirs

    fraction = theirs.SURFACE_DISTANCE_F1_THRESHOLD_FRACTION
    angle = float(np.degrees(np.arccos(theirs.SURFACE_DISTANCE_F1_NORMAL_DOT_THRESHOLD)))
    print(f"threshold {fraction} of the diagonal, {angle:.1f} degrees")
    wrong = 0
    for name, candidate, truth in pairs(checkout):
        diagonal = analyze_step(truth).measurements.bounding_box.diagonal
        deflection = deflection_for_bbox(diagonal)
        begun = time.process_time()
        found = nh.score(
            str(candidate), str(truth), relative_thresholds=[fraction], normal_angle=angle
        )
        ours = time.process_time() - begun
        at = found.thresholds[0]
        own = [context(path, deflection, 1000, 0).get_mesh() for path in (candidate, truth)]
        spread, outside = [], []
        for count in COUNTS:
            sampled = np.array([parts(*own, fraction * diagonal, count, seed) for seed in SEEDS])
            spread.append(float(np.ptp(sampled, axis=0).max()))
            for part, interval in zip(sampled.mean(axis=0), (at.precision, at.recall)):
                middle = min(max(part, interval.lower), interval.upper)
                error = DEVIATIONS * np.sqrt(max(middle * (1 - middle), 1 / count) / count / len(SEEDS))
                if abs(part - middle) > error + RIM * fraction:
                    outside.append((count, part, interval.lower, interval.upper))
        begun = time.process_time()
        contexts = [context(path, deflection, 50_000, 0) for path in (candidate, truth)]
        f1 = theirs.shape_surface_distance_f1(*contexts)
        iou = theirs.shape_volume_iou(*contexts)
        spent = time.process_time() - begun
        wrong += bool(outside)
        widths = max(one.upper - one.lower for one in (at.precision, at.recall))
        print(
            f"{name}: P [{at.precision.lower:.4f}, {at.precision.upper:.4f}]"
            f" R [{at.recall.lower:.4f}, {at.recall.upper:.4f}], width {widths:.2g};"
            f" samples {np.round(sampled.mean(axis=0), 4)}, spread over seeds"
            f" {' '.join(f'{one:.2g}' for one in spread)} at {' '.join(map(str, COUNTS))};"
            f" normalF1 [{at.normal_f1.lower:.4f}, {at.normal_f1.upper:.4f}], its F1 {f1:.4f};"
            f" iou [{found.iou.lower:.4f}, {found.iou.upper:.4f}], its {iou:.4f};"
            f" {ours:.2f} s, its {spent:.2f} s{'; OUTSIDE ' + str(outside) if outside else ''}",
            flush=True,
        )
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
