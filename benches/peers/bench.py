"""Measures all peers on all pairs, in turn; `run.py` starts it in the right environment."""

import argparse
import csv
from pathlib import Path

from nurbs import save
from pairs.catalogue import catalogue
from peers import NAMES
from peers.ours import distance as certified
from peers.tessellated import forget
from places import WORK
from report import markdown, rows
from runner import Runner

# A peer that took longer is measured once: its time is not in question.
SLOW = 3.0

# The interval that errors are measured against: narrower than the one that is
# timed, where that can be had in the time.
REFERENCE_TOLERANCE = 1e-8
REFERENCE_SECONDS = 20


def main():
    arguments = parsed()
    runners = started([name for name in NAMES if wanted(name, arguments.peers) or name == "ours"])
    WORK.mkdir(exist_ok=True)
    results = []
    for pair in catalogue():
        if wanted(pair.name, arguments.pairs):
            results.append((pair, *measured(pair, runners, arguments)))
            write(arguments.out, runners, results, arguments.rounds)
    for runner in runners:
        runner.stop()


def parsed():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--rounds", type=int, default=3, help="measurements of each, of which the least is told"
    )
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one answer")
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


def wanted(name, texts):
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


def measured(pair, runners, arguments):
    """The reference interval, and the fastest answer of each peer."""
    paths = [WORK / f"{side}.json" for side in ("a", "b")]
    save(paths[0], pair.a)
    save(paths[1], pair.b)
    reference = certified([str(path) for path in paths], REFERENCE_TOLERANCE, REFERENCE_SECONDS)
    best = [None] * len(runners)
    forget()
    for _ in range(arguments.rounds):
        # Tessellated again in every round unless that takes long.
        if not any(slow(answer, "tessellate") for answer in best):
            forget()
        for index, runner in enumerate(runners):
            if best[index] and ("failed" in best[index] or slow(best[index], "solve")):
                continue
            answer = runner.measure(*paths, arguments.limit)
            if best[index] is None or answer.get("seconds", 0) < best[index]["seconds"]:
                best[index] = answer
    for runner, answer in zip(runners, best, strict=True):
        told = answer.get("failed") or f"{answer['value']:.9g} in {answer['seconds']:.4f} s"
        print(f"{pair.name:20} {runner.about['name']:16} {told}", flush=True)
    return reference, best


def slow(answer, part):
    return bool(answer) and answer.get("parts", {}).get(part, 0) > SLOW


def write(folder, runners, results, rounds):
    """The table so far, as Markdown and as CSV."""
    folder.mkdir(parents=True, exist_ok=True)
    abouts = [runner.about for runner in runners]
    table = rows(abouts, results)
    (folder / "table.md").write_text(markdown(abouts, table, rounds))
    with open(folder / "table.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(table[0]))
        writer.writeheader()
        writer.writerows(table)


if __name__ == "__main__":
    main()
