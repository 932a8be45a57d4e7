"""One folder takes another's place in one step, with what others put there."""

from __future__ import annotations

import ctypes
import os
import stat
from collections.abc import Iterator
from pathlib import Path

_MOST_OTHERS = 1000
"""Files of others in a folder, beyond which it isn't exchanged."""


def exchangeable(folder: Path) -> bool:
    """Whether nobody minds that a folder becomes another one of the same name."""
    try:
        stands_in_it = Path.cwd().is_relative_to(folder)
    except FileNotFoundError:
        stands_in_it = False
    owner = os.stat(folder).st_uid
    return not (stands_in_it or os.path.ismount(folder)) and os.geteuid() in (0, owner)


class CannotCarry(Exception):
    """A folder holds what can't be carried over to its successor."""


def _others(folder: Path, ours: set[str]) -> Iterator[str]:
    """Names of files that aren't ours, also in folders of ours.

    Raises:
        CannotCarry: There is a folder that isn't ours, or something of ours is a link or a pipe.
    """
    parents = {str(above) for name in ours for above in Path(name).parents}
    for place in sorted(parents):
        if not (folder / place).is_dir():
            continue
        with os.scandir(folder / place) as entries:
            found = list(entries)
        for entry in found:
            name = os.path.normpath(os.path.join(place, entry.name))
            if name in ours:
                if not stat.S_ISREG(entry.stat(follow_symlinks=False).st_mode):
                    raise CannotCarry
            elif entry.is_dir(follow_symlinks=False) != (name in parents):
                raise CannotCarry
            elif name not in parents:
                yield name


def carry(old: Path, new: Path, ours: set[str]) -> None:
    """Let what others put into a folder stand in its successor too, under the same inode."""
    for count, name in enumerate(_others(old, ours)):
        if count >= _MOST_OTHERS:
            raise CannotCarry
        try:
            (new / name).parent.mkdir(parents=True, exist_ok=True)
            os.link(old / name, new / name, follow_symlinks=False)
        except FileExistsError:
            continue
        except OSError:
            raise CannotCarry from None


def swap(one: Path, other: Path) -> bool:
    """Exchange two folders in one step; whether the system can."""
    try:
        exchange = ctypes.CDLL(None, use_errno=True).renameat2
    except (AttributeError, OSError):
        return False
    here, flag = -100, 2  # AT_FDCWD, RENAME_EXCHANGE
    return bool(exchange(here, os.fsencode(one), here, os.fsencode(other), flag) == 0)
