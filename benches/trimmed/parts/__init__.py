"""Trimmed parts made at random: `make(kind, seed)` returns the same shape for the same seed."""

from .kinds import KINDS
from .numbers import Numbers

__all__ = ["KINDS", "make"]


def make(kind: str, seed: int):
    """Returns the shape of a kind and seed.

    Raises whatever OpenCASCADE raises where the drawn numbers give no such part.
    """
    return KINDS[kind](Numbers(f"{kind}{seed}"))
