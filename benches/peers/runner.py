"""Peers as processes, with a limit of time for each answer."""

import json
import select
import subprocess
import sys

from places import HERE

# To import a peer and to say what it is.
START_LIMIT = 120.0


class Runner:
    """A peer's process, started again after a crash or a time limit."""

    def __init__(self, module):
        self.module = module
        self.process = None
        self.about = self._start()

    def _start(self):
        command = [sys.executable, str(HERE / "worker.py"), self.module]
        # What libraries print is of no use to a reader of the table.
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            cwd=HERE,
        )
        return self._answer(START_LIMIT)

    def _answer(self, limit):
        """The next line, or why there is none."""
        ready, _, _ = select.select([self.process.stdout], [], [], limit)
        line = self.process.stdout.readline() if ready else ""
        if line:
            return json.loads(line)
        self.stop()
        return {"failed": "crashed"} if ready else {"failed": f"over {limit:g} s", "limit": limit}

    def measure(self, a, b, limit):
        """One answer: `value`, `seconds`, `parts`, `interval`, or `failed`."""
        if "missing" in self.about:
            return {"failed": self.about["missing"]}
        if self.process is None:
            self._start()
        print(json.dumps({"a": str(a), "b": str(b)}), file=self.process.stdin, flush=True)
        return self._answer(limit)

    def stop(self):
        """Ends the process."""
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None
