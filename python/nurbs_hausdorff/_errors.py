"""The package's one class of exceptions."""

from __future__ import annotations


class NurbsHausdorffError(Exception):
    """Anything that this package refuses or fails at.

    Attributes
    ----------
    code : str
        Stable code, the same in Rust, JavaScript and on the command line, such as
        ``"STEP_SYNTAX"``; ``"ARGUMENT_INVALID"`` is that of arguments of a wrong kind.
    message : str
        Place, value found and value expected.
    interval : tuple of float or None
        With code ``"CANCELLED"``, the interval (lower, upper) reached, in model units, if
        there is one.
    """

    code: str
    message: str
    interval: tuple[float, float] | None

    def __init__(
        self, code: str, message: str, interval: tuple[float, float] | None = None
    ) -> None:
        # The arguments are those that pickle calls the class with.
        super().__init__(code, message, interval)
        self.code = code
        self.message = message
        self.interval = interval

    def __str__(self) -> str:
        return f"[{self.code}] {self.message}"
