"""Runs that are killed: at every line of the code that writes, and at any moment."""

import os
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path

import thesis_pin.files

_FOLDER = str(Path(thesis_pin.files.__file__).parent)


def killed_at_line(work: Callable[[], object], line: int) -> bool:
    """Whether work in a process of its own was killed as it came to its n-th line of our code."""

    def child() -> None:
        left = line

        def trace(frame, event, _):
            nonlocal left
            if not frame.f_code.co_filename.startswith(_FOLDER):
                return None
            left -= event == "line"
            if left < 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return trace

        sys.settrace(trace)
        work()

    return _ended(child) == -signal.SIGKILL


def killed_after(work: Callable[[], object], seconds: float) -> bool:
    """Whether work that is repeated for ever in a process of its own was killed; it always is."""

    def child() -> None:
        while True:
            work()

    return _ended(child, seconds) == -signal.SIGKILL


def _ended(child: Callable[[], object], seconds: float | None = None) -> int:
    process = os.fork()
    if not process:
        try:
            child()
            os._exit(0)
        except BaseException as error:
            os.write(2, f"{error!r}\n".encode())
            os._exit(1)
    if seconds is not None:
        time.sleep(seconds)
        os.kill(process, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
