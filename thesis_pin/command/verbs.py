"""What the verbs of both commands do alike: write reports and documents, print a URDF."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from thesis_pin.command.parser import OK
from thesis_pin.files import write_file, write_folder

if TYPE_CHECKING:
    import numpy as np


class Report(Protocol):
    """A report that can be written as JSON and as a table of samples."""

    def document(self) -> dict[str, Any]:
        """The whole report, JSON-ready."""

    def columns(self) -> Mapping[str, np.ndarray | Sequence[str]]:
        """Its samples: column name → values."""


def show(
    arguments: argparse.Namespace, document: Callable[[], Any], tell: Callable[[], None]
) -> int:
    """Write a document where ``--json`` says; print it unless that is standard output.

    Args:
        arguments: With ``json``.
        document: Makes the JSON-ready document.
        tell: Prints the same for people.
    """
    if arguments.json:
        from thesis_pin.report.writers import json_bytes

        write_file(arguments.json, json_bytes(document()))
    if arguments.json != "-":
        tell()
    return OK


def write_report(
    arguments: argparse.Namespace,
    report: Report,
    *,
    figures: Callable[[], Mapping[str, bytes]],
    page: Callable[[], bytes],
) -> bool:
    """Write a report where ``--out``, ``--json`` and ``--html`` say.

    Every content exists before the first file is written.

    Args:
        arguments: With ``out``, ``json`` and ``html``.
        report: The report.
        figures: Draws its figures: file name → content.
        page: Makes its page.

    Returns:
        Whether standard output is still free for the table.
    """
    document, files, html = b"", {}, b""
    if arguments.json or arguments.out:
        from thesis_pin.report.writers import csv_bytes, json_bytes

        document = json_bytes(report.document())
        if arguments.out:
            files = {"report.json": document, "samples.csv": csv_bytes(report.columns())}
            files |= figures()
    if arguments.html:
        html = page()
    if arguments.out:
        write_folder(arguments.out, files)
        print(f"wrote {arguments.out}", file=sys.stderr)
    if arguments.json:
        write_file(arguments.json, document)
    if arguments.html:
        write_file(arguments.html, html)
    return "-" not in (arguments.json, arguments.html)


def urdf(
    arguments: argparse.Namespace, name: str, text: str, files: Callable[[], Mapping[str, str]]
) -> int:
    """Print a URDF, or write every generated file into ``--out``.

    Args:
        arguments: With ``out``.
        name: The robot's name, for messages.
        text: Its URDF.
        files: Everything generated from its specification: file name → text.
    """
    from thesis_pin.model.loading import check_urdf

    check_urdf(text, where=name)
    if not arguments.out:
        write_file("-", text.encode())
        return OK
    contents = {file: content.encode() for file, content in files().items()}
    write_folder(arguments.out, contents)
    print(f"wrote {', '.join(contents)} to {arguments.out}", file=sys.stderr)
    return OK
