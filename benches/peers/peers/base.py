"""What every peer offers."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Answer:
    """A directed distance and the seconds from arrays in memory to it.

    `parts` states where the time went, in seconds by name; `interval` is what a
    peer with a guarantee says contains the distance of the surfaces.
    """

    value: float
    seconds: float
    parts: dict
    interval: tuple[float, float] | None = None


class Base:
    """A peer. The worker makes one in a process of its own."""

    name = ""
    # What its answer is certain of.
    guarantee = ""
    # How it was set up, for the table.
    settings = ""

    def prepare(self, paths, a, b):
        """Takes the two files and their surfaces as arrays; not timed.

        Only what brings the same arrays to the peer's own memory is done here.
        """
        raise NotImplementedError

    def measure(self):
        """The `Answer`; timed by the peer itself, from arrays to distance."""
        raise NotImplementedError
