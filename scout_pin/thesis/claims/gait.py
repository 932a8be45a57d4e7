"""One statement with many lines: the printed angles take the feet along the printed gait.

Lengths and constant angles (B.2, B.3), what (5.1) keeps constant, the program's
splines and its 492 angles stand on different pages. Put together by the transforms
of 3.1 they have to close; a line is judged by closing them with its own number in.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from scout_pin.thesis.claims.angles import SOLVER, printed_angles
from scout_pin.thesis.claims.texts import Check, at, beyond, both, pieces, quantity, unreadable
from scout_pin.thesis.state import LENGTHS, Parameters, State
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.numeric.rotations import rotation

_REACH = 0.2  # m, the length every error of a foot's place is compared with
_POSE = ("x_B", "z_B", "x_i", "theta_B", "phi_B", "psi_B")
_SPLINES = ("y_B", "y_1", "z_1", "y_2", "z_2")


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    numbers = functools.cache(partial(Numbers.read, catalogue))
    return {
        "length": lambda equation: _length(numbers(), equation),
        "equal_lengths": lambda equation: _equal_lengths(numbers(), equation),
        "constant_angle": lambda equation: _constant_angle(catalogue, numbers(), equation),
        "neutral_pose": lambda equation: _neutral_pose(numbers(), equation),
        "gait_pose": lambda equation: _gait_pose(numbers(), equation),
    }


@dataclass(frozen=True)
class Numbers:
    """What the gait rests on, as printed.

    Attributes:
        lengths: Of both legs by the thesis's names ("x_01") [m].
        angles: Constant ones by name ("beta_11") [deg].
        pose: What (5.1) keeps constant ("x_B", "theta_1"), left foot's sign mended [mm], [deg].
        splines: The program's, at t = 0 … 40, by coordinate [mm].
    """

    lengths: Mapping[str, float]
    angles: Mapping[str, float]
    pose: Mapping[str, float]
    splines: Mapping[str, np.ndarray]

    @classmethod
    def read(cls, catalogue: Catalogue) -> Numbers:
        """From the rows of B.2, B.3, (5.1) and appendix D."""
        lengths: dict[str, float] = {}
        angles: dict[str, float] = {}
        pose: dict[str, float] = {}
        for name in LENGTHS:
            value, _ = quantity(catalogue[f"scout:B.2:{name}i"].members("corrected")[0])
            lengths |= {f"{name}{i}": value for i in "12"}
        for equation in catalogue.equations:
            if equation.claim == "constant_angle":
                angles[_plain(equation.left)] = quantity(equation.members("corrected")[0])[0]
        for name in _POSE:
            row = catalogue[f"scout:5:{name}"]
            pose |= _assigned(row.left, row.members("corrected")[0])
        t = np.arange(41.0)
        splines = {
            name: at(pieces(catalogue[f"scout:D:{name}"].printed[0]), t)[0] for name in _SPLINES
        }
        return cls(lengths, angles, pose, splines)

    def _state(self, q_deg: np.ndarray) -> State:
        """The robot with its joints at angles [deg] and its torso where (5.1) has it."""
        constants = {**self.lengths, **{k: np.radians(v) for k, v in self.angles.items()}}
        values = {k: np.asarray(v, dtype=float)[None, None] for k, v in constants.items()}
        count = len(q_deg)
        torso = np.stack(
            [
                np.full(count, self.pose["x_B"] * 1e-3),
                self.splines["y_B"][:count] * 1e-3,
                np.full(count, self.pose["z_B"] * 1e-3),
                *(np.full(count, np.radians(self.pose[f"{x}_B"])) for x in _EULER),
            ],
            axis=-1,
        )
        q = np.concatenate([torso, np.radians(q_deg)], axis=-1)[:, None, :]
        still = np.zeros_like(q)
        return State(Parameters(values), q, still, still, still, still[..., :12], still[..., :12])

    def gap(self) -> float:
        """By how much the feet miss their printed places and axes, beyond rounding."""
        degrees, half = printed_angles()
        state, worst = self._state(degrees), 0.0
        allowed = np.radians(half + SOLVER)
        for i in (1, 2):
            joints = slice(6 * i, 6 * i + 6)
            free = allowed[:, 6 * i - 6 : 6 * i]
            place, jacobian = (x[:, 0] for x in state.point(f"7{i}"))
            sideways = np.full(len(place), self.pose[f"x_{i}"])
            target = np.stack([sideways, self.splines[f"y_{i}"], self.splines[f"z_{i}"]], -1) * 1e-3
            slack = (np.abs(jacobian[..., joints]) @ free[..., None])[..., 0]
            worst = max(worst, beyond(place - target, slack, _REACH))
            turned = np.eye(3)
            for axis, x in zip("xyz", _EULER, strict=True):
                turned = turned @ rotation(axis, np.radians(self.pose[f"{x}_{i}"]))
            error = state.frame(f"7{i}").rotation[:, 0] - turned
            worst = max(worst, beyond(error, free.sum(-1)[:, None, None], 1.0))
        return worst

    def neutral(self, degrees: float) -> float:
        """How far the soles' axes are from the torso's, all joints at one angle [deg]."""
        state = self._state(np.full((1, 12), degrees))
        return max(float(np.abs(state.frame(f"7{i}").rotation - np.eye(3)).max()) for i in (1, 2))


_EULER = ("theta", "phi", "psi")
_TOGETHER = [{"x_B"}, {"z_B"}, {"x_1", "x_2"}, *({f"{x}_{i}" for i in "B12"} for x in _EULER)]
"""Names that a line of (5.1) has on its left."""


def _plain(left: str) -> str:
    """Name of a symbol with a subscript: ``\\beta_{11}`` → "beta_11"."""
    found = re.fullmatch(r"\\?(\w+?)_(?:\{(\w+)\}|(\w))", left.strip())
    if not found:
        raise unreadable(left)
    return f"{found[1]}_{found[2] or found[3]}"


def _assigned(left: str, text: str) -> dict[str, float]:
    """What a line of (5.1) says: of each name on its left, or in the text itself, a number."""
    if "=" in text:
        found: dict[str, float] = {}
        for part in text.split(r", \; "):
            found |= _assigned(*part.split(" = ", 1))
        return found
    value, _ = quantity(text)
    names = [_plain(name.removesuffix("(t)")) for name in left.split(" = ")]
    if not re.fullmatch(r"\S+\(t\)(?: = \S+\(t\))*", left) or len(set(names)) < len(names):
        raise unreadable(left)
    return dict.fromkeys(names, value)


def _length(numbers: Numbers, equation: Equation) -> ClaimResult:
    """A length of B.2, in both legs."""
    name = _plain(equation.left).removesuffix("i")

    def residual(text: str, left: str) -> float:
        value, _ = quantity(text)
        changed = {f"{name}{i}": value for i in "12"}
        if not changed.keys() <= numbers.lengths.keys():
            raise unreadable(equation.left)
        return replace(numbers, lengths={**numbers.lengths, **changed}).gap()

    return both(equation, residual, "with it the 492 printed angles take the feet along the gait")


def _equal_lengths(numbers: Numbers, equation: Equation) -> ClaimResult:
    """A length of the left leg is the right one's, which B.2 gives."""
    name = _plain(equation.left)

    def residual(text: str, left: str) -> float:
        other = _plain(text)
        if name == other or not {name, other} <= numbers.lengths.keys():
            raise unreadable(text)
        changed = {**numbers.lengths, name: numbers.lengths[other]}
        return replace(numbers, lengths=changed).gap()

    return both(equation, residual, "with it the printed angles of both legs reach their feet")


