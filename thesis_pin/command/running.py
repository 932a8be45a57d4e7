"""From a command line to an exit code: every way a command can end."""

from __future__ import annotations

import argparse
import contextlib
import errno
import gc
import os
import signal
import sys
import traceback
from collections.abc import Iterator, Sequence
from enum import IntEnum
from pathlib import Path
from threading import current_thread, main_thread
from types import FrameType

from thesis_pin.command.text import prepare_streams, say
from thesis_pin.errors import BadInput, CannotWrite, ThesisPinError
from thesis_pin.files import Claim, check_file, is_standard_output
from thesis_pin.model.engine import require_pinocchio


class ExitCode(IntEnum):
    """How a command ends. A closed pipe ends quietly with ``DONE``."""

    DONE = 0
    """Also when a limit is violated, unless ``--strict`` asks."""
    NO = 1
    """Done, and the answer is no; the reason is on standard output and in the JSON."""
    BAD_INPUT = 2
    """What was given can't be used."""
    CANNOT_WRITE = 3
    """An output couldn't be written."""
    BUG = 70
    """A mistake of ours."""
    INTERRUPTED = 130
    """By Ctrl-C; nothing is half-written."""


_FILES = ("json", "html", "markdown", "errata", "to", "film", "picture")
"""Options that name a file; ``-`` is standard output."""


@contextlib.contextmanager
def targets(parsed: argparse.Namespace) -> Iterator[None]:
    """Refuse outputs that can't be written before anything is worked out or written.

    While this lasts, no other run writes to ``--out``.

    Args:
        parsed: The parsed arguments; ``out`` becomes a claim on its folder.

    Raises:
        BadInput: Two outputs want the same place, or one would replace what is read.
        CannotWrite: An output can't be written.
        Busy: Another run is at work for the folder.
    """
    taken = [f"--{option}" for option in _FILES if is_standard_output(_value(parsed, option))]
    if len(taken) > 1:
        raise BadInput(
            f"{' and '.join(taken)} can't both be standard output",
            remedy="Write one of them to a file",
        )
    sources = _sources(parsed)
    named: dict[str, str] = {}
    for option in _FILES:
        if (target := _value(parsed, option)) is not None:
            if (source := _same(target, sources)) is not None:
                raise BadInput(
                    f"--{option} would replace {source!r}, which this command reads",
                    remedy="Name another file",
                )
            check_file(target)
            path = os.path.realpath(target)
            # A device or a pipe takes one after the other.
            if path in named and (os.path.isfile(path) or not os.path.exists(path)):
                raise BadInput(
                    f"--{named[path]} and --{option} can't both be {target!r}",
                    remedy="Name another file",
                )
            named[path] = option
    out = _value(parsed, "out")
    if out is None:
        yield
        return
    with Claim(out, keep=sources) as claim:
        if claim.mixture:
            say(
                f"{out} holds a mixture: a run was killed while it wrote {claim.mixture[0]}"
                + (f" and {len(claim.mixture) - 1} more files" if claim.mixture[1:] else "")
            )
        parsed.out = claim
        yield


def _sources(parsed: argparse.Namespace) -> list[str]:
    """Files that the arguments name and that aren't outputs."""
    values = [value for option, value in vars(parsed).items() if option not in (*_FILES, "out")]
    every = [one for value in values for one in (value if isinstance(value, list) else [value])]
    words = [one for one in every if isinstance(one, str) and "\0" not in one]
    return [word for word in words if os.path.isfile(word)]


def _same(target: str, sources: Sequence[str]) -> str | None:
    """Which of some files a target is, under whatever name."""
    with contextlib.suppress(OSError, ValueError):
        return next((one for one in sources if os.path.samefile(target, one)), None)
    return None


def free(parsed: argparse.Namespace) -> bool:
    """Whether standard output is still free for text."""
    return not any(is_standard_output(_value(parsed, option)) for option in _FILES)


