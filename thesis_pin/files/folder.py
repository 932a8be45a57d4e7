"""Folders of results: exchanged in one step where the system can.

All files are made in ``.NAME.partial`` beside the folder, which also holds the
lock that keeps a second run out. Where everything else in the folder can be
carried over, the new folder takes the old one's place in one step. Elsewhere
(another file system, a folder of folders, the one we stand in) the files are
renamed into it one by one. :data:`MANIFEST` is written before the first and
after the last of them, so that what a killed run leaves is known to be a mixture:
``sha256sum -c manifest.sha256`` and the next run say so.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import itertools
import os
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType

from thesis_pin.errors import Busy
from thesis_pin.files.exchange import CannotCarry, carry, exchangeable, swap
from thesis_pin.files.manifest import MANIFEST, manifest, stale_files, unlike_manifest
from thesis_pin.files.single import cannot_write, partial_path, still_at, take_after, write_file

_claimed: set[Path] = set()
"""Places this process has claimed: its locks don't keep out its own threads."""


def write_folder(folder: str | Path | Claim, files: Mapping[str, bytes]) -> None:
    """Write several files into a folder, which is made if need be.

    What an earlier run wrote there and this one doesn't is removed unless it was
    changed since; files of others stay.

    Args:
        folder: Where to; or one that was claimed before the work.
        files: File name, ``/`` between folders → content.

    Raises:
        Busy: Another process is at work for this folder.
        CannotWrite: The folder can't be made or written to.
    """
    if isinstance(folder, Claim):
        folder.write(files)
        return
    with Claim(folder) as claim:
        claim.write(files)


class Claim:
    """A folder that this process alone writes to, from before its work until it is done.

    Args:
        folder: The folder; it need not exist. Links are followed.
        keep: Files that may not be replaced by others, such as those that are read.

    Attributes:
        mixture: Files that an earlier run, killed while it wrote, left unlike
            :data:`MANIFEST`.

    Raises:
        Busy: Another process has claimed it.
        CannotWrite: It can't be made or written to.
    """

    def __init__(self, folder: str | Path, keep: Sequence[str | Path] = ()) -> None:
        self._name = str(folder)
        self._keep = [os.stat(one) for one in keep]
        with contextlib.ExitStack() as undo, cannot_write(folder):
            if not self._name:
                raise OSError(errno.EINVAL, "'' isn't the name of a folder")
            self.path = Path(os.path.realpath(folder))
            if self.path.exists() and not self.path.is_dir():
                raise OSError(errno.ENOTDIR, f"{self._name!r} isn't a folder")
            undo.callback(_remove_empty, _make(self.path.parent))
            if self.path.exists() and not os.access(self.path, os.W_OK | os.X_OK):
                raise OSError(errno.EACCES, os.strerror(errno.EACCES))
            self._partial = partial_path(self.path)
            if self.path.exists() and not _beside(self.path):
                self._partial = self.path / self._partial.name
            self._lock, left = _claim(self._partial, self._name)
            undo.callback(self._release)
            self.mixture = unlike_manifest(self.path) if left else ()
            self._undo = undo.pop_all()

    def __str__(self) -> str:
        return self._name

    def __fspath__(self) -> str:
        return self._name

    def __enter__(self) -> Claim:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._undo.close()

    def _release(self) -> None:
        # The lock goes last: whoever gets it finds an empty place.
        shutil.rmtree(self._partial / "new", ignore_errors=True)
        shutil.rmtree(self._partial, ignore_errors=True)
        os.close(self._lock)
        _claimed.discard(self._partial)

    def add(self, name: str, content: bytes) -> None:
        """Write one file into the folder at once; it stays there whatever becomes of the rest.

        Args:
            name: Its name, ``/`` between folders.
            content: What is to stand in it.

        Raises:
            CannotWrite: It can't be written.
        """
        target = self.path / name
        with cannot_write(self._name):
            target.parent.mkdir(parents=True, exist_ok=True)
        write_file(target, content)

    def write(self, files: Mapping[str, bytes]) -> None:
        """Write the files; see :func:`write_folder`."""
        import hashlib  # 2 ms that no run without a folder needs

        sums = {name: hashlib.sha256(content).hexdigest() for name, content in files.items()}
        contents = {**files, MANIFEST: manifest(sums)}
        new = self._partial / "new"
        with cannot_write(self._name):
            for target in (self.path / name for name in contents):
                if target.is_dir():
                    raise OSError(errno.EISDIR, f"there is a folder {target.name!r} in it")
                if target.exists() and not os.access(target, os.W_OK):
                    raise OSError(errno.EACCES, f"{target.name} is read-only")
                self._check_kept(target, contents)
            new.mkdir()
            for name, content in contents.items():
                (new / name).parent.mkdir(parents=True, exist_ok=True)
                (new / name).write_bytes(content)
                if (self.path / name).is_file():
                    take_after(new / name, self.path / name)
            stale = stale_files(self.path, sums)
            if not self._exchange(new, {*contents, *stale}):
                self._move(new, contents, sums, stale)

    def _check_kept(self, target: Path, contents: Mapping[str, bytes]) -> None:
        """Refuse to put something else in the place of a file that is to be kept."""
        if not target.exists():
            return
        there = os.stat(target)
        content = contents[str(target.relative_to(self.path))]
        if any(os.path.samestat(there, one) for one in self._keep) and (
            target.read_bytes() != content
        ):
            raise OSError(errno.EEXIST, f"this command reads {target.name}; name another folder")

    def _exchange(self, new: Path, ours: set[str]) -> bool:
        """Put the new folder in the old one's place; whether that could be done."""
        if not self.path.exists():
            os.rename(new, self.path)
            return True
        if not exchangeable(self.path):
            return False
        try:
            carry(self.path, new, ours)
            take_after(new, self.path)
            if not swap(new, self.path):
                return False
        except CannotCarry:
            return False
        with contextlib.suppress(CannotCarry, OSError):
            carry(new, self.path, ours)  # what others wrote in the meantime
        return True

    def _move(
        self, new: Path, contents: Mapping[str, bytes], sums: dict[str, str], stale: dict[str, str]
    ) -> None:
        """Put the files in place one by one, between two manifests."""
        first = new / f"{MANIFEST}.first"
        first.write_bytes(manifest({**stale, **sums}))
        os.replace(first, self.path / MANIFEST)
        for name in stale:
            (self.path / name).unlink(missing_ok=True)
        for name, content in contents.items():
            target = self.path / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if target.is_symlink() or (target.exists() and not target.is_file()):
                write_file(target, content)  # a link or a pipe stays what it is
            else:
                os.replace(new / name, target)


