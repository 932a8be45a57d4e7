"""Ending on a signal as on Ctrl-C: what is open is closed, temporary folders go."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType

SIGNALS = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
"""What a process manager, or a terminal that is closed, sends."""


@contextmanager
def tidy_end() -> Iterator[None]:
    """Let signals that end the process run what is to be done at its end; also a decorator.

    By default they end it on the spot. Signals that the caller ignores, as ``nohup`` does,
    or treats in its own way stay as they are.
    """
    ours = [
        number
        for number in SIGNALS
        if current_thread() is main_thread() and signal.getsignal(number) is signal.SIG_DFL
    ]
    for number in ours:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, frame: FrameType | None) -> None:
    sys.exit(128 + number)  # what a shell reports for a process that a signal ended
