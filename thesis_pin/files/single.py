"""The one place that writes: files whole or not at all.

A regular file is written beside its place as ``.NAME.partial`` and renamed, so
that whoever looks, and whenever we are killed, finds the old file or the new
one. Links are followed, modes kept, the umask obeyed. Devices, pipes and open
files such as ``/dev/stdout`` can't be replaced and are written straight into.
For folders see :mod:`thesis_pin.files.folder`.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import shutil
import stat
import sys
import time
from collections.abc import Iterator, Mapping
from pathlib import Path

from thesis_pin.errors import CannotWrite

STANDARD_OUTPUT = 1
"""Its file descriptor."""


def write_file(target: str | Path, content: bytes) -> None:
    """Write one file; ``-`` is standard output.

    A regular file is replaced in one step and is never seen half-written; two
    runs that write the same one wait for each other.

    Args:
        target: The file; links are followed.
        content: What is to stand in it.

    Raises:
        CannotWrite: The file can't be written; what stood there stays.
        BrokenPipeError: The reader of a pipe has left.
    """
    with cannot_write(target):
        descriptor = _descriptor(target)
        if descriptor is not None:
            _write_open(descriptor, content)
            return
        path = _real(target)
        if _kind(path) not in ("file", ""):
            with open(os.open(path, os.O_WRONLY | os.O_CLOEXEC), "wb") as stream:
                stream.write(content)
            return
        with _partial(path) as stream_descriptor:
            with open(stream_descriptor, "wb", closefd=False) as stream:
                stream.write(content)
            take_after(partial_path(path), path)
            os.replace(partial_path(path), path)


def check_file(target: str | Path) -> None:
    """Find out whether :func:`write_file` can write there, before there is anything to write.

    Args:
        target: As for :func:`write_file`.

    Raises:
        CannotWrite: It can't; says why.
    """
    with cannot_write(target):
        descriptor = _descriptor(target)
        if descriptor is not None:
            if fcntl.fcntl(descriptor, fcntl.F_GETFL) & os.O_ACCMODE == os.O_RDONLY:
                raise OSError(errno.EBADF, "it is open for reading only")
            return
        path = _real(target)
        if _kind(path) in ("file", ""):
            with _partial(path):
                pass
        elif not os.access(path, os.W_OK):
            raise OSError(errno.EACCES, os.strerror(errno.EACCES))


def write_files(files: Mapping[str, str], folder: str | Path) -> list[Path]:
    """Write generated files below a folder, with the same line ends everywhere.

    Args:
        files: File name → text.
        folder: Where to; folders are made if need be.

    Returns:
        The files' paths.

    Raises:
        CannotWrite: A folder can't be made or a file not be written.
    """
    written = []
    for name, text in files.items():
        path = Path(folder) / name
        with cannot_write(path.parent):
            path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, text.encode())
        written.append(path)
    return written


def is_standard_output(target: object) -> bool:
    """Whether an output goes where the terminal's text goes: ``-``, ``/dev/stdout``."""
    try:
        return isinstance(target, str | Path) and _descriptor(target) == STANDARD_OUTPUT
    except (OSError, ValueError):
        return False


def name_as_text(path: str | Path) -> str:
    """A path as text that every document can hold: bytes that are none are ``\\xff``."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")


@contextlib.contextmanager
def cannot_write(target: str | Path) -> Iterator[None]:
    """Turn the system's refusals into :class:`CannotWrite` about a target."""
    try:
        yield
    except BrokenPipeError:
        raise
    except (OSError, ValueError) as error:
        if isinstance(error, CannotWrite):
            raise
        raise CannotWrite(f"can't write it: {_reason(error)}", where=str(target)) from None


def _reason(error: OSError | ValueError) -> str:
    if isinstance(error, OSError):
        if error.errno == errno.ENAMETOOLONG:
            return "the name is too long for the file system (most take 255 bytes between slashes)"
        if error.errno == errno.ENXIO:
            return "nobody listens there"
        return error.strerror or str(error)
    return str(error)  # a zero byte in the name


