"""Text for any terminal: nothing it would obey, and only letters that its encoding has."""

from __future__ import annotations

import codecs
import contextlib
import io
import os
import re
import sys
import unicodedata

from thesis_pin.errors import escaped

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
    visible = escaped(line[: LONGEST + 1], LONGEST + 1, keep="")
    if len(visible) <= LONGEST and len(line) <= LONGEST:
        return visible
    return f"{visible[:LONGEST]}... ({len(line)} characters)"


def say(text: str) -> None:
    """Tell the user on standard error, if somebody listens there."""
    with contextlib.suppress(OSError):
        print(clean(text), file=sys.stderr, flush=True)


_STAND_INS = {
    "·": "*",
    "×": "x",
    "−": "-",
    "–": "-",
    "—": "-",
    "…": "...",
    "→": "->",
    "∂": "d",
    "°": "deg",
    "±": "+-",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "≈": "~",
    "√": "sqrt",
    "∫": "integral ",
    "∥": "||",
    "½": "1/2",
    "’": "'",
    "‘": "'",
    "“": '"',
    "”": '"',
    "\N{COMBINING DOT ABOVE}": "_dot",
    "\N{COMBINING DIAERESIS}": "_ddot",
    "˙": "_dot",
    "ᵀ": "^T",
}
"""What is read for a sign that an encoding doesn't have; letters follow from their names."""


def readable(text: str, encoding: str) -> str:
    """The same text in characters that an encoding has.

    Args:
        text: Any text; bytes of a file's name that are no text may be in it as
            surrogates, as Python reads them.
        encoding: Name of the encoding, as in ``sys.stdout.encoding``.

    Returns:
        The text, with stand-ins in ASCII for what the encoding doesn't have.
    """
    return text if _has(text, encoding) else _replaced(text, encoding)


def prepare_streams() -> None:
    """Let nothing that is printed fail for its letters, whoever prints it.

    Also fills the places of closed streams: the next file to be opened would
    take standard output's number, and ``print`` standard output for standard error.
    """
    while (free := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(free)
    if sys.stderr is None:
        sys.stderr = io.StringIO()
    codecs.register_error("readable", _mend)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # With python -u argparse would swallow that its help can't be written.
            stream.reconfigure(errors="readable", write_through=False)


def _mend(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    text = error.object[error.start : error.end]
    return _replaced(text, error.encoding), error.end


def _replaced(text: str, encoding: str) -> str:
    def raised(match: re.Match[str]) -> str:
        if _has(match[0], encoding):
            return match[0]
        return "^" + unicodedata.normalize("NFKC", match[0]).replace("−", "-")

    said = re.sub("[⁻⁰¹²³⁴-⁹]+", raised, text)  # an exponent is raised by one sign
    return "".join(letter if _has(letter, encoding) else _stand_in(letter) for letter in said)


def _has(text: str, encoding: str) -> bool:
    try:
        text.encode(encoding)
    except (UnicodeEncodeError, LookupError):
        return False
    return True


def _stand_in(letter: str) -> str:
    if letter in _STAND_INS:
        return _STAND_INS[letter]
    words = unicodedata.name(letter, "").split()
    if words[:1] == ["GREEK"] and "LETTER" in words:
        name = words[words.index("LETTER") + 1].lower().replace("lamda", "lambda")
        return name.capitalize() if "CAPITAL" in words else name
    if words[:2] == ["BOX", "DRAWINGS"]:
        return "-"
    base, *marks = tuple(unicodedata.normalize("NFKD", letter))
    if base != letter:  # a letter with its accents, or of another shape
        if base in "AIOUaiou":  # an umlaut is no second derivative
            marks = [mark for mark in marks if mark != "\N{COMBINING DIAERESIS}"]
        return "".join(part if part.isascii() else _stand_in(part) for part in (base, *marks))
    if unicodedata.combining(letter):
        return ""
    if "\udc80" <= letter <= "\udcff":  # a byte of a file's name that is no text
        return f"\\x{ord(letter) - 0xDC00:02x}"
    return letter.encode("ascii", "backslashreplace").decode()
