"""One generated part, in three formats, through all checks."""

from dataclasses import dataclass, field
from pathlib import Path

import parts

from .checks import Subject, agreement, coverage, reading
from .command import Command
from .shapes import is_valid, through_iges, through_step

# Every third STEP file is in inches.
INCH_PERIOD = 3
# The readings of one part that are compared with each other: "own" is that of the command, the
# others are translations by OpenCASCADE to BREP text.
COMPARED = (
    ("brep", "step"),
    ("brep", "iges"),
    ("brep", "own step"),
    ("brep", "own iges"),
    ("own step", "own iges"),
)
# Distance between edge and surface, relative to the diagonal, that a translation adds where the
# file itself is broken: OpenCASCADE writes the ellipses of oblique sections to IGES up to a
# hundredth of the part off, and reads them so.
MAX_EDGE_CHANGE = 1e-5
# Change of the area, relative to it, with which a translated part is another one.
MAX_AREA_CHANGE = 1e-4


@dataclass
class Outcome:
    """The findings about a part, each a sentence that begins with the format."""

    kind: str
    seed: int
    valid: bool = True
    findings: list[str] = field(default_factory=list)


def same_part(original: Subject, translated: Subject) -> bool:
    """Whether OpenCASCADE translated a part to one of its area: it loses faces of some revolutions with poles."""
    if translated is original:
        return True
    return is_valid(translated.shape) and abs(translated.area - original.area) <= MAX_AREA_CHANGE * original.area


def has_edges(original: Subject, translated: Subject) -> bool:
    """Whether a file's edges lie on its surfaces, as OpenCASCADE reads them."""
    return translated.tolerance <= original.tolerance + MAX_EDGE_CHANGE * original.diagonal


def examine(command: Command, folder: Path, kind: str, seed: int) -> Outcome:
    """Makes the part, writes it to `folder` and checks it.

    Raises what OpenCASCADE raises where the drawn numbers give no part.
    """
    shape = parts.make(kind, seed)
    base = folder / f"{kind}_{seed}"
    outcome = Outcome(kind, seed, is_valid(shape))
    subjects = {"brep": Subject.as_brep(shape, Path(f"{base}.brep"))}
    unit = "INCH" if seed % INCH_PERIOD == 1 else "MM"
    for name, translate in (
        ("step", lambda: through_step(shape, Path(f"{base}.step"), unit)),
        ("iges", lambda: through_iges(shape, Path(f"{base}.iges"))),
    ):
        try:
            subjects[name] = Subject.as_brep(translate(), Path(f"{base}.{name}.brep"))
        except Exception as error:
            outcome.findings.append(f"{name}: OpenCASCADE does not translate it: {error}")
    for name in ("step", "iges"):
        if name in subjects:
            # The same file by the command's own reader.
            subjects[f"own {name}"] = Subject(subjects[name].shape, Path(f"{base}.{name}"))
    for name in list(subjects):
        if not same_part(subjects["brep"], subjects[name]):
            outcome.findings.append(f"{name}: not compared: OpenCASCADE's translation changes or breaks it")
            del subjects[name]
        elif name.startswith("own") and not has_edges(subjects["brep"], subjects[name]):
            off = subjects[name].tolerance
            outcome.findings.append(f"{name}: not compared: OpenCASCADE reads its edges {off:.3g} off their surfaces")
            del subjects[name]
    for name, subject in subjects.items():
        found = reading(command, subject)
        if subject.readable:
            found += coverage(command, subject)
        outcome.findings += [f"{name}: {sentence}" for sentence in found]
    for first, second in COMPARED:
        if first in subjects and second in subjects:
            found = agreement(command, subjects[first], subjects[second])
            outcome.findings += [f"{first} and {second}: {sentence}" for sentence in found]
    return outcome
