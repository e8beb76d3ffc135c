"""Measures trimmed parts and holds the intervals against OpenCASCADE's distances.

    python run.py COMMAND PAIRS MODELS [--tolerance T]

COMMAND is the `nurbs-hausdorff` executable, PAIRS the folder that `pairs.py` wrote,
MODELS the folder of the shared models, whose `trimmed.jsonl` holds distances that
OpenCASCADE found from points of A's faces and edges, the farthest polished: a lower
bound but for its own errors, so that it must not exceed `upper`.
"""

import argparse
import json
import subprocess
import time
from pathlib import Path

# What a distance of OpenCASCADE may exceed `upper` by, relative to the diagonal:
# its vertices and edges have tolerances of micrometres.
AGREEMENT = 1e-6

# Pairs without a reference: a translator's copy, and an edited part.
OTHERS = [
    ("NIST_MBE_PMI_1.stp", "NIST_MBE_PMI_1.stp.iges"),
    ("linkrods.step", "linkrods.step.iges"),
    ("NIST_MBE_PMI_2.stp", "nist_2_bore"),
]


def measure(arguments, a, b):
    command = [arguments.command, "distance", arguments.pairs / f"{a}.brep", arguments.pairs / f"{b}.brep"]
    options = ["--json", "--max-seconds", "60", "--relative-tolerance", str(arguments.tolerance)]
    start = time.perf_counter()
    run = subprocess.run([*command, *options], capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if run.returncode != 0:
        return None, run.stderr.strip(), seconds
    return json.loads(run.stdout), None, seconds


def row(arguments, a, b, truth):
    result, error, seconds = measure(arguments, a, b)
    if result is None:
        return f"| {a} | {b} | {error} | | | | | |"
    lower, upper, diagonal = result["lower"], result["upper"], result["diagonal"]
    verdict = ""
    if truth is not None:
        holds = truth <= upper + AGREEMENT * diagonal
        agrees = abs(truth - result["computed"]) <= AGREEMENT * diagonal
        verdict = ("agrees" if agrees else "differs") if holds else "**EXCEEDS UPPER**"
    times = result["seconds"]
    return (
        f"| {a} | {b} | [{lower:.9g}, {upper:.9g}] | {(upper - lower) / diagonal:.1e} | {result.get('gap', 0):.1e} "
        f"| {times['prepare']:.2f} | {times['solve']:.2f} | {seconds:.2f} | {truth if truth is not None else ''} {verdict} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("pairs", type=Path)
    parser.add_argument("models", type=Path)
    parser.add_argument("--tolerance", type=float, default=1e-6)
    arguments = parser.parse_args()
    print("| A | B | interval | width / diagonal | model gap | prepare, s | solve, s | all, s | OpenCASCADE |")
    print("|---|---|---|---|---|---|---|---|---|")
    for line in (arguments.models / "trimmed.jsonl").read_text().splitlines():
        reference = json.loads(line)
        a, b = reference["a"], reference["b"]
        print(row(arguments, a, b, reference["forward"]), flush=True)
        print(row(arguments, b, a, reference["reverse"]), flush=True)
    for a, b in OTHERS:
        print(row(arguments, a, b, None), flush=True)
        print(row(arguments, b, a, None), flush=True)


if __name__ == "__main__":
    main()
