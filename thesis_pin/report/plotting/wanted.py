"""How figures are to be written: apart from what draws them, which a command seldom needs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

FORMATS = ("png", "svg", "pdf")
"""What figures can be written as."""

DOTS = 150
"""Pixels of an inch."""


@dataclass(frozen=True)
class Wanted:
    """How figures are to be written.

    Attributes:
        formats: Of :data:`FORMATS`, each once.
        dots: Pixels of an inch, of PNGs.
        size: Width and height [inch]; None for what suits each figure.
    """

    formats: tuple[str, ...] = ("png", "svg")
    dots: int = DOTS
    size: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Refuse what can't be written.

        Raises:
            BadInput: Says what.
        """
        known = set(self.formats) <= set(FORMATS)
        if not known or not self.formats or len(set(self.formats)) < len(self.formats):
            said = ",".join(map(str, self.formats))
            raise BadInput(
                f"formats of figures are {shown(said)}", allowed=f"{', '.join(FORMATS)}, each once"
            )
        if not 30 <= self.dots <= 1200:
            raise BadInput(f"dots of an inch are {shown(self.dots)}", allowed="30 to 1200")
        if self.size is not None and not all(0.5 <= side <= 50 for side in self.size):
            width, height = self.size
            raise BadInput(
                f"the size of figures is {width:.4g} by {height:.4g} inches",
                allowed="0.5 to 50 inches (12.7 to 1270 mm) each way",
            )


_WANTED: ContextVar[Wanted] = ContextVar("_WANTED", default=Wanted())  # noqa: B039 (frozen)


def wanted_now() -> Wanted:
    """How figures are to be written here."""
    return _WANTED.get()


@contextmanager
def written_as(wanted: Wanted) -> Iterator[None]:
    """Figures made meanwhile are laid out and written so, whoever makes them."""
    before = _WANTED.set(wanted)
    try:
        yield
    finally:
        _WANTED.reset(before)