def _value(parsed: argparse.Namespace, option: str) -> str | None:
    value: str | None = getattr(parsed, option, None)
    return value


SIGNALS = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
"""What a process manager, or a terminal that is closed, sends."""


@contextlib.contextmanager
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
        signal.signal(number, _exit)
    try:
        yield
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def _exit(number: int, frame: FrameType | None) -> None:
    sys.exit(128 + number)  # what a shell reports for a process that a signal ended


_MANY = 100_000  # objects


def collect_seldom() -> None:
    """Let Python seldom look for objects that only hold each other, in a process of its own.

    By its own measure, 700 objects more than before, imports alone make it look 70 times: 3 % of
    a report's time.
    """
    gc.set_threshold(_MANY, *gc.get_threshold()[1:])


_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EBADF}
"""What printing fails with; files report it as :class:`CannotWrite`, standard output can't."""


@tidy_end()
def run(parser: argparse.ArgumentParser, arguments: Sequence[str] | None = None) -> int:
    """Parse a command line and run its verb.

    Each verb's sub-parser sets ``run`` to a function of the parsed arguments
    that returns an exit code.

    Args:
        parser: The command's parser.
        arguments: Words after the command's name; None takes the process's.

    Returns:
        The exit code.
    """
    parsed = argparse.Namespace()
    prepare_streams()
    try:
        try:
            parser.parse_args(arguments, parsed)
        except SystemExit:  # help and version have printed, a wrong word has been named
            _flush()
            raise
        require_pinocchio()
        with targets(parsed):
            code = ExitCode(parsed.run(parsed))
        _flush()
        return code
    except CannotWrite as error:
        return _end(parser, ExitCode.CANNOT_WRITE, f"error: {error}")
    except ThesisPinError as error:
        return _end(parser, ExitCode.BAD_INPUT, f"error: {error}")
    except MemoryError:
        text = "error: there isn't enough memory for this; ask for less at once"
        return _end(parser, ExitCode.BAD_INPUT, text)
    except KeyboardInterrupt:
        return _end(parser, ExitCode.INTERRUPTED, "interrupted")
    except BrokenPipeError:
        # The reader of our output has left; there is nobody to tell.
        _drop_output()
        return ExitCode.DONE
    except Exception as error:
        if (end := _ended_by(error)) is not None:
            if isinstance(end, SystemExit):
                raise end from None
            return _end(parser, ExitCode.INTERRUPTED, "interrupted")
        if isinstance(error, OSError) and error.errno in _FULL:
            _drop_output()
            text = f"error: standard output can't be written: {error.strerror}"
            return _end(parser, ExitCode.CANNOT_WRITE, text)
        if getattr(parsed, "debug", False):
            traceback.print_exc()
        return _end(parser, ExitCode.BUG, _bug(error))


def _ended_by(error: BaseException) -> KeyboardInterrupt | SystemExit | None:
    """What a signal raised and compiled modules, while they are imported, call their failure."""
    while error.__cause__ is not None:
        error = error.__cause__
    return error if isinstance(error, KeyboardInterrupt | SystemExit) else None


def _end(parser: argparse.ArgumentParser, code: ExitCode, text: str) -> ExitCode:
    say(f"{parser.prog}: {text}")
    try:
        _flush()
    except OSError:
        _drop_output()
    return code


def _bug(error: Exception) -> str:
    """A mistake of ours in one line: what, where, and what to do with it."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    what = " ".join(f"{type(error).__name__}: {error}".split())
    return (
        f"bug: {what[:300]} ({Path(last.filename).name}, line {last.lineno}). This is our mistake: "
        "please report it with your command line, its files and what --debug adds"
    )


def _flush() -> None:
    if sys.stderr is not None:
        with contextlib.suppress(OSError):  # if nobody listens there, nobody is to be told
            sys.stderr.flush()
    if sys.stdout is not None:
        sys.stdout.flush()


def _drop_output() -> None:
    """Send what is still to be printed nowhere, or Python would complain about it at its end."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
