"""The one place that writes: files whole or not at all."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from thesis_pin.errors import BadInput


def write_file(target: str | Path, content: bytes) -> None:
    """Write one file whole or not at all; ``-`` is standard output.

    Raises:
        BadInput: The file can't be written.
    """
    if str(target) == "-":
        sys.stdout.buffer.write(content)
        sys.stdout.buffer.flush()
        return
    path = Path(target)
    try:
        with tempfile.NamedTemporaryFile(
            dir=path.parent, prefix=f".{path.name}.", delete=False
        ) as stream:
            stream.write(content)
        os.chmod(stream.name, 0o644)
        os.replace(stream.name, path)
    except (OSError, ValueError) as error:
        if "stream" in locals():
            Path(stream.name).unlink(missing_ok=True)
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise BadInput(f"can't write it: {reason}", where=str(path)) from None


def write_folder(folder: str | Path, files: Mapping[str, bytes]) -> None:
    """Write several files into a folder, which is made if need be.

    Every content exists before the first byte is written.

    Raises:
        BadInput: The folder can't be made or written to.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in files:
            if (folder / name).is_dir():
                raise BadInput("can't write it: there is a folder", where=str(folder / name))
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"can't make the folder: {error.strerror}", where=str(folder)) from None
    for name, content in files.items():
        write_file(folder / name, content)


def write_files(files: Mapping[str, str], folder: str | Path) -> list[Path]:
    """Write generated files below a folder, with the same line ends everywhere.

    Args:
        files: File name → text.
        folder: Where to; folders are made if need be.

    Returns:
        The files' paths.
    """
    written = []
    for name, text in files.items():
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
        written.append(path)
    return written