def _write_open(descriptor: int, content: bytes) -> None:
    """Write into a file that is open already, behind what was printed."""
    if descriptor == STANDARD_OUTPUT:
        if sys.stdout is None:
            raise OSError(errno.EBADF, "standard output is closed")
        sys.stdout.flush()
        if hasattr(sys.stdout, "buffer"):
            rest = memoryview(content)
            while rest:  # an unbuffered stream may take a part only
                rest = rest[sys.stdout.buffer.write(rest) :]
            sys.stdout.buffer.flush()
        else:  # a notebook's
            sys.stdout.write(content.decode())
        sys.stdout.flush()
        return
    with open(descriptor, "wb", closefd=False) as stream:
        stream.write(content)


def _descriptor(target: str | Path) -> int | None:
    """The number of the open file that a target names: ``-``, ``/dev/stdout``, ``/dev/fd/3``.

    Opening such a path again fails for another user's terminal or a socket, and would
    cut off or replace the file that the output is redirected to.
    """
    if str(target) == "-":
        return STANDARD_OUTPUT
    folders = {"/dev/fd", "/proc/self/fd", os.path.realpath("/proc/self/fd")}
    path = os.path.abspath(target)
    for _ in range(40):  # as many links as Linux follows
        folder, name = os.path.split(path)
        if os.path.realpath(folder) in folders:
            return int(name) if name.isdecimal() else None
        if not os.path.islink(path):
            return None
        path = os.path.join(folder, os.readlink(path))
    return None


def _real(target: str | Path) -> Path:
    """Where a target's links lead, for a file that may not exist yet."""
    text = os.fspath(target)
    if not text or text.endswith("/"):
        raise OSError(errno.EINVAL, f"{text!r} isn't the name of a file")
    path = Path(os.path.realpath(text))
    folder = path.parent
    if not folder.is_dir():
        raise OSError(errno.ENOENT, f"there is no folder {folder}")
    return path


def _kind(path: Path) -> str:
    """What stands at a path: ``"file"``, ``"special"`` or nothing.

    Raises:
        OSError: A folder, or a file that nobody may write, stands there.
    """
    try:
        mode = os.stat(path).st_mode
    except FileNotFoundError:
        return ""
    if stat.S_ISDIR(mode):
        raise OSError(errno.EISDIR, "a folder stands there")
    if not stat.S_ISREG(mode):
        return "special"
    if not os.access(path, os.W_OK):
        raise OSError(errno.EACCES, os.strerror(errno.EACCES))
    return "file"


def partial_path(path: Path) -> Path:
    """Where what is to stand at a path is made: beside it, so that one rename is enough."""
    name = os.fsdecode(os.fsencode(path.name)[:240])
    return path.with_name(f".{name}.partial") if name else path / ".partial"


@contextlib.contextmanager
def _partial(path: Path) -> Iterator[int]:
    """The descriptor of a fresh ``.NAME.partial`` of ours; it is gone afterwards."""
    partial = partial_path(path)
    mode = stat.S_IMODE(os.stat(path).st_mode) & 0o777 if path.exists() else 0o666
    while True:
        try:
            descriptor = os.open(partial, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
        except FileExistsError:
            _clear(partial)
            continue
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        if still_at(descriptor, partial):
            break
        os.close(descriptor)  # another run took it for a dead one's before it was locked
    try:
        yield descriptor
    finally:
        if still_at(descriptor, partial):
            partial.unlink()
        os.close(descriptor)


def _clear(partial: Path) -> None:
    """Wait for the run that writes a partial file; remove it if that run is dead."""
    try:
        descriptor = os.open(partial, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC)
    except FileNotFoundError:
        return
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)  # a lock dies with the process that held it
        if still_at(descriptor, partial):
            partial.unlink()
    finally:
        os.close(descriptor)


def still_at(descriptor: int, path: Path) -> bool:
    """Whether an open file is the one at a path, and not one that was moved away or removed."""
    try:
        there = os.lstat(path)
    except OSError:
        return False
    return os.path.samestat(os.fstat(descriptor), there)


def take_after(new: Path, old: Path) -> None:
    """Give what is to replace something that exists its owner, mode and attributes."""
    try:
        before = os.stat(old)
    except FileNotFoundError:
        return
    for owner in (before.st_uid, -1):
        with contextlib.suppress(PermissionError):
            os.chown(new, owner, before.st_gid)
            break
    shutil.copystat(old, new)
    now = time.time()
    os.utime(new, (now, now))
