"""Kinds of parts, a module for each way of making them."""

from . import affine, blends, booleans, closed, freeform, lofts, revolved, seams, singular, sweeps
from .registry import KINDS

__all__ = ["KINDS"]
