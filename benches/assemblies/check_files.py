"""What `check` says of each CAD file of a folder: bodies, pairs by their states, faces left out, CPU seconds.

    python benches/assemblies/check_files.py COMMAND FOLDER [SECONDS]

A line of JSON a file, in the order of their names. A file that is refused has its error; one that takes longer than
SECONDS (60) by the command's own limit says so by its undecided pairs.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from collections import Counter
from pathlib import Path

ENDINGS = {".step", ".stp", ".iges", ".igs", ".brep", ".fcstd"}

#: What a process may take beyond its own limit of time, in seconds.
GRACE = 60.0


def checked(command: str, file: Path, seconds: float) -> dict[str, object]:
    """Return what the command says of a file."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    arguments = [command, "check", "--json", "--max-seconds", str(seconds), str(file)]
    try:
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=seconds + GRACE)
        answer = json.loads(done.stdout)
    except (subprocess.TimeoutExpired, ValueError) as error:
        return {"file": file.name, "failed": type(error).__name__}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found: dict[str, object] = {"file": file.name, "verdict": answer.get("verdict")}
    if "error" in answer:
        return found | {"error": answer["error"].get("code")}
    return found | {
        "bodies": len(answer["bodies"]),
        "pairs": dict(Counter(pair["state"] for pair in answer["pairs"])),
        "closed": sum(bool(body["closed"]) for body in answer["bodies"]),
        "leftOut": sum(len(of_file) for of_file in answer["skipped"]),
        "cpuSeconds": round(after.ru_utime - before.ru_utime, 2),
    }


def main() -> None:
    command, folder = sys.argv[1:3]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 60.0
    for file in sorted(Path(folder).iterdir()):
        if file.suffix.lower() in ENDINGS:
            print(json.dumps(checked(command, file, seconds)), flush=True)


if __name__ == "__main__":
    main()
