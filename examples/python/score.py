"""Scores generated CAD against its ground truth, face by face, with certainty.

    python score.py truth.step candidate.step… [--limit 0.001]

One line of JSON for each candidate: `state` of the whole, the faces of both sides that are not
certainly unchanged, and `score`: the share of the truth's faces, by number, times the share of the
candidate's, by area, that are certainly within the limit of the other model. It is 1 only if all
are. Nothing is sampled: a hole that is moved by a hundredth or left out counts however small it is.
Faces of the candidate count by area, so that splitting them changes nothing, and material too much
lowers the score.
"""

import argparse
import json
import time

import nurbs_hausdorff as nh


def score(truth: nh.Model, path: str, limit: float) -> dict:
    """Return the line of a candidate; one that cannot be read has the score 0 and the reason."""
    begun = time.perf_counter()
    try:
        candidate = nh.read(path)
    except nh.NurbsHausdorffError as error:
        return {"candidate": path, "score": 0.0, "error": error.code}
    result = nh.diff(truth, candidate, limit=limit)
    skipped = len(candidate.report.skipped)
    states = [face.state for face in result.faces_of_a]
    areas = [face["area"]["lower"] for face in candidate.info()["faces"]]
    within = sum(areas[face.face] for face in result.faces_of_b if face.state == "unchanged")
    share = states.count("unchanged") / len(states) * within / sum(areas)
    return {
        "candidate": path,
        "score": 0.0 if skipped else share,
        "state": "undecided" if skipped else result.state,
        "truth": faces(result.faces_of_a, "a"),
        "surplus": faces(result.faces_of_b, "b"),
        "skipped": skipped,
        "seconds": round(time.perf_counter() - begun, 4),
    }


def faces(found: tuple[nh.FaceDifference, ...], side: str) -> list[dict]:
    """Return the faces that are not unchanged, each with its interval and its farthest point."""
    return [
        {
            "face": face.face,
            "state": face.state,
            "interval": [face.lower, face.upper],
            "at": getattr(face.witness, side).point,
        }
        for face in found
        if face.state != "unchanged"
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("truth")
    parser.add_argument("candidates", nargs="+")
    parser.add_argument("--limit", type=float, default=1e-3, help="in model units")
    arguments = parser.parse_args()
    truth = nh.read(arguments.truth)
    for path in arguments.candidates:
        print(json.dumps(score(truth, path, arguments.limit)))


if __name__ == "__main__":
    main()
