"""Damages files of CAD systems, of meshes and of points at random and has the command read them.

    python3 benches/trimmed/damage.py COMMAND COUNT SEED FILE...

Each damaged file has bytes, digits, references or lines changed, exchanged, repeated or left out, or
ends early. The command's `info` must end within MAX_SECONDS of CPU time, in MAX_BYTES of address space, with a
model or a coded error; every other end is printed, and its file kept in the working folder. The exit status is
1 if there is one. The largest CPU time and resident memory of a run are printed too.

A model is compared with that of the undamaged file. One of fewer faces, triangles or points, without a face
more that is skipped, a note more or a wider gap, is a *silent loss*: its file is kept as well, and it is counted by
the format and the damage, since formats that state no numbers cannot show a line that is missing. One of as
many parts and another area is counted as *other values*: a digit that was changed is part of a valid file.
"""

import collections
import io
import json
import random
import re
import resource
import struct
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

MAX_SECONDS = 10
# Of a run that waits without using the CPU; other programs slow a run as well.
MAX_WAITING_SECONDS = 300
MAX_BYTES = 1 << 30
# Exit statuses of a model that is read, and of a coded error.
EXPECTED = (0, 2)
KIBIBYTES_A_MEBIBYTE = 1024
# In STEP; in other texts, whole numbers, which references are among.
REFERENCE = re.compile(rb"#\d+")
WHOLE_NUMBER = re.compile(rb"(?<![\d.])\d+(?![\d.])")
# Areas that differ by less of themselves are the same, and gaps that are wider by less.
SAME_AREA, WIDER_GAP = 1e-9, 1e-9
# The pages of E57 and the checksum at the end of each, CRC-32C.
PAGE, CHECKED = 1024, 1020
CASTAGNOLI = 0x82F63B78


def bytes_changed(rng: random.Random, content: bytearray) -> bytearray:
    for _ in range(rng.randrange(1, 20)):
        content[rng.randrange(len(content))] = rng.randrange(256)
    return content


def digits_changed(rng: random.Random, content: bytearray) -> bytearray:
    digits = [index for index, byte in enumerate(content) if 48 <= byte <= 57]
    for _ in range(rng.randrange(1, 30) if digits else 0):
        content[rng.choice(digits)] = rng.randrange(48, 58)
    return content


def references_changed(rng: random.Random, content: bytearray) -> bytearray:
    pattern = REFERENCE if REFERENCE.search(content) else WHOLE_NUMBER
    found = [match.span() for match in pattern.finditer(content)]
    chosen = sorted(rng.sample(found, min(len(found), rng.randrange(1, 10))), reverse=True)
    others = [bytes(content[slice(*rng.choice(found))]) for _ in chosen]
    for (start, end), other in zip(chosen, others):
        content[start:end] = other
    return content


def ended_early(rng: random.Random, content: bytearray) -> bytearray:
    return content[: rng.randrange(1, len(content))]


def lines_left_out(rng: random.Random, content: bytearray) -> bytearray:
    lines = content.split(b"\n")
    for _ in range(min(rng.randrange(1, 6), len(lines) - 1)):
        del lines[rng.randrange(len(lines))]
    return bytearray(b"\n".join(lines))


def lines_exchanged(rng: random.Random, content: bytearray) -> bytearray:
    lines = content.split(b"\n")
    for _ in range(rng.randrange(1, 6)):
        first, second = rng.randrange(len(lines)), rng.randrange(len(lines))
        lines[first], lines[second] = lines[second], lines[first]
    return bytearray(b"\n".join(lines))


def repeated(rng: random.Random, content: bytearray) -> bytearray:
    start = rng.randrange(len(content))
    at = rng.randrange(len(content))
    content[at:at] = content[start : start + rng.randrange(1, 2000)]
    return content


Damage = Callable[[random.Random, bytearray], bytearray]

DAMAGES = (
    bytes_changed,
    digits_changed,
    references_changed,
    ended_early,
    lines_left_out,
    lines_exchanged,
    repeated,
)


def checksum(content: bytes) -> bytes:
    total = 0xFFFFFFFF
    for byte in content:
        total ^= byte
        for _ in range(8):
            total = total >> 1 ^ (CASTAGNOLI if total & 1 else 0)
    return struct.pack(">I", total ^ 0xFFFFFFFF)


