"""What both commands share: errors → exit code 2, tables, files written whole.

Results go to standard output, messages to standard error. Exit codes: 0 done,
1 done but a limit is violated (only where a verb has ``--strict``), 2 bad input.
"""

from __future__ import annotations

import argparse
import os
import stat
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from thesis_pin.command.termination import tidy_end
from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.numeric.checks import MOST, shown

if TYPE_CHECKING:
    from thesis_pin.pages.scene import Scene

OK, LIMIT_VIOLATED, BAD_INPUT = 0, 1, 2


class Parser(argparse.ArgumentParser):
    """An argument parser whose examples keep their line breaks."""

    def __init__(self, *args, **kwargs) -> None:  # type: ignore[no-untyped-def]
        kwargs.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        kwargs.setdefault("allow_abbrev", False)
        super().__init__(*args, **kwargs)

    def parse_args(self, args=None, namespace=None):
        """As argparse does, but refuse ``--flag=--``, of which argparse makes an empty list."""
        for word in sys.argv[1:] if args is None else args:
            if word.startswith("--") and word.endswith("=--"):
                self.error(f"argument {word[:-3]}: '--' is no value")
        return super().parse_args(args, namespace)


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
    parsed = parser.parse_args(arguments)
    try:
        check_targets(parsed)
        return parsed.run(parsed)
    except ThesisPinError as error:
        print(f"{parser.prog}: error: {error}", file=sys.stderr)
        return BAD_INPUT
    except MemoryError:
        print(
            f"{parser.prog}: error: there isn't enough memory for this; ask for less at once",
            file=sys.stderr,
        )
        return BAD_INPUT
    except BrokenPipeError:
        # The reader of our output has left; there is nobody to tell.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except KeyboardInterrupt:
        print(f"{parser.prog}: interrupted", file=sys.stderr)
        return 130


def check_targets(parsed: argparse.Namespace) -> None:
    """Refuse outputs that can't be written before anything is worked out or written.

    Raises:
        BadInput: A file option has no folder, is a folder or is empty; ``--out`` is a file.
    """
    for option in ("json", "html", "markdown"):
        target = getattr(parsed, option, None)
        if target is None or target == "-":
            continue
        path = Path(target)
        if not target or _kind(target, option) == "folder":
            raise BadInput(
                f"can't write it: {target!r} isn't the name of a file", where=f"--{option}"
            )
        if not path.parent.is_dir():
            raise BadInput(f"can't write it: no folder {path.parent}", where=str(path))
    out = getattr(parsed, "out", None)
    if out is not None and (not out or _kind(out, "out") == "file"):
        raise BadInput(f"can't make the folder: {out!r} isn't a folder", where="--out")


def _kind(name: str, option: str) -> str:
    """What stands at a path: ``"folder"``, ``"file"`` or nothing.

    Raises:
        BadInput: No path can have this name, or it can't be looked at.
    """
    try:
        mode = os.stat(name).st_mode
    except (FileNotFoundError, NotADirectoryError):
        return ""
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadInput(
            f"can't write {shown(name)}: {reason}", where=f"--{option}", allowed="a path"
        ) from None
    return "folder" if stat.S_ISDIR(mode) else "file"


def number(name: str, *, positive: bool = False) -> Callable[[str], float]:
    """An argparse type: a finite number, optionally positive."""

    def read(text: str) -> float:
        allowed = "a positive number" if positive else "a finite number"
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if value != value or abs(value) == float("inf") or (positive and value <= 0):
            raise argparse.ArgumentTypeError(f"{name} is {text!r}; allowed: {allowed}")
        return value

    return read


def count(name: str, least: int, most: int = MOST) -> Callable[[str], int]:
    """An argparse type: a whole number from ``least`` to ``most``."""

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            value = least - 1
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(
                f"{name} is {shown(text)}; allowed: a whole number of at least {least}"
                + (f", at most {most}" if value > most else "")
            )
        return value

    return read


def run_view(scene: Scene, arguments: argparse.Namespace) -> None:
    """Write a scene to the file, or serve it, as the options of a ``view`` verb ask."""
    from thesis_pin.pages import player, serving

    if arguments.html:
        player.write_html(scene, arguments.html, speed=arguments.speed)
        print(f"wrote {arguments.html}", file=sys.stderr)
        return
    serving.show(
        scene,
        speed=arguments.speed,
        port=arguments.port,
        browser=not arguments.no_browser,
        hold=arguments.hold,
        say=lambda text: print(text, file=sys.stderr, flush=True),
    )
