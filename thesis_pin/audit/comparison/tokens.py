"""A printed formula cut into tokens, and its sums into terms; any text can be cut."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

_TOKEN = re.compile(
    r"(?P<script>[_^]\s*(?:\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}|\\[a-zA-Z]+|\w))"
    r"|(?P<word>\\(?:text|operatorname|mathrm)\s*\{[^{}]*\})"
    r"|(?P<environment>\\(?:begin|end)\s*\{\w+\}(?:\{[clr| ]*\})?)"
    r"|(?P<command>\\[a-zA-Z]+)"
    r"|(?P<divider>\\\\|&|[;,=])"
    r"|(?P<layout>\\[^a-zA-Z]|\s+)"
    r"|(?P<number>\d+(?:\.\d*)?|\.\d+)"
    r"|(?P<sign>[+-])"
    r"|(?P<open>[(\[{])|(?P<close>[)\]}])"
    r"|(?P<letter>\w)|(?P<other>.)",
    re.DOTALL,
)
_FONTS = frozenset({r"\mathbf", r"\boldsymbol", r"\mathbb", r"\mathcal", r"\bm"})
_ACCENTS = frozenset({r"\dot", r"\ddot"})
_LAYOUT = frozenset(
    {
        r"\left",
        r"\right",
        r"\big",
        r"\Big",
        r"\bigg",
        r"\Bigg",
        r"\bigl",
        r"\bigr",
        r"\Bigl",
        r"\Bigr",
        r"\dots",
        r"\cdots",
        r"\ldots",
    }
)
_DIVIDERS = frozenset({r"\quad", r"\qquad"})


@dataclass(frozen=True)
class Token:
    """A piece of a formula.

    Attributes:
        kind: "script", "command", "number", "sign", "letter", "font", "accent", …
        text: As it stands there.
        start, end: Where.
    """

    kind: str
    text: str
    start: int
    end: int


@dataclass
class Term:
    """A term of a sum: from its sign, if it has one, to its end.

    Attributes:
        start, end: Where it stands, its sign included.
        body: Where it begins without its sign.
    """

    start: int
    body: int
    end: int


@dataclass
class _Group:
    opaque: bool
    starts: list[tuple[int, int]] = field(default_factory=list)
    content: int = 0


def tokens(text: str) -> list[Token]:
    """The pieces of a formula, all of its characters in one of them."""
    return [
        Token(_kind(match), match[0], match.start(), match.end()) for match in _TOKEN.finditer(text)
    ]


def _kind(match: re.Match[str]) -> str:
    kind, text = str(match.lastgroup), match[0]
    if kind == "command":
        if text in _FONTS:
            return "font"
        if text in _ACCENTS:
            return "accent"
        if text in _LAYOUT:
            return "layout"
        if text in _DIVIDERS:
            return "divider"
        if text in (r"\pm", r"\mp"):
            return "both"
    return kind


def sums(pieces: list[Token]) -> Iterator[list[Term]]:
    """The terms of every sum: of the whole, of brackets, fractions and cells.

    What stands below a dot, in a bold letter or in a derivative's fraction isn't a sum.
    """
    groups, before = [_Group(opaque=False)], ""
    for k, token in enumerate(pieces):
        group = groups[-1]
        match token.kind:
            case "layout":
                continue
            case "open":
                _begin(group, token.start)
                following = next((t.text for t in pieces[k + 1 :] if t.kind != "layout"), "")
                lettered = before in ("font", "accent")
                derived = following in (r"\partial", "d") and token.text == "{"
                groups.append(_Group(opaque=lettered or derived or group.opaque))
            case "close" if len(groups) > 1:
                yield from _finished(groups.pop())
                groups[-1].content = token.end
            case "environment":
                if token.text.startswith(r"\begin"):
                    _begin(group, token.start)
                    groups.append(_Group(opaque=group.opaque))
                elif len(groups) > 1:
                    yield from _finished(groups.pop())
                    groups[-1].content = token.end
            case "divider":
                yield from _finished(group)
                group.starts = []
            case "sign":
                group.starts.append((token.start, token.end))
                group.content = token.end
            case _:
                _begin(group, token.start)
                group.content = token.end
        before = token.kind
    for group in groups:
        yield from _finished(group)


def _begin(group: _Group, start: int) -> None:
    if not group.starts:
        group.starts.append((start, start))


def _finished(group: _Group) -> Iterator[list[Term]]:
    if group.opaque or not group.starts:
        return
    ends = [start for start, _ in group.starts[1:]] + [group.content]
    terms = [
        Term(start, body, end)
        for (start, body), end in zip(group.starts, ends, strict=True)
        if end > body
    ]
    if terms:
        yield terms


def outermost(pieces: list[Token]) -> list[list[Term]]:
    """The sums of a formula, those that contain others first."""
    return sorted(sums(pieces), key=lambda terms: terms[0].start - terms[-1].end)
