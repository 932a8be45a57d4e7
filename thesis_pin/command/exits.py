"""Exit codes of the three commands; docs/conventions.md has the table."""

from __future__ import annotations

from enum import IntEnum


class ExitCode(IntEnum):
    """How a command ends. A closed pipe ends quietly with ``DONE``."""

    DONE = 0
    """Also when a limit is violated, unless ``--strict`` asks."""
    NO = 1
    """Done, and the answer is no; the reason is on standard output and in the JSON."""
    BAD_INPUT = 2
    """What was given can't be used."""
    CANNOT_WRITE = 3
    """An output couldn't be written."""
    BUG = 70
    """A mistake of ours."""
    INTERRUPTED = 130
    """By Ctrl-C; nothing is half-written."""
