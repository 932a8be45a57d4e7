"""Vectors that are free of the mechanism: what a line of vectors takes as given never vanishes.

On the mechanism the bases stand still and a side chain's offset lies along the axis of its
motor, so that v_10 = 0 and ω_2i × r_32i = 0. Here each frame has a rotation and an angular
velocity of its own, each vector seen from its own frame is free, and what the thesis makes of
these follows from its other lines: r_G1 from the loop, r_32i^0 from R_2i^0 r_32i^2i, v from r.

Source: Pollard thesis, 3.2, 3.4, 3.5.
"""

from __future__ import annotations

import zlib
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pollard_pin.thesis.symbols import frames
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.frames import Frames
from thesis_pin.equations.values import STEP, Value, imaginary, matrix, vector
from thesis_pin.numeric.rotations import rotation

_STATES = 3
Definitions = Mapping[tuple[str, int], list[tuple[Equation, dict[str, str]]]]


def definitions(catalogue: Catalogue) -> Definitions:
    """All lines that say what a vector is: name and dots → line, its indices."""
    found: Definitions = defaultdict(list)
    for equation in catalogue.equations:
        if equation.claim or not equation.members("corrected"):
            continue
        try:
            left = catalogue.parse(equation.left)
        except FormulaError:
            continue
        if isinstance(left, Symbol):
            for indices in catalogue.indices(left):
                found[left.bound(indices).name, left.dots].append((equation, indices))
    return found


@dataclass
class FreeVectors:
    """Symbols of lines of vectors, each free or made of free ones by the thesis's other lines.

    Attributes:
        catalogue: The equations.
        known: Which lines say what each symbol is.
        but: The line under test, which isn't used.
        along: What a step is taken along: "t", a coordinate's name, or nothing.
    """

    catalogue: Catalogue
    known: Definitions
    but: str
    along: str = ""
    columns: int = 6
    _busy: list[str] = field(default_factory=list)

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """A free value, or what other lines make of free ones."""
        i = indices.get("i", "")
        if symbol.base == "v" and symbol.sup == frames.WORLD and not symbol.dots:
            return self.partial(replace(symbol, base="r"), None, indices)
        if symbol.dots:
            return self.partial(replace(symbol, dots=symbol.dots - 1), None, indices)
        if symbol.base == "R":
            return self._rotation(symbol, i)
        if symbol.base not in ("i", "j", "k", "r", "omega"):
            raise FormulaError(f"{symbol.name} isn't a vector")
        made = self._made(symbol, indices) if symbol.base in ("r", "k") else None
        return made or self._free(symbol, i)

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """A derivative by time or by a coordinate, of what is free a free one."""
        if self.along:
            raise FormulaError("a derivative of a derivative has no free value")
        moved = replace(self, along=by.name if by else "t", _busy=[])
        return imaginary(evaluate(of, moved, indices))

    def turning(self, axis: str, argument: Node, indices: dict[str, str]) -> Frames:
        """Frames of a printed rotation."""
        return frames.of_rotation(axis, argument, indices)

    def _made(self, symbol: Symbol, indices: dict[str, str]) -> Value | None:
        if symbol.name in self._busy:
            return None
        for equation, bound in self.known.get((symbol.name, 0), []):
            if equation.id == self.but or bound.get("i") not in (None, indices.get("i")):
                continue
            self._busy.append(symbol.name)
            try:
                member = self.catalogue.parse(equation.members("corrected")[-1])
                return evaluate(member, self, {**indices, **bound})
            except FormulaError:
                continue
            finally:
                self._busy.pop()
        return None

    def _drawn(self, *key: str) -> np.ndarray:
        generator = np.random.default_rng(zlib.crc32(" ".join(key).encode()))
        size = generator.uniform(0.3, 1.5, (_STATES, 3))
        return np.asarray(size * generator.choice([-1, 1], (_STATES, 3)))

    def _step(self, name: str) -> np.ndarray | float:
        return 1j * STEP * self._drawn(name, self.along) if self.along else 0.0

    def _free(self, symbol: Symbol, i: str) -> Value:
        name = f"{symbol.name} {i}" if "i" in symbol.sub + symbol.sup else symbol.name
        seen = frames.of_symbol(symbol, (3,), i)
        own = symbol.sup not in ("", frames.WORLD)  # what a frame carries doesn't change in it
        step = 0.0 if own or symbol.sub == frames.WORLD else self._step(name)
        return vector(self._drawn(name) + step).within(seen)

    def _rotation(self, symbol: Symbol, i: str) -> Value:
        name = frames.frame(symbol.sub, i)
        if name is None or symbol.sup != frames.WORLD:
            raise FormulaError(f"there is no frame of {symbol.name}")
        x, y, z = (self._drawn("angle", name)[:, k] for k in range(3))
        turned = rotation("x", x) @ rotation("y", y) @ rotation("z", z)
        if self.along:
            spin = self._spin(name)
            spun = np.swapaxes(np.cross(spin[:, None, :], np.eye(3)), -1, -2)
            turned = turned + 1j * STEP * (spun @ turned)
        return matrix(turned).within(frames.of_symbol(symbol, (3, 3), i))

    def _spin(self, name: str) -> np.ndarray:
        if self.along != "t" or name == frames.WORLD:
            return self._drawn("turn", name, self.along)
        number, _, chain = name.rstrip(")").partition("(")
        of = Symbol("omega", number + "i" * bool(chain), frames.WORLD, kept="i", bold=True)
        return replace(self, along="").lookup(of, {"i": chain} if chain else {}).array
