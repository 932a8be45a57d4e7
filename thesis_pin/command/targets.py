"""Outputs a command line asks for, looked at before anything is worked out."""

from __future__ import annotations

import argparse
import os
import stat
from pathlib import Path

from thesis_pin.errors import BadInput, CannotWrite
from thesis_pin.numeric.checks import shown

FILES = ("json", "html", "markdown")
"""Options that name a file; ``-`` is standard output."""


def check_targets(parsed: argparse.Namespace) -> None:
    """Refuse outputs that can't be written before anything is worked out or written.

    Raises:
        BadInput: A name is no name, or two outputs want standard output.
        CannotWrite: A file option has no folder or is a folder; ``--out`` is a file.
    """
    taken = [f"--{option}" for option in FILES if getattr(parsed, option, None) == "-"]
    if len(taken) > 1:
        raise BadInput(
            f"{' and '.join(taken)} can't both be standard output",
            remedy="Write one of them to a file",
        )
    for option in FILES:
        target = getattr(parsed, option, None)
        if target is None or target == "-":
            continue
        path, kind = Path(target), _kind(target, option)
        if kind == "folder":
            raise CannotWrite(f"can't write it: {target!r} is a folder", where=f"--{option}")
        if not path.parent.is_dir():
            raise CannotWrite(f"can't write it: no folder {path.parent}", where=str(path))
    out = getattr(parsed, "out", None)
    if out is not None and _kind(out, "out") == "file":
        raise CannotWrite(f"can't make the folder: {out!r} isn't a folder", where="--out")


def _kind(name: str, option: str) -> str:
    """What stands at a path: ``"folder"``, ``"file"`` or nothing.

    Raises:
        BadInput: No path can have this name, or it can't be looked at.
    """
    if not name:
        raise BadInput("'' isn't the name of a file or folder", where=f"--{option}")
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
