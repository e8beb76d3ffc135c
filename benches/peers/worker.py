"""One peer in a process of its own: a crash or a time limit costs only its answer.

`worker.py MODULE`: reads a JSON object a line, `{"a": path, "b": path}`, and
answers each with one.
"""

import importlib
import json
import os
import sys

from nurbs import load


def main():
    # Libraries print what they like to stdout; the answers have a pipe to themselves.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)

    def answer(**fields):
        print(json.dumps(fields), file=answers, flush=True)

    try:
        peer = importlib.import_module(f"peers.{sys.argv[1]}").Peer()
    except Exception as failure:  # any import may fail, in any way
        answer(missing=f"{type(failure).__name__}: {failure}")
        return
    answer(name=peer.name, guarantee=peer.guarantee, settings=peer.settings)
    for line in sys.stdin:
        paths = [json.loads(line)[side] for side in ("a", "b")]
        try:
            peer.prepare(paths, *map(load, paths))
            result = peer.measure()
        except Exception as failure:  # a peer's errors are its own
            answer(failed=str(failure) or type(failure).__name__)
            continue
        answer(value=result.value, seconds=result.seconds, parts=result.parts, interval=result.interval)


if __name__ == "__main__":
    main()