def _make(folder: Path) -> list[Path]:
    """Make a folder and those above it; returns those that didn't exist, innermost first."""
    above = (folder, *folder.parents)
    missing = list(itertools.takewhile(lambda place: not place.exists(), above))
    if not above[len(missing)].is_dir():
        raise OSError(errno.ENOTDIR, f"{above[len(missing)]} isn't a folder")
    folder.mkdir(parents=True, exist_ok=True)
    return missing


def _remove_empty(folders: list[Path]) -> None:
    with contextlib.suppress(OSError):
        for folder in folders:
            folder.rmdir()


def _beside(folder: Path) -> bool:
    """Whether what stands beside a folder can be renamed to it."""
    parent = folder.parent
    return not os.path.ismount(folder) and os.access(parent, os.W_OK | os.X_OK)


def _claim(partial: Path, name: str) -> tuple[int, bool]:
    """Lock a place for what is unfinished, emptied of what a killed run left.

    The lock belongs to the process alone, not to the workers it forks: they may
    outlive it.

    Returns:
        The lock's descriptor, and whether there was something left.
    """
    busy = Busy(
        "another run is writing to this folder",
        where=name,
        remedy="Wait until it is done, or name another folder",
    )
    if partial in _claimed:
        raise busy
    while True:
        try:
            partial.mkdir(mode=0o700)  # nobody reads what has no mode of its own yet
            left = False
        except FileExistsError:
            left = True
        try:
            lock = os.open(partial / "lock", os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC)
        except FileNotFoundError:
            continue  # its owner is done with it
        try:
            fcntl.lockf(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno in (errno.EACCES, errno.EAGAIN):
                os.close(lock)
                raise busy from None
            # A file system without locks: nothing to hold on to.
        if still_at(lock, partial / "lock"):
            break
        os.close(lock)
    if (partial / "new").exists():
        shutil.rmtree(partial / "new")
    _claimed.add(partial)
    return lock, left
