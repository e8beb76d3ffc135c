"""The score of examples/python/score.py on the fixtures of CADGenBench.

    python generated.py CHECKOUT

needs cadquery-ocp and scipy, and a checkout of huggingface/cadgenbench. One line a candidate:
its score, its state, and CPU seconds of the score beside the benchmark's own sampling of both
surfaces with the nearest samples of each other. Ends with 1 unless every `correct` is unchanged
and every `broken_*` is changed with faces named.
"""

import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "examples" / "python"))

import nurbs_hausdorff as nh
from score import score

#: Samples of a surface: the benchmark's default for its metric of shapes.
SAMPLES = 50_000
LIMIT = 1e-3


def sampled(truth: Path, candidate: Path) -> float:
    """Return the largest distance of a sample from the other's samples, as the benchmark has it."""
    from cadgenbench.eval.sampling import sample_surface_points
    from scipy.spatial import KDTree

    one, other = (sample_surface_points(path, SAMPLES, seed=0) for path in (truth, candidate))
    forward, reverse = KDTree(other).query(one)[0], KDTree(one).query(other)[0]
    return float(max(forward.max(), reverse.max()))


def main() -> None:
    checkout = Path(sys.argv[1])
    sys.path.insert(0, str(checkout / "src"))
    wrong = 0
    for truth in sorted(checkout.glob("tests/fixtures/jig_metric/*/gt.step")):
        for candidate in sorted((truth.parent / "candidates").glob("*.step")):
            begun = time.process_time()
            found = score(nh.read(truth), str(candidate), LIMIT)
            ours = time.process_time() - begun
            begun = time.process_time()
            largest = sampled(truth, candidate)
            theirs = time.process_time() - begun
            broken = candidate.name.startswith("broken")
            expected = ("changed", True) if broken else ("unchanged", False)
            wrong += (found["state"], bool(found["truth"] + found["surplus"])) != expected
            print(
                f"{truth.parent.name}/{candidate.stem}: {found['state']}, score {found['score']:.3f},",
                f"faces {[face['face'] for face in found['truth']]}; {ours:.3f} s,",
                f"{SAMPLES} samples {largest:.3g} apart in {theirs:.3f} s",
            )
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
