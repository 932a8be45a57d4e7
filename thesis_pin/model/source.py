"""Bytes and text of files, devices and pipes, never more than a reader takes."""

from __future__ import annotations

import os
import re
import select
import stat
import time
from pathlib import Path

from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import shown

_CHUNK = 2**20
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")


def read_bytes(kind: str, path: str | Path, most: int) -> bytes:
    """Content of a file, device or pipe.

    Args:
        kind: What the file is, for messages.
        path: The file.
        most: Bytes at most; no more are read, whatever the file says of its size.

    Raises:
        BadInput: It isn't a path, can't be opened, is larger, or is a pipe into which
            nobody writes.
    """
    if not isinstance(path, str | Path) or not str(path):
        raise BadInput(f"{shown(path)} isn't the name of a {kind} file", allowed="a path")
    try:
        pipe = stat.S_ISFIFO(os.stat(path).st_mode)
        content = _from_pipe(path, most) if pipe else _from_file(path, most)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadInput(f"can't read the {kind}: {reason}", where=str(path)) from None
    if content is None:
        raise BadInput(
            f"can't read the {kind}: nobody writes into this pipe",
            where=str(path),
            remedy="Start the program that writes into it first, or name a file",
        )
    if len(content) > most:
        raise BadInput(
            f"the {kind} is larger than {most / 2**20:g} MiB",
            where=str(path),
            allowed=f"at most {most / 2**20:g} MiB",
        )
    return content


def read_text(kind: str, path: str | Path, most: int = LIMITS.toml_bytes) -> str:
    """Text of a UTF-8 file, with or without a byte order mark.

    Args:
        kind: What the file is, for messages.
        path: The file.
        most: Bytes at most.

    Raises:
        BadInput: As :func:`read_bytes`, or it isn't UTF-8.
    """
    content = read_bytes(kind, path, most)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise BadInput(f"can't read the {kind}: it isn't UTF-8 text", where=str(path)) from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def read_any_text(kind: str, path: str | Path, most: int) -> tuple[str, str]:
    """Text of a file in UTF-8 or in what spreadsheets write instead of it.

    Args:
        kind: What the file is, for messages.
        path: The file.
        most: Bytes at most.

    Returns:
        The text, and the encoding if it isn't UTF-8: ``"UTF-16"`` or ``"Windows-1252"``.

    Raises:
        BadInput: As :func:`read_bytes`, or it is none of them.
    """
    content = read_bytes(kind, path, most)
    found = _decoded(content)
    if found is None:
        sheet = content.startswith((b"PK\x03\x04", b"\xd0\xcf\x11\xe0"))
        raise BadInput(
            f"can't read the {kind}: it isn't text in UTF-8, UTF-16 or Windows-1252",
            where=str(path),
            remedy="Save the sheet as CSV" if sheet else "",
        )
    text, encoding = found
    return text.replace("\r\n", "\n").replace("\r", "\n"), encoding


def _decoded(content: bytes) -> tuple[str, str] | None:
    """Text and encoding of bytes; None if they aren't text."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        tries = [("utf-16", "UTF-16")]
    elif b"\0" in content[:2]:  # the first character is one that a header begins with
        tries = [("utf-16-be" if content[:1] == b"\0" else "utf-16-le", "UTF-16")]
    else:
        tries = [("utf-8-sig", ""), ("cp1252", "Windows-1252")]
    for codec, name in tries:
        try:
            text = content.decode(codec)
        except UnicodeDecodeError:
            continue
        if _CONTROL.search(text) if name else "\0" in text:
            return None
        return text, name
    return None


def _from_file(path: str | Path, most: int) -> bytes:
    with open(path, "rb", buffering=0) as stream:
        content = bytearray()
        while len(content) <= most and (chunk := stream.read(min(_CHUNK, most + 1))):
            content += chunk
    return bytes(content)


def _from_pipe(path: str | Path, most: int) -> bytes | None:
    """Content of a pipe; None if nobody has it open for writing."""
    # Opening a pipe waits for a writer, perhaps for ever; opened so, it doesn't.
    stream, content = os.open(path, os.O_RDONLY | os.O_NONBLOCK), bytearray()
    until = time.monotonic() + LIMITS.patience
    try:
        while len(content) <= most:
            try:
                chunk = os.read(stream, _CHUNK)
            except BlockingIOError:  # somebody will write, but hasn't yet
                select.select([stream], [], [], 1.0)
                continue
            content += chunk
            if not chunk and content:
                return bytes(content)
            if not chunk:
                if time.monotonic() > until:
                    return None
                time.sleep(0.02)
    finally:
        os.close(stream)
    return bytes(content)
