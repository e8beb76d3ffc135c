"""The pairs of the shared models, whose intervals an independent program computed."""

import json
from pathlib import Path

import pytest

import nurbs_hausdorff as nh

MODELS = Path(__file__).parents[3] / "shared" / "models"

pytestmark = pytest.mark.skipif(
    not (MODELS / "reference.jsonl").exists(), reason="there is no ../shared/models"
)


def references():
    path = MODELS / "reference.jsonl"
    lines = path.read_text().splitlines() if path.exists() else []
    return [json.loads(line) for line in lines]


@pytest.mark.parametrize("pair", references(), ids=lambda pair: f"{pair['a']}-{pair['b']}")
def test_intervals_meet_those_of_the_references(pair):
    a, b = (nh.read(MODELS / f"{pair[side]}.json") for side in "ab")
    motion = nh.Transform(translation=tuple(pair["translate_a"]))
    result = nh.distance(a, b, transform=motion)
    expected = pair["result"]
    assert result.converged
    # Both contain the true distance.
    assert result.lower <= expected["upper"] and expected["lower"] <= result.upper
