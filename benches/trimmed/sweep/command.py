"""The native command, run on files within a time."""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

# Seconds after which a run counts as hanging, beyond those that its own budget allows.
GRACE = 120


@dataclass
class Refused(Exception):
    """A run that gave no result: its exit status and what it printed, or None for no end."""

    status: int | None
    message: str


@dataclass
class Command:
    """The executable, and how long it may search."""

    path: Path
    max_seconds: float

    def info(self, model: Path) -> tuple[dict, list[str]]:
        """Returns `info --json` of a file, and the warnings, one a face left out."""
        return self._run("info", model, "--json")

    def distance(self, a: Path, b: Path, *options: str) -> dict:
        """Returns `distance --json` from a to b."""
        budget = ("--max-seconds", str(self.max_seconds))
        result, _ = self._run("distance", a, b, "--json", *budget, *options)
        return result

    def _run(self, *arguments) -> tuple[dict, list[str]]:
        words = [str(self.path), *map(str, arguments)]
        try:
            run = subprocess.run(words, capture_output=True, text=True, timeout=self.max_seconds + GRACE)
        except subprocess.TimeoutExpired as error:
            raise Refused(None, "no end") from error
        try:
            return json.loads(run.stdout), run.stderr.strip().splitlines()
        except json.JSONDecodeError as error:
            raise Refused(run.returncode, run.stderr.strip()[-300:]) from error
