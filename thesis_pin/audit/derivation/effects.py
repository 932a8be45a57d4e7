"""What following one printed line of a derivation does, all others corrected."""

from __future__ import annotations

import math

import numpy as np

from thesis_pin.audit.derivation.moving.motion import times
from thesis_pin.audit.derivation.moving.states import States
from thesis_pin.audit.derivation.references import References
from thesis_pin.audit.derivation.said.glossary import Glossary
from thesis_pin.audit.derivation.said.phrases import Phrase
from thesis_pin.audit.rows import HOLDS, Effect
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import Derivative, FormulaError, Node, Sum, Symbol
from thesis_pin.equations.values import Value, apart

EFFECTS = (
    "Effects say what a reader meets who follows that one line and is right elsewhere:",
    "the change of the generalized forces, or of the quantity that the line gives, relative to",
    "the largest at those states.",
)
_FORCES = ("coriolis vector", "gravity vector", "bias vector", "inertial force", "torque")
_SIGNS = {"kinetic energy": 1.0, "lagrangian": 1.0, "potential energy": -1.0}
FORCE = "generalized force [-]"


class Effects:
    """What following one printed line does.

    Args:
        states: The states.
        glossary: What the letters stand for.
        equations: The equations.
    """

    def __init__(self, states: States, glossary: Glossary, equations: Catalogue) -> None:
        self.states, self.glossary, self.catalogue = states, glossary, equations
        self.right = References(states, glossary, equations)
        self.force = self.right.meanings.of(Phrase("torque")).array

    def of(self, equation: Equation) -> Effect:
        """Changes by quantity, relative; empty where a line gives nothing that a reader uses."""
        left = self.catalogue.parse(equation.left)
        symbol = (
            next((left.bound(i) for i in self.catalogue.indices(left)), left)
            if isinstance(left, Symbol)
            else None
        )
        if symbol is not None and not self.right.known(symbol):
            return self._through_users(equation)
        phrase = self._phrase(symbol) if symbol is not None else None
        found: dict[str, float] = {}
        for member in equation.printed:
            for name, value in self._member(equation, left, self.catalogue.parse(member), phrase):
                found[name] = max(found.get(name, 0.0), value)
        return {name: value for name, value in found.items()}

    def _phrase(self, symbol: Symbol) -> Phrase | None:
        """What a symbol must be, with the numbers of its entry."""
        name = self.glossary.find(symbol)
        given = self.glossary.symbols.get(name) if name else None
        if given is None and symbol.sub.isdigit():
            whole = self.glossary.find(Symbol(symbol.base, bold=symbol.bold))
            given = self.glossary.symbols.get(whole) if whole else None
            if isinstance(given, Phrase):
                entry = tuple(map(int, symbol.sub))
                return Phrase(**vars(given) | {"entry": entry})
        return given if isinstance(given, Phrase) and not symbol.dots else None

    def _member(
        self, equation: Equation, left: Node, member: Node, phrase: Phrase | None
    ) -> list[tuple[str, float]]:
        if phrase is not None and phrase.quantity in _SIGNS:
            change = self._lagrange(Sum((("+", member), ("-", left))))
            return [(FORCE, self._relative(change * _SIGNS[phrase.quantity]))]
        found = []
        for indices in self.catalogue.indices(left, member):
            first, second = (evaluate(side, self.right, indices) for side in (left, member))
            if first.tail != second.tail:
                return [(self._named(phrase), math.inf)]
            gap = apart(second, first)
            push = self._push(gap, phrase)
            if push is not None:
                found.append((FORCE, self._relative(push)))
            else:
                size = max(float(np.abs(first.array).max()), float(np.abs(second.array).max()))
                found.append((self._named(phrase), _ratio(gap, size)))
        return found

    @staticmethod
    def _named(phrase: Phrase | None) -> str:
        return f"{phrase.quantity if phrase else 'this line'} [-]"

    def _push(self, gap: np.ndarray, phrase: Phrase | None) -> np.ndarray | None:
        """The generalized forces that belong to a change of one of their terms."""
        if phrase is None:
            return None
        v, a, n = self.states.v, self.states.a, self.states.coordinates.count
        rates = {"mass matrix": a, "coriolis matrix": v}.get(phrase.quantity)
        if rates is None and phrase.quantity not in _FORCES:
            return None
        if phrase.entry:
            row = np.eye(n)[phrase.entry[-1] - 1]
            gap = np.broadcast_to(gap, a.shape[:1])[..., None] * row
            if len(phrase.entry) > 1:
                gap = gap[..., None, :] * np.eye(n)[phrase.entry[0] - 1][:, None]
        return gap if rates is None else times(gap, rates)

    def _lagrange(self, energy: Node) -> np.ndarray:
        """Generalized forces of a formula as Lagrangian, shape ``(N, n)``."""
        found = []
        for symbol in self._coordinates():
            rate = Symbol(symbol.base, symbol.sub, symbol.sup, 1, symbol.primes, symbol.bold)
            momentum = Derivative(Derivative(energy, rate), None)
            law = Sum((("+", momentum), ("-", Derivative(energy, symbol))))
            value: Value = evaluate(law, self.right, {})
            found.append(np.broadcast_to(value.array, self.states.x.shape[:1]))
        return np.stack(found, axis=-1)

    def _coordinates(self) -> list[Symbol]:
        notation = self.catalogue.notation
        return [notation.symbol(text) for text in self.states.coordinates.symbols]

    def _relative(self, push: np.ndarray) -> float:
        return _ratio(push, max(float(np.abs(self.force).max()), HOLDS))

    def _through_users(self, equation: Equation) -> Effect:
        """What a misprinted definition does to the lines that use it."""
        wrong = References(self.states, self.glossary, self.catalogue, equation.id)
        found: dict[str, float] = {}
        for user in self.catalogue.equations:
            if user.id == equation.id or not user.left or user.illegible or user.not_checkable:
                continue
            left = self.catalogue.parse(user.left)
            phrase = self._phrase(left) if isinstance(left, Symbol) else None
            for text in user.members("corrected"):
                member = self.catalogue.parse(text)
                for indices in self.catalogue.indices(left, member):
                    try:
                        old, new = (evaluate(member, one, indices) for one in (self.right, wrong))
                    except FormulaError:
                        continue
                    if equation.id not in wrong.used or old.tail != new.tail:
                        continue
                    gap = apart(new, old)
                    push = self._push(gap, phrase)
                    name = FORCE if push is not None else self._named(phrase)
                    size = float(np.abs(old.array).max()) or 1.0
                    change = self._relative(push) if push is not None else _ratio(gap, size)
                    if change > HOLDS:
                        found[name] = max(found.get(name, 0.0), change)
        return {name: value for name, value in found.items()}


def _ratio(change: np.ndarray, size: float) -> float:
    """The largest change of a size; infinity if one isn't finite, which NaN would hide."""
    largest = float(np.abs(change).max() / (size or 1.0))
    return largest if math.isfinite(largest) else math.inf