def _constant_angle(catalogue: Catalogue, numbers: Numbers, equation: Equation) -> ClaimResult:
    """An angle β of B.3, from 0° to 360°, which no other line of it gives."""
    name = _plain(equation.left)
    others = {
        _plain(other.left)
        for other in catalogue.equations
        if other.claim == "constant_angle" and other.id != equation.id
    }

    def residual(text: str, left: str) -> float:
        if name not in numbers.angles or name in others or not text[:1].isdigit():
            raise unreadable(f"{left} = {text}")
        return replace(numbers, angles={**numbers.angles, name: quantity(text)[0]}).gap()

    return both(equation, residual, "with it the 492 printed angles take the feet along the gait")


def _neutral_pose(numbers: Numbers, equation: Equation) -> ClaimResult:
    def residual(text: str, left: str) -> float:
        words = r"\\text\{recover the neutral pose when all \} \\theta_\{ni\} = (\S+)"
        found = re.fullmatch(words, text)
        if not found or left != r"\beta_{ni}":
            raise unreadable(text)
        return numbers.neutral(quantity(found[1])[0])

    return both(equation, residual)


def _gait_pose(numbers: Numbers, equation: Equation) -> ClaimResult:
    """A line of (5.1)."""
    said: list[dict[str, float]] = []

    def residual(text: str, left: str) -> float:
        said.append(_assigned(left, text))
        if said[-1].keys() not in _TOGETHER:
            raise unreadable(left)
        return replace(numbers, pose={**numbers.pose, **said[-1]}).gap()

    note = "with it the printed angles take the feet along the gait"
    result = both(equation, residual, note)
    if not equation.right:
        return result
    moved = abs(said[-1]["x_1"] - numbers.pose["x_1"]) * 1e-3  # the print is read last
    return replace(result, note="", effect={"left foot's place [m]": moved})
