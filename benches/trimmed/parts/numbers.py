"""Random numbers by names, so that one more number changes no other."""

import math
import random

from OCP.gp import gp_Dir


class Numbers:
    """Numbers that depend on the seed and on their own name only."""

    def __init__(self, seed: str):
        self._seed = seed

    def _source(self, name: str) -> random.Random:
        return random.Random(f"{self._seed}/{name}")

    def real(self, name: str, low: float, high: float) -> float:
        return self._source(name).uniform(low, high)

    def whole(self, name: str, low: int, high: int) -> int:
        """Returns an integer from `low` to `high`, both included."""
        return self._source(name).randint(low, high)

    def unit(self, name: str) -> list[float]:
        """Returns a vector of length 1, all directions being equally likely."""
        source = self._source(name)
        vector = [source.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*vector)
        return [coordinate / length for coordinate in vector]

    def direction(self, name: str) -> gp_Dir:
        return gp_Dir(*self.unit(name))
