"""Factors beside each other: functions take the next, brackets say what a symbol depends on."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

from thesis_pin.equations.formula import (
    Call,
    Derivative,
    Matrix,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Symbol,
    Transpose,
)
from thesis_pin.equations.parsing.conventions import Conventions
from thesis_pin.equations.parsing.marks import (
    Arguments,
    Group,
    Mark,
    Slash,
    column,
    diagonal,
    opened,
)


class Factors:
    """Reads the factors of a product one by one.

    Args:
        notation: What the letters mean.
    """

    def __init__(self, notation: Conventions) -> None:
        self.notation = notation

    def next(self, waiting: list[Node]) -> Node:
        """The next factor, with all that belongs to it.

        Args:
            waiting: What stands beside each other; what the factor takes is removed.

        Raises:
            ValueError: It isn't clear what belongs to it, or nothing does.
        """
        node = waiting.pop(0)
        if isinstance(node, Slash):
            return self._slashed(node, waiting)
        if isinstance(node, Transpose) and isinstance(node.of, Arguments):
            return column(node.of)  # (x, y)^T
        if isinstance(node, Arguments):
            raise ValueError("a list in brackets after something that isn't a symbol")
        if isinstance(node, Symbol):
            follower = waiting[0] if waiting else None
            differs = node.base == "delta" and "delta" not in self.notation.declared
            if differs and isinstance(follower, Symbol | Derivative):
                follower = self.next(waiting)
                if isinstance(follower, Symbol):
                    return replace(follower, base=f"delta:{follower.base}")
            plain = not (node.sub or node.sup or node.dots or node.bold)
            short = dict(self.notation.shorthand)
            if plain and node.base in short and _is_angle(follower):
                node = Mark("function", short[node.base])
        following = waiting[0] if waiting else None
        if isinstance(following, Slash) and (
            isinstance(node, Mark) or self._depends(node, following.above)
        ):
            if not isinstance(following.above, Group | Arguments):
                raise ValueError("a slash after a function: put brackets where they belong")
            waiting[0] = following.above
            whole = Quotient(self.next([node, waiting.pop(0)]), opened(following.below))
            return _unambiguous(whole, following, waiting)
        if isinstance(node, Mark):
            if not waiting:
                raise ValueError(f"nothing follows {node.name or 'the derivative'}")
            return _apply(node, self._argument(node, waiting))
        if isinstance(node, Power) and isinstance(following, Group):
            # T^{-1}(θ) is the inverse of T(θ)
            inner = node.base
            if isinstance(inner, Symbol) and inner.name in self.notation.functions:
                waiting.pop(0)
                return Power(Call(inner.name, following.inside, inner.dots), node.exponent)
        if (
            isinstance(node, Symbol)
            and isinstance(following, Transpose)
            and self._depends_on(following.of)
        ):
            waiting.pop(0)
            return Transpose(node)
        if isinstance(following, Transpose) and isinstance(following.of, Arguments):
            known = self.notation.factors or ()
            if isinstance(node, Symbol) and node.name not in known:  # f(q, a)^T is no product
                raise ValueError("a list in brackets after something that isn't a symbol")
        called = isinstance(node, Symbol) and node.name in self.notation.functions
        if isinstance(node, Symbol) and called and isinstance(following, Group):
            waiting.pop(0)
            return Call(node.name, following.inside, node.dots)
        if self._depends(node, following):
            waiting.pop(0)
        return node

    def _argument(self, mark: Mark, waiting: list[Node]) -> Node:
        """What a function or derivative is of: the factor after it, with a number before it."""
        if mark.name == "diag" and isinstance(waiting[0], Arguments):
            return Group(diagonal(cast(Arguments, waiting.pop(0)).of))
        if mark.name == "atan2":
            given = waiting.pop(0)
            if not isinstance(given, Arguments) or len(given.of) != len(("y", "x")):
                raise ValueError("atan2 takes two numbers in brackets: atan2(y, x)")
            return Group(Matrix(tuple((one,) for one in given.of)))
        first = self.next(waiting)
        more = bool(waiting)
        multiple = mark.kind == "function" and isinstance(first, Number) and more
        if multiple and isinstance(waiting[0], Symbol | Power):  # cos 2θ
            return Product((first, self.next(waiting)))
        loose = isinstance(first, Symbol | Number | Call) and self.notation.factors is not None
        if mark.kind == "derivative" and more and loose:
            raise ValueError("a derivative before several factors: put brackets where they belong")
        return first

    def _slashed(self, node: Slash, waiting: list[Node]) -> Node:
        """A fraction on one line, of the two factors that its slash stands between."""
        if isinstance(node.above, Mark) or isinstance(node.below, Mark):
            raise ValueError("a slash beside a function: put brackets where they belong")
        whole = Quotient(opened(node.above), opened(node.below))
        return _unambiguous(whole, node, waiting)

    def _depends(self, node: Node, following: Node | None) -> bool:
        """Whether what stands in brackets behind a symbol says only what it depends on."""
        if isinstance(node, Power) and self.notation.factors is not None:
            node = node.base  # M^{-1}(q)
        if not isinstance(node, Symbol):
            return False
        if isinstance(following, Arguments):
            return self._depends_on(following)
        if not isinstance(following, Group):
            return False
        inside, factors = following.inside, self.notation.factors
        if factors is not None and node.name in factors:
            return isinstance(inside, Symbol) and inside.name == "t"
        return self._says_only_dependence(inside)

    def _depends_on(self, listed: Node) -> bool:
        """Whether all that stands in brackets is what a symbol may depend on."""
        several = listed.of if isinstance(listed, Arguments) else (listed,)
        return all(self._says_only_dependence(one) for one in several)

    def _says_only_dependence(self, inside: Node) -> bool:
        return isinstance(inside, Symbol) and inside.name in self.notation.ignored_arguments


def _unambiguous(whole: Quotient, node: Slash, waiting: list[Node]) -> Node:
    if waiting and not isinstance(node.below, Number | Group):
        raise ValueError("factors after a slash: put brackets where they belong")
    return whole


def _is_angle(node: Node | None) -> bool:
    if isinstance(node, Power):
        node = node.base
    if isinstance(node, Symbol):
        return node.base in ("theta", "phi", "psi", "beta", "alpha", "gamma") and not node.bold
    return isinstance(node, Group)


def _apply(mark: Mark, argument: Node) -> Node:
    if mark.kind == "derivative":
        return Derivative(opened(argument), mark.by)
    if mark.name == "diag":
        inside = opened(argument)
        return inside if isinstance(inside, Matrix) else diagonal((inside,))
    exponent = mark.exponent
    # c θ^2 is the square of the cosine
    if isinstance(argument, Power) and isinstance(argument.exponent, int):
        exponent, argument = exponent * argument.exponent, argument.base
    call = Call(mark.name, opened(argument))
    return call if exponent == 1 else Power(call, exponent)
