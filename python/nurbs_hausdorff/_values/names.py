"""Names in snake case for those in camel case that the native half has."""

from __future__ import annotations

import re
from typing import Any

_CAPITAL = re.compile(r"(?<=[a-z])(?=[A-Z0-9])|(?<=[A-Z])(?=[A-Z][a-z])")


def camel(name: str) -> str:
    """Return ``max_cells`` as ``maxCells``."""
    first, *others = name.split("_")
    return first + "".join(part.capitalize() for part in others)


def snake(value: Any) -> Any:
    """Return a native result with its keys in snake case, at every depth."""
    if isinstance(value, dict):
        return {_CAPITAL.sub("_", key).lower(): snake(item) for key, item in value.items()}
    if isinstance(value, list):
        return [snake(item) for item in value]
    return value


def options(**given: Any) -> dict[str, Any]:
    """Return the options that were given, by their native names; the others have defaults."""
    return {camel(name): value for name, value in given.items() if value is not None}
