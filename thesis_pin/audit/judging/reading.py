"""A check in code gets its equation and has to read it: what isn't read can't hold."""

from __future__ import annotations

from collections.abc import Iterator
from typing import SupportsIndex, overload

from thesis_pin.equations.catalogue import Edition, Equation


class _Watched(tuple[str, ...]):
    """Members of an equation that remember which of them were looked at."""

    seen: set[int]

    @overload
    def __getitem__(self, key: SupportsIndex) -> str: ...
    @overload
    def __getitem__(self, key: slice) -> tuple[str, ...]: ...
    def __getitem__(self, key: SupportsIndex | slice) -> str | tuple[str, ...]:
        numbers = range(len(self))[key]
        self.seen |= set(numbers) if isinstance(numbers, range) else {numbers}
        return super().__getitem__(key)

    def __iter__(self) -> Iterator[str]:
        self.seen |= set(range(len(self)))
        return super().__iter__()


class Reading(Equation):
    """An equation as a check in code gets it: it remembers which printed members were read."""

    @classmethod
    def of(cls, equation: Equation) -> Reading:
        """The same equation, nothing of it read yet."""
        watched = _Watched(equation.printed)
        watched.seen = set()
        return cls.made(**dict(equation) | {"printed": watched})

    @property
    def unread(self) -> tuple[int, ...]:
        """Numbers of the members that nobody looked at."""
        watched = self.printed
        assert isinstance(watched, _Watched)
        return tuple(k + 1 for k in range(len(watched)) if k not in watched.seen)

    def members(self, edition: Edition) -> tuple[str, ...]:
        """As :meth:`Equation.members`; the corrected ones aren't a reading of the print."""
        if edition == "printed":
            return self.printed
        plain = Equation.made(**dict(self) | {"printed": tuple(tuple.__iter__(self.printed))})
        return plain.members(edition)
