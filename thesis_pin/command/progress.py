"""Progress bars of both commands: on standard error, on a terminal only, gone at the end."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rich.progress import Progress

Thing = TypeVar("Thing")

LONG = 20_000
"""Samples from which a report takes longer than a second or two."""


class Bar:
    """A bar for what reports its progress as ``bar(done, total)``.

    Args:
        what: What is going on.
        wanted: Whether there is enough to do.
    """

    def __init__(self, what: str, *, wanted: bool = True) -> None:
        self.what, self.wanted = what, wanted
        self._bar: Progress | None = None

    def __enter__(self) -> Bar:
        if self.wanted and sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

            columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bar.add_task(self.what, total=None)
            self._bar.start()
        return self

    def __call__(self, done: int, total: int) -> None:
        """Show that ``done`` of ``total`` is done."""
        if self._bar is not None:
            self._bar.update(self._task, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.stop()


def track(things: Iterable[Thing], what: str, total: int) -> Iterator[Thing]:
    """The same things one by one, with a bar that counts them."""
    with Bar(what) as bar:
        for done, thing in enumerate(things):
            bar(done, total)
            yield thing
