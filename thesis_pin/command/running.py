"""From a command line to an exit code: every way a command can end."""

from __future__ import annotations

import argparse
import contextlib
import errno
import os
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from thesis_pin.command.exits import ExitCode
from thesis_pin.command.messages import say
from thesis_pin.command.readable import prepare_streams
from thesis_pin.command.targets import targets
from thesis_pin.command.termination import tidy_end
from thesis_pin.errors import CannotWrite, ThesisPinError
from thesis_pin.model.engine import require_pinocchio

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
        if isinstance(error, OSError) and error.errno in _FULL:
            _drop_output()
            text = f"error: standard output can't be written: {error.strerror}"
            return _end(parser, ExitCode.CANNOT_WRITE, text)
        if getattr(parsed, "debug", False):
            traceback.print_exc()
        return _end(parser, ExitCode.BUG, _bug(error))


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
    if sys.stdout is not None:
        sys.stdout.flush()


def _drop_output() -> None:
    """Send what is still to be printed nowhere, or Python would complain about it at its end."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
