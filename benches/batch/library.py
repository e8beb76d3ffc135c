"""Prints lines for `batch`: pairs of a library of parts.

    python library.py FOLDER [COUNT] > pairs.jsonl

FOLDER has interchange JSON of single shapes, and parts with an edit of each, NAME_a.brep and
NAME_b.brep. Of each ten pairs four are a part and its edit, three a model and itself, moved by up to
a hundredth of a unit, and three two different ones; all are decided at a limit of 0.01.
"""

import json
import random
import sys
from pathlib import Path

#: In model units.
LIMIT = 0.01


def main() -> None:
    folder, count = Path(sys.argv[1]).resolve(), int((sys.argv[2:] or ["10000"])[0])
    parts = sorted(folder.glob("*_a.brep"))
    models = [*parts, *sorted(folder.glob("*.json"))]
    draw = random.Random(1)
    for index in range(count):
        a = draw.choice(parts if index % 10 < 4 else models)
        line = {"id": index, "a": str(a), "b": str(a), "limit": LIMIT, "maxSeconds": 2}
        if index % 10 < 4:
            line["b"] = str(a).replace("_a.brep", "_b.brep")
        elif index % 10 < 7:
            line["transform"] = {"translation": [draw.uniform(-LIMIT, LIMIT) for _ in range(3)]}
        else:
            line["b"] = str(draw.choice(models))
        print(json.dumps(line))


if __name__ == "__main__":
    main()
