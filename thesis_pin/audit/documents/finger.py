"""A slip in words that a reader can put a finger on: between what it stands, and what belongs."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from thesis_pin.audit.comparison.differences import pieces
from thesis_pin.audit.languages.phrases import Phrases
from thesis_pin.audit.rows import Row
from thesis_pin.audit.slips import Slip

_WHOLE = 160
"""Characters above which a statement isn't repeated beside its correction."""
_SHOWN = 90
"""Characters of a formula that are shown of a slip; of a longer one its ends."""
_ENGLISH = Phrases()


def code(formula: str) -> str:
    """A piece of a formula as code, as terminals and Markdown show it."""
    return f"`{formula}`"


def slip_text(
    row: Row, slip: Slip, say: Phrases = _ENGLISH, quote: Callable[[str], str] = code
) -> str:
    """A slip in a sentence.

    Args:
        row: The line it stands in.
        slip: The slip.
        say: The language.
        quote: What makes a piece of a formula readable.
    """

    def shown(formula: str) -> str:
        if len(formula) > _SHOWN:
            formula = f"{formula[: 2 * _SHOWN // 3]} … {formula[-_SHOWN // 3 :]}"
        return quote(formula)

    where = ", ".join(_where(row, slip, say))
    if _is_second(row, slip):
        where = ", ".join(part for part in (say("once that is mended"), where) if part)
    if is_whole(slip):
        return f"{where}: {say('the whole statement')}" if where else say("the whole statement")
    before, after = (shown(text) if text else "" for text in slip.neighbours)
    if before and after:
        beside = say("between {a} and {b}", a=before, b=after)
    elif before or after:
        beside = say("after {a}", a=before) if before else say("before {b}", b=after)
    else:
        beside = ""
    old, new = (shown(text) if text else "" for text in (slip.printed, slip.corrected))
    if old and new:
        change = say("{old} should be {new}", old=old, new=new)
    else:
        change = (
            say("{new} is missing", new=new) if new else say("{old} should not be there", old=old)
        )
    said = f"{beside}, {change}" if beside else change
    return f"{where}: {said}" if where else said


def _is_second(row: Row, slip: Slip) -> bool:
    """Whether a slip is one of a statement whose text has slips of its own, told before it."""
    first = next((one for one in row.slips if one.member == slip.member), slip)
    return slip.kind in _ANOTHER and first.kind not in _ANOTHER


_ANOTHER = ("statement", "frame")
"""Kinds of slips of a statement, rather than of its text."""


def is_whole(slip: Slip) -> bool:
    """Whether a slip is a whole statement, too long to be repeated in its sentence."""
    return not any(slip.neighbours) and len(slip.printed + slip.corrected) > _WHOLE


def spans(row: Row, member: int) -> list[tuple[int, int]]:
    """From where to where the slips of a member stand in its print, one behind the other.

    Args:
        row: The line.
        member: Number of the member; 0 is the left side.

    Returns:
        Places in its text, each cell of a matrix by itself; the same twice where something is
        missing. Slips of another text, of what a statement was read as, are left out.
    """
    text = (row.left, *row.printed)[member]
    listed, last = pieces(text), 0
    found: list[tuple[int, int]] = []
    for slip in row.slips:
        if slip.member != member or slip.start > len(listed) + 1:
            continue
        start = listed[slip.start - 1].start if slip.start <= len(listed) else len(text.rstrip())
        words = re.compile(r"\s*".join(map(re.escape, slip.printed.split())))
        match = words.match(text, start)
        if sized := _SIZED.search(text, 0, start):
            start = sized.start()
        if match and start >= last:
            found += _cells(text, start, match.end()) if match[0] else [(start, start)]
            last = match.end()
    return found


_SIZED = re.compile(r"\\(?:left|right|[bB]igg?[lr]?)\s*\Z")
"""What says how tall the bracket behind it is."""


def _cells(text: str, start: int, end: int) -> Iterator[tuple[int, int]]:
    """What stands in each cell of a part of a formula."""
    for cell in re.split(r"(\\\\|&)", text[start:end]):
        inside = cell.strip()
        if inside and inside not in ("&", r"\\"):
            begin = start + cell.index(inside)
            yield begin, begin + len(inside)
        start += len(cell)


def _where(row: Row, slip: Slip, say: Phrases) -> Iterator[str]:
    """Side or member, term, and cell of a slip, as far as there are several."""
    if slip.member == 0:
        yield say("left side")
    elif len(row.printed) > 1 or slip.member > len(row.printed):
        yield say("member {n}", n=slip.member)
    if slip.term:
        yield say(slip.term)
    cell = _cell(row, slip)
    if cell:
        rows, column = cell
        row_only = say("row {m}, column {n}", m=rows, n=column)
        yield row_only if rows else say("column {n}", n=column)


def _cell(row: Row, slip: Slip) -> tuple[int, int] | None:
    """Row, 0 if there is one alone, and column of a slip in a matrix."""
    if slip.member > len(row.printed) or is_whole(slip):
        return None
    text = row.printed[slip.member - 1] if slip.member else row.left
    listed = pieces(text)
    keys = [piece.key for piece in listed]
    if slip.kind in _ANOTHER and ("&" not in keys or "&" in slip.printed + slip.corrected):
        return None
    place = listed[slip.start - 1].start if slip.start <= len(listed) else len(text)
    start, end = _matrix(text, place)
    if slip.kind not in ("column", *_ANOTHER) and (start, end) == (0, len(text)):
        return None  # columns of a row without its matrix are told by their kind alone
    inside = [k for k, piece in enumerate(listed) if start <= piece.start < end]
    before = [keys[k] for k in inside if k < slip.start - 1]
    lines = before.count("\\\\")
    this = before[len(before) - before[::-1].index("\\\\") :] if lines else before
    column = this.count("&") + 1 + (slip.printed or slip.corrected).startswith("&")
    return (lines + 1 if "\\\\" in (keys[k] for k in inside) else 0), column


_ENVIRONMENT = re.compile(r"\\(begin|end)(?![a-zA-Z])")


def _matrix(text: str, place: int) -> tuple[int, int]:
    """From where to where the innermost matrix around a place goes; all of the text if none."""
    opened = [0]
    for one in _ENVIRONMENT.finditer(text):
        if one[1] == "begin":
            opened.append(one.start())
        elif len(opened) > 1:
            start = opened.pop()
            if start <= place < one.start():
                return start, one.start()
    return 0, len(text)
