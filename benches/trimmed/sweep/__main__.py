"""Checks generated parts of all kinds.

    cd benches/trimmed && python -m sweep COMMAND OUT [--kinds A,B] [--seeds 0:20] [--jobs 2]

COMMAND is the native executable. Files and `findings.jsonl`, one line a part, go to OUT; parts
that are listed there already are not repeated. Each part is made in a process of its own, as
OpenCASCADE may end it. The exit status is 1 if there are findings.
"""

import argparse
import json
import os
import signal
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from parts import KINDS

from .command import Command
from .part import examine

# Seconds after which a part is given up.
MAX_SECONDS = 600
# Words of sentences that state that nothing was decided, or that OpenCASCADE failed.
UNDECIDED = ("may be farther", "not compared", "does not translate")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--kinds", default=",".join(KINDS), help="names with commas, all by default")
    parser.add_argument("--seeds", default="0:20", help="first and the one after the last; those from 900 are kept for checking")
    parser.add_argument("--jobs", type=int, default=1, help="parts at a time")
    parser.add_argument("--seconds", type=float, default=5.0, help="longest search")
    return parser.parse_args()


def one(options, kind: str, seed: int) -> dict:
    """Examines a part in a child process."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reading)
        # OpenCASCADE prints statistics of its translation.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        signal.alarm(MAX_SECONDS)
        try:
            outcome = asdict(examine(Command(options.command, options.seconds), options.out, kind, seed))
        except Exception as error:
            outcome = {"kind": kind, "seed": seed, "failed": f"{type(error).__name__}: {error}"[:300]}
        os.write(writing, json.dumps(outcome).encode())
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        text = pipe.read()
    _, status = os.waitpid(child, 0)
    return json.loads(text) if text else {"kind": kind, "seed": seed, "failed": f"ended with status {status}"}


def is_finding(sentence: str) -> bool:
    return not any(words in sentence for words in UNDECIDED)


def main() -> int:
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    first, last = map(int, options.seeds.split(":"))
    record = options.out / "findings.jsonl"
    known = [json.loads(line) for line in record.read_text().splitlines()] if record.exists() else []
    done = {(outcome["kind"], outcome["seed"]) for outcome in known}
    pending = [(kind, seed) for seed in range(first, last) for kind in options.kinds.split(",")]
    pending = [part for part in pending if part not in done]
    counts = Counter()
    with ThreadPoolExecutor(options.jobs) as pool, record.open("a") as lines:
        for outcome in pool.map(lambda part: one(options, *part), pending):
            lines.write(json.dumps(outcome) + "\n")
            lines.flush()
            report(outcome, counts)
    print(", ".join(f"{count} {name}" for name, count in counts.items()))
    return 1 if counts["with findings"] else 0


def report(outcome: dict, counts: Counter) -> None:
    counts["parts"] += 1
    name = f"{outcome['kind']} {outcome['seed']}"
    if "failed" in outcome:
        counts["not made"] += 1
        print(f"{name}: not made: {outcome['failed']}", flush=True)
        return
    findings = [sentence for sentence in outcome["findings"] if is_finding(sentence)]
    counts["undecided"] += len(outcome["findings"]) - len(findings)
    if findings:
        counts["with findings"] += 1
        validity = "" if outcome["valid"] else " (invalid by OpenCASCADE)"
        print(f"{name}{validity}:", *findings, sep="\n    ", flush=True)


if __name__ == "__main__":
    sys.exit(main())
