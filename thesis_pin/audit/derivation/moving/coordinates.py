"""A derivation's coordinates as sums of a robot's joints: "joint1 + joint2 - 90 deg"."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.counted import counted
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.tolerances import TOLERANCES

_UNITS = {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180, "m": 1.0, "mm": 1e-3, "cm": 1e-2}


@dataclass(frozen=True)
class Coordinates:
    """x = A q + b, for the joints that move; the others stand still at their zero.

    Attributes:
        symbols: The derivation's symbols of x, LaTeX.
        joints: Names of the joints of q, in the tree's order.
        joint_rates: A⁻¹: what of the joints' rates belongs to each coordinate's,
            shape ``(joints of the tree, n)``.
        shift: b, shape ``(n,)``.
    """

    symbols: tuple[str, ...]
    joints: tuple[str, ...]
    joint_rates: np.ndarray
    shift: np.ndarray

    @property
    def count(self) -> int:
        """n, the number of coordinates."""
        return len(self.symbols)

    def q(self, x: np.ndarray) -> np.ndarray:
        """The joints' coordinates, shape ``(N, joints of the tree)``."""
        return np.asarray((x - self.shift) @ self.joint_rates.T)


def read(said: Mapping[str, str], joints: Sequence[str], where: str) -> Coordinates:
    """Coordinates as a file says them.

    Args:
        said: Symbol → sum of joints, as ``joint1 + joint2 - 90 deg``.
        joints: The joints that the tree has.
        where: The file, for messages.

    Raises:
        UnknownName: A joint that there isn't.
        BadInput: A sum can't be understood, or the joints don't follow from the coordinates.
    """
    rows, shift = [], []
    for symbol, text in said.items():
        row, constant = _sum(text, joints, f"{where}: coordinates.{symbol}")
        rows.append(row)
        shift.append(constant)
    matrix = np.array(rows)
    used = [k for k in range(len(joints)) if matrix[:, k].any()]
    square = matrix[:, used]
    few = len(used) != len(rows)
    if few or np.linalg.svd(square, compute_uv=False).min() < TOLERANCES.rank:
        named = ", ".join(joints[k] for k in used)
        raise BadInput(
            f"{counted(len(rows), 'coordinate')}, made of {counted(len(used), 'joint')} ({named}), "
            "which don't follow from them",
            where=f"{where}: coordinates",
            allowed="as many coordinates as joints, each independent of the others",
        )
    rates = np.zeros((len(joints), len(rows)))
    rates[used] = np.linalg.inv(square)
    return Coordinates(tuple(said), tuple(joints[k] for k in used), rates, np.array(shift))


def _sum(text: str, joints: Sequence[str], where: str) -> tuple[np.ndarray, float]:
    """Coefficients of the joints in a sum, and its constant [rad], [m]."""
    row, constant = np.zeros(len(joints)), 0.0
    words = re.sub(r"(?<=\s)([+-])\s+", r"\1", text.strip()).split()
    sign, factor = 1.0, None
    for word in words:
        if word in ("*", "·"):
            continue
        if word in joints:  # names may begin with a sign or a number
            row[joints.index(word)] += sign * (1.0 if factor is None else factor)
            sign, factor = 1.0, None
            continue
        if word[0] in "+-":
            if factor is not None:
                raise BadInput(
                    f"{text!r}: the number {factor:g} has neither joint nor unit",
                    where=where,
                    allowed="a joint, deg, rad, m or mm behind it",
                )
            sign, word = (-1.0 if word[0] == "-" else 1.0), word[1:]
        number = re.match(r"(\d+\.?\d*|\.\d+)(.*)", word)
        if number and word not in joints:
            factor, word = float(number[1]), number[2].lstrip("*")
        if not word:
            continue
        if word in joints:
            row[joints.index(word)] += sign * (1.0 if factor is None else factor)
        elif factor is not None and word in _UNITS:
            constant += sign * factor * _UNITS[word]
        else:
            raise UnknownName("joint", word, list(joints), where=where)
        sign, factor = 1.0, None
    if factor is not None:
        raise BadInput(
            f"{text!r}: the number {factor:g} has neither joint nor unit",
            where=where,
            allowed="a joint, deg, rad, m or mm behind it",
        )
    if not row.any():
        raise BadInput(f"{text!r} has no joint in it", where=where, allowed=", ".join(joints))
    return row, constant