def damaged(rng: random.Random, damage: Damage, suffix: str, content: bytes) -> bytes:
    """Damages a file, or half of the time what is in an archive or what the checksums of E57 are of."""
    if suffix not in (".3mf", ".e57") or rng.random() < 0.5:
        return bytes(damage(rng, bytearray(content)))
    if suffix == ".e57":
        checked = b"".join(content[start : start + CHECKED] for start in range(0, len(content), PAGE))
        found = bytes(damage(rng, bytearray(checked)))
        pages = [found[start : start + CHECKED].ljust(CHECKED, b"\0") for start in range(0, len(found), CHECKED)]
        return b"".join(page + checksum(page) for page in pages)
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as source, zipfile.ZipFile(made, "w") as target:
        for name in source.namelist():
            target.writestr(name, bytes(damage(rng, bytearray(source.read(name)))))
    return made.getvalue()


def limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MAX_BYTES, MAX_BYTES))
    resource.setrlimit(resource.RLIMIT_CPU, (MAX_SECONDS, MAX_SECONDS))


def cpu_seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def parts(model: dict) -> int:
    """The number of faces, triangles and points of a model, as `info` prints it."""
    counts = model["counts"]
    return len(model["faces"]) + counts.get("triangles", 0) + counts.get("points", 0)


def area(model: dict) -> float:
    return (model["area"]["lower"] + model["area"]["upper"]) / 2


def remarks(model: dict) -> set[str]:
    """What is left out of a model and what is noted, each in its words."""
    return {json.dumps(remark, sort_keys=True) for name in ("skipped", "notes") for remark in model.get(name, ())}


def kind_of_model(whole: dict, model: dict) -> str:
    """Says how the model of a damaged file differs from that of the whole one, and whether `info` says so."""
    wider = WIDER_GAP * whole["diagonal"] + 2 * whole["gap"]
    is_said = bool(remarks(model) - remarks(whole)) or model["gap"] > wider
    if parts(model) < parts(whole):
        return "loss that is said" if is_said else "silent loss"
    if parts(model) > parts(whole):
        return "more"
    if abs(area(model) - area(whole)) <= SAME_AREA * abs(area(whole)):
        return "the same"
    return "other values, said" if is_said else "other values"


def info(command: str, path: Path) -> tuple[int | None, bytes]:
    words = [command, "info", "--json", str(path)]
    try:
        run = subprocess.run(words, capture_output=True, timeout=MAX_WAITING_SECONDS, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return None, b""
    return run.returncode, run.stdout


def main() -> int:
    command, count, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    files = [(Path(name), Path(name).read_bytes()) for name in sys.argv[4:]]
    wholes = [json.loads(info(command, path)[1]) for path, _ in files]
    rng = random.Random(seed)
    ends, kinds, silent = collections.Counter(), collections.Counter(), collections.Counter()
    slowest, unexpected = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            (source, content), whole = rng.choice(list(zip(files, wholes)))
            damage = rng.choice(DAMAGES)
            path = Path(folder) / f"damaged{source.suffix}"
            path.write_bytes(damaged(rng, damage, source.suffix, content))
            before = cpu_seconds()
            end, printed = info(command, path)
            slowest = max(slowest, cpu_seconds() - before)
            ends[end] += 1
            kind = kind_of_model(whole, json.loads(printed)) if end == 0 else None
            kinds[kind or "none"] += 1
            if kind == "silent loss":
                silent[(source.name, damage.__name__)] += 1
            if end not in EXPECTED or kind == "silent loss":
                unexpected += end not in EXPECTED
                kept = Path(f"damaged-{seed}-{number}{source.suffix}")
                kept.write_bytes(path.read_bytes())
                print(f"{kept}: {kind or f'ended with {end}'} of {source.name} after {damage.__name__}", flush=True)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / KIBIBYTES_A_MEBIBYTE
    print(f"{count} files: exit statuses {dict(ends)}, slowest {slowest:.2f} CPU s, at most {peak:.0f} MiB")
    print(f"models: {dict(kinds)}")
    for (name, damage), times in sorted(silent.items()):
        print(f"silent loss: {name}, {damage}: {times}")
    return 1 if unexpected else 0


if __name__ == "__main__":
    sys.exit(main())
