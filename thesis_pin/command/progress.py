"""Progress of the commands: on a terminal's standard error after two seconds, gone at the end."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rich.progress import Progress

Thing = TypeVar("Thing")

PATIENCE = 2.0
"""Seconds that nobody minds waiting without a word."""


class Bar:
    """A bar for what takes long; also for what reports its progress as ``bar(done, total)``.

    Args:
        what: What is going on.
        after: Seconds after which it is shown; None takes :data:`PATIENCE`.
        left: Whether to count, and say how long it still takes.
    """

    def __init__(self, what: str, *, after: float | None = None, left: bool = False) -> None:
        self.what, self.after, self.left = what, PATIENCE if after is None else after, left
        self._done: tuple[int, int | None] = (0, None)
        self._lock, self._over = threading.Lock(), False
        self._bar: Progress | None = None
        self._timer: threading.Timer | None = None

    def __enter__(self) -> Bar:
        if sys.stderr is None or not sys.stderr.isatty():
            return self
        if self.after <= 0:
            self._show()
        else:
            self._timer = threading.Timer(self.after, self._show)
            self._timer.daemon = True
            self._timer.start()
        return self

    def _show(self) -> None:
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            MofNCompleteColumn,
            Progress,
            ProgressColumn,
            TextColumn,
            TimeElapsedColumn,
            TimeRemainingColumn,
        )

        columns: list[ProgressColumn] = [
            TextColumn("{task.description}"),
            BarColumn(),
            TimeElapsedColumn(),
        ]
        if self.left:
            columns += [MofNCompleteColumn(), TimeRemainingColumn(), TextColumn("left")]
        with self._lock:
            if self._over:
                return
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            done, total = self._done
            self._task = self._bar.add_task(self.what, completed=done, total=total)
            self._bar.start()

    def __call__(self, done: int, total: int) -> None:
        """Show that ``done`` of ``total`` is done."""
        self._done = (done, total)
        if self._bar is not None:
            self._bar.update(self._task, completed=done, total=total)

    def __exit__(self, *_: object) -> None:
        if self._timer is not None:
            self._timer.cancel()
        with self._lock:
            self._over = True
            if self._bar is not None:
                self._bar.stop()


def track(things: Iterable[Thing], what: str, total: int) -> Iterator[Thing]:
    """The same things one by one, with a bar that counts them."""
    with Bar(what) as bar:
        for done, thing in enumerate(things):
            bar(done, total)
            yield thing
