"""Messages on standard error: whatever a file or a flag holds, a terminal only shows it."""

from __future__ import annotations

import contextlib
import sys

LONGEST = 1000
"""Characters of a line, beyond which a message is cut."""
MOST_LINES = 200
"""Lines of a message, beyond which it is cut."""


def clean(text: str) -> str:
    """Text that a terminal can be given: no control characters, bounded in length.

    Args:
        text: Any text; line breaks are kept.

    Returns:
        The same with everything that can't be printed written as an escape
        (``\\x1b``), lines of at most :data:`LONGEST` characters and at most
        :data:`MOST_LINES` of them, with what is missing counted.
    """
    lines = text[: 2 * LONGEST * MOST_LINES].split("\n")
    shown = [_line(line) for line in lines[:MOST_LINES]]
    if len(lines) > MOST_LINES:
        shown.append(f"... {text.count(chr(10)) + 1 - MOST_LINES} more lines")
    return "\n".join(shown)


def _line(line: str) -> str:
    visible = "".join(
        letter if letter.isprintable() else letter.encode("unicode_escape").decode("ascii")
        for letter in line[: LONGEST + 1]
    )
    if len(visible) <= LONGEST and len(line) <= LONGEST:
        return visible
    return f"{visible[:LONGEST]}... ({len(line)} characters)"


def say(text: str) -> None:
    """Tell the user on standard error, if somebody listens there."""
    with contextlib.suppress(OSError):
        print(clean(text), file=sys.stderr, flush=True)
