"""The list of kinds, filled by their modules."""

from collections.abc import Callable

from ..numbers import Numbers

KINDS: dict[str, Callable[[Numbers], object]] = {}


def kind(make):
    """Registers a function that makes a part of random numbers under its own name."""
    KINDS[make.__name__] = make
    return make
