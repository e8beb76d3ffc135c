"""What runs of the native command cost: user seconds, and the cells of a search."""

import json
import os
import signal
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

# Seconds after which a run is ended, beyond those that its own budget allows.
GRACE = 60


@dataclass
class Cost:
    """The status of a run, its user seconds, and those of the search with its cells where it has any."""

    status: str
    seconds: float
    solve: float = 0.0
    cells: int = 0


def _run(words: list[str], seconds: int) -> tuple[int, str, float]:
    with tempfile.TemporaryFile("w+") as output:
        child = subprocess.Popen(words, stdout=output, stderr=subprocess.DEVNULL, preexec_fn=lambda: signal.alarm(seconds))
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        return child.returncode, output.read(), usage.ru_utime


def distance(command: Path, a: Path, b: Path, max_seconds: int) -> Cost:
    """Returns the cost of `distance` from a to b, to the default tolerance."""
    words = [str(command), "distance", str(a), str(b), "--json", "--max-seconds", str(max_seconds)]
    status, text, seconds = _run(words, max_seconds + GRACE)
    try:
        result = json.loads(text)
    except json.JSONDecodeError:
        return Cost(f"exit {status}", seconds)
    stop = "converged" if result["converged"] else result["stop"]
    return Cost(stop, seconds, result["seconds"]["solve"], result["cells"])


def diff(command: Path, a: Path, b: Path, limit: float, max_seconds: int) -> Cost:
    """Returns the cost of `diff` of a and b, of faces that are farther than the limit."""
    words = [str(command), "diff", str(a), str(b), "--limit", str(limit), "--json", "--max-seconds", str(max_seconds)]
    status, _, seconds = _run(words, max_seconds + GRACE)
    return Cost(f"exit {status}", seconds)
