"""Runs that are killed: at every line of the code that writes, and at any moment."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import thesis_pin.files
import thesis_pin.files.folder

_FOLDER = str(Path(thesis_pin.files.__file__).parent)
_ROOT = Path(__file__).parents[1]

Work = Sequence[Callable[[], object]]
"""What a run does, one after the other: functions and partials that can be pickled."""


class Killer:
    """Runs work in processes of their own and kills them; a context manager.

    They are forked from a small process that has loaded nothing but the code that writes: forking
    the process of the tests, which holds a gigabyte, takes ten times as long.
    """

    def __enter__(self) -> Killer:
        self._process = subprocess.Popen(
            [sys.executable, __file__],
            env=os.environ | {"PYTHONPATH": str(_ROOT)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()

    def at_line(self, work: Work, line: int) -> bool:
        """Whether work was killed as it came to its n-th line of our code."""
        return self._ended("line", work, line) == -signal.SIGKILL

    def after(self, work: Work, seconds: float) -> bool:
        """Whether work that is repeated for ever was killed; it always is."""
        return self._ended("seconds", work, seconds) == -signal.SIGKILL

    def _ended(self, *asked: object) -> int:
        pickle.dump(asked, self._process.stdin)
        self._process.stdin.flush()
        return pickle.load(self._process.stdout)


def one_by_one(write: Callable[..., object], *given: object) -> None:
    """Write as on a system that can't exchange two folders; for processes that end with it."""
    thesis_pin.files.folder.swap = lambda *_: False
    write(*given)


def _serve() -> None:
    """Fork, kill and tell the exit code until nobody asks any more."""
    asked, told = sys.stdin.buffer, sys.stdout.buffer
    while True:
        try:
            how, work, when = pickle.load(asked)
        except EOFError:
            return
        process = os.fork()
        if not process:
            _child(how, work, when)
        if how == "seconds":
            time.sleep(when)
            os.kill(process, signal.SIGKILL)
        pickle.dump(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), told)
        told.flush()


def _child(how: str, work: Work, when: float) -> None:
    try:
        if how == "line":
            _kill_at_line(when)
            for one in work:
                one()
        else:
            while True:
                for one in work:
                    one()
        os._exit(0)
    except BaseException as error:
        os.write(2, f"{error!r}\n".encode())
        os._exit(1)


def _kill_at_line(left: float) -> None:
    def trace(frame, event, _):
        nonlocal left
        if not frame.f_code.co_filename.startswith(_FOLDER):
            return None
        left -= event == "line"
        if left < 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return trace

    sys.settrace(trace)


if __name__ == "__main__":
    _serve()
