"""Single changes with which a failing line would hold: guesses at what was meant."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from thesis_pin.audit.comparison.places import places
from thesis_pin.audit.comparison.tokens import Token, sums, tokens
from thesis_pin.audit.judging.residuals import residual
from thesis_pin.audit.mutation.slips import planted
from thesis_pin.audit.rows import HOLDS
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import Environment
from thesis_pin.equations.formula import Symbol

MOST = 3
"""Changes that are named."""
_SCRIPT = r"(?:\s*_\s*(?:\{[^{}]*\}|\\[a-zA-Z]+|\w))?"
_SYMBOL = re.compile(
    rf"(?:\\dd?ot\s*(?:\{{[^{{}}]*\}}|\\[a-zA-Z]+|[a-zA-Z])|\\[a-zA-Z]+|[a-zA-Z]){_SCRIPT}"
)
_NO_SYMBOLS = re.compile(
    r"\\(?:begin|end)\s*\{\w+\}|\\(?:text|label|tag|operatorname)\s*\{[^{}]*\}|\\mathrm\s*\{\s*a\w+\}|\\(?:left|right|[tdc]?frac|cos|sin|tan"
    r"|cdot|times|partial|quad|qquad|sqrt|sum|mathbf|boldsymbol|bm|mathcal|mathrm|mathbb|top)"
    r"(?![a-zA-Z])"
)


def mends(
    equation: Equation, catalogue: Catalogue, environments: Sequence[Environment]
) -> tuple[str, ...]:
    """Changes of one symbol, sign or factor with which the print would hold, as places in words.

    The likeliest kind that has any: a sign, an index, sine for cosine, a dot, a number,
    another symbol, a factor or term too many or too few. Of a line whose left side is a
    formula, as "… = 0", that side is changed, too.

    Args:
        equation: A line that fails and that nothing is given in the place of.
        catalogue: The derivation's equations.
        environments: Where it has to hold.
    """
    apart = Catalogue(catalogue.equations, catalogue.notation)  # keeps what is tried to itself
    vocabulary = _vocabulary(catalogue)
    failing = [
        k
        for k, text in enumerate(equation.printed)
        if not _holds(equation, text, apart, environments)
    ]
    if len(failing) == 1:
        number = failing[0]
        where = f"member {number + 1}, " if len(equation.printed) > 1 else ""
        found = _found(
            equation.printed[number],
            vocabulary,
            lambda text: _holds(equation, text, apart, environments),
        )
        if found:
            return tuple(where + said for said in found)
    if len(failing) < len(equation.printed) or isinstance(apart.parse(equation.left), Symbol):
        return ()
    found = _found(
        equation.left,
        vocabulary,
        lambda text: all(
            _holds(equation, member, apart, environments, left=text) for member in equation.printed
        ),
    )
    return tuple(f"left side, {said}" for said in found)


def _found(
    printed: str, vocabulary: Sequence[str], holds: Callable[[str], bool]
) -> tuple[str, ...]:
    """The changes of a side with which its line holds, of the likeliest kind that has any."""
    for trials in _kinds(printed, vocabulary):
        if found := [text for text in trials if holds(text)]:
            return tuple("; ".join(places(printed, text)) for text in dict.fromkeys(found[:MOST]))
    return ()


def _holds(
    equation: Equation,
    text: str,
    catalogue: Catalogue,
    environments: Sequence[Environment],
    left: str = "",
) -> bool:
    return all(
        residual(catalogue, equation, [text], one, left or equation.left).value < HOLDS
        for one in environments
    )


def _vocabulary(catalogue: Catalogue) -> list[str]:
    """Every symbol of the derivation as it is written there, once."""
    listed: dict[str, None] = {}
    for one in catalogue.equations:
        for text in (one.left, *one.printed, *one.mending.values()):
            listed |= dict.fromkeys(text[a:b] for a, b in _symbols(text))
    return list(listed)


def _symbols(formula: str) -> Iterator[tuple[int, int]]:
    """Where symbols stand in a formula, with dots and subscripts."""
    blank = _NO_SYMBOLS.sub(lambda found: " " * len(found[0]), formula)
    yield from (found.span() for found in _SYMBOL.finditer(blank))


def _kinds(printed: str, vocabulary: Sequence[str]) -> Iterator[Iterator[str]]:
    """Changed formulas, the likeliest kinds of changes first."""
    for kind in ("sign", "sine for cosine", "index", "dot", "digit"):
        yield (one.text for one in planted(printed, kind))
    yield _replaced(printed, vocabulary, alike=True)
    yield _replaced(printed, vocabulary, alike=False)
    yield _numbers(printed, tokens(printed))
    yield _factors(printed, tokens(printed), vocabulary)
    yield (one.text for one in planted(printed, "term dropped"))


def _replaced(printed: str, vocabulary: Sequence[str], *, alike: bool) -> Iterator[str]:
    """A symbol for another: for one of the same letter, or of another."""
    for start, end in _symbols(printed):
        old = printed[start:end]
        for new in vocabulary:
            same = old.split("_")[0] == new.split("_")[0]
            if new != old and same == alike:
                yield f"{printed[:start]}{new} {printed[end:]}"


def _numbers(printed: str, pieces: Sequence[Token]) -> Iterator[str]:
    """Twos, halves and squares too many or too few."""
    for terms in sums(list(pieces)):
        for term in terms:
            for factor in ("2 ", r"\frac{1}{2} "):
                yield f"{printed[: term.body]}{factor}{printed[term.body :]}"
    for token in pieces:
        if token.kind == "number" or token.text in ("^2", "^{2}"):
            yield f"{printed[: token.start]} {printed[token.end :]}"
    for _, end in _symbols(printed):
        yield f"{printed[:end]}^2 {printed[end:]}"


def _factors(printed: str, pieces: Sequence[Token], vocabulary: Sequence[str]) -> Iterator[str]:
    """A symbol too many or too few."""
    for start, end in _symbols(printed):
        yield f"{printed[:start]} {printed[end:]}"
    for terms in sums(list(pieces)):
        for term in terms:
            for new in vocabulary:
                yield f"{printed[: term.body]}{new} {printed[term.body :]}"
