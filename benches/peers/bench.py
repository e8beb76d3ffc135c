"""Measures all peers on all pairs, in turn; `run.py` starts it in the right environment."""

import argparse
import csv
from pathlib import Path

from nurbs import save
from pairs.catalogue import catalogue
from peers import NAMES
from peers.ours import distance as certified
from peers.tessellated import MESHES
from places import WORK
from report import markdown, rows
from runner import Runner

# A peer that took longer is measured once: its time is not in question.
SLOW = 1.0

# Seconds for one answer of ours.
OURS_LIMIT = 180.0

# The interval that errors are measured against: narrower than the one that is
# timed, where that can be had in the time.
REFERENCE_TOLERANCE = 1e-8
REFERENCE_SECONDS = 5


def main():
    arguments = parsed()
    runners = started([name for name in NAMES if requested(name, arguments.peers) or name == "ours"])
    tessellation = Runner("triangles")
    results = []
    for pair in catalogue():
        if requested(pair.name, arguments.pairs):
            results.append((pair, *measured(pair, tessellation, runners, arguments)))
            write(arguments.out, runners, results, arguments.rounds)
    for runner in (tessellation, *runners):
        runner.stop()


def parsed():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--rounds", type=int, default=3, help="measurements of each peer; the shortest time is reported"
    )
    parser.add_argument("--limit", type=float, default=20.0, help="seconds for one answer")
    parser.add_argument(
        "--peers", default="", help="only those whose names contain one of these, separated by commas"
    )
    parser.add_argument(
        "--pairs", default="", help="only those whose names contain one of these, separated by commas"
    )
    parser.add_argument(
        "--out", type=Path, default=WORK / "results", help="folder for table.md and table.csv"
    )
    return parser.parse_args()


def requested(name, texts):
    return any(text in name for text in texts.split(","))


def started(names):
    """The peers that are there; says which are not."""
    runners = []
    for name in names:
        runner = Runner(name)
        if "name" not in runner.about:
            print(f"SKIPPED peer {name}: {runner.about.get('missing') or runner.about['failed']}", flush=True)
            continue
        print(f"{runner.about['name']}: {runner.about['settings']}", flush=True)
        runners.append(runner)
    return runners


def measured(pair, tessellation, runners, arguments):
    """The reference interval if no formula gives the distance, and each peer's fastest answer."""
    paths = [WORK / f"{side}.json" for side in ("a", "b")]
    save(paths[0], pair.a)
    save(paths[1], pair.b)
    reference = None
    if pair.truth is None:
        reference = certified([str(path) for path in paths], REFERENCE_TOLERANCE, REFERENCE_SECONDS)
    best, triangles = [None] * len(runners), None
    MESHES.unlink(missing_ok=True)
    for _ in range(arguments.rounds):
        if not final(triangles):
            triangles = tessellation.measure(*paths, arguments.limit)
        for index, runner in enumerate(runners):
            if final(best[index]):
                continue
            answer = runner.measure(*paths, limit(runner, arguments.limit))
            if best[index] is None or answer.get("seconds", 0) < best[index]["seconds"]:
                best[index] = answer
    for runner, answer in zip(runners, best, strict=True):
        text = answer.get("failed") or f"{answer['value']:.9g} in {answer['seconds']:.4f} s"
        print(f"{pair.name:20} {runner.about['name']:16} {text}", flush=True)
    return reference, best


def limit(runner, seconds):
    """Ours may take longer: without its time there are no ratios."""
    return OURS_LIMIT if runner.module == "ours" else seconds


def final(answer):
    """Whether another round would add nothing."""
    return answer is not None and ("failed" in answer or answer["seconds"] > SLOW)


def write(folder, runners, results, rounds):
    """The table so far, as Markdown and as CSV."""
    folder.mkdir(parents=True, exist_ok=True)
    abouts = [runner.about for runner in runners]
    table = rows(abouts, results)
    (folder / "table.md").write_text(markdown(abouts, table, rounds))
    with open(folder / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(table[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)


if __name__ == "__main__":
    main()
