"""Outputs a command line asks for, looked at before anything is worked out."""

from __future__ import annotations

import argparse
import contextlib
from collections.abc import Iterator

from thesis_pin.command.messages import say
from thesis_pin.errors import BadInput
from thesis_pin.files import Claim, check_file, is_standard_output

FILES = ("json", "html", "markdown")
"""Options that name a file; ``-`` is standard output."""


@contextlib.contextmanager
def targets(parsed: argparse.Namespace) -> Iterator[None]:
    """Refuse outputs that can't be written before anything is worked out or written.

    While this lasts, no other run writes to ``--out``.

    Args:
        parsed: The parsed arguments; ``out`` becomes a claim on its folder.

    Raises:
        BadInput: Two outputs want standard output.
        CannotWrite: An output can't be written.
        Busy: Another run is at work for the folder.
    """
    taken = [f"--{option}" for option in FILES if is_standard_output(_value(parsed, option))]
    if len(taken) > 1:
        raise BadInput(
            f"{' and '.join(taken)} can't both be standard output",
            remedy="Write one of them to a file",
        )
    for option in FILES:
        if (target := _value(parsed, option)) is not None:
            check_file(target)
    out = _value(parsed, "out")
    if out is None:
        yield
        return
    with Claim(out) as claim:
        if claim.mixture:
            say(
                f"{out} holds a mixture: a run was killed while it wrote {claim.mixture[0]}"
                + (f" and {len(claim.mixture) - 1} more files" if claim.mixture[1:] else "")
            )
        parsed.out = claim
        yield


def free(parsed: argparse.Namespace) -> bool:
    """Whether standard output is still free for text."""
    return not any(is_standard_output(_value(parsed, option)) for option in FILES)


def _value(parsed: argparse.Namespace, option: str) -> str | None:
    value: str | None = getattr(parsed, option, None)
    return value
