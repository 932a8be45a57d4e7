"""Checks of the angles that the program prints, and of what chapter 5 says of them."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path

import numpy as np

from scout_pin.model import Scout, load
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.thesis.claims.texts import Check, beyond, both, quantity, unreadable
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Equation

SOLVER = 2e-6
"""Degrees by which the program's own solver stops short of the root."""


def claims() -> dict[str, Check]:
    """The checks by name."""
    return {
        "constant_angles": _constant_angles,
        "initial_angles": _initial_angles,
        "printed_angles": partial(_printed_angles, load(), load_gait("thesis-program")),
    }


def printed_angles() -> tuple[np.ndarray, np.ndarray]:
    """The printed angles [deg] ``(41, 12)`` and half their last digit."""
    file = Path(__file__).parents[1] / "printed" / "printed_angles.csv"
    lines = file.read_text(encoding="utf-8").splitlines()
    rows = [line.split(",")[1:] for line in lines if line[0].isdigit()]
    half = [[0.5 * 10.0 ** -len(cell.partition(".")[2]) for cell in row] for row in rows]
    # "0." is Mathematica's machine zero, not a rounded number.
    exact = [
        [0.0 if float(cell) == 0 else h for cell, h in zip(row, halves, strict=True)]
        for row, halves in zip(rows, half, strict=True)
    ]
    return np.array(rows, dtype=float), np.array(exact)


def _constant_angles(equation: Equation) -> ClaimResult:
    """Angles of both legs that stay what is printed in all 41 rows."""
    degrees, _ = printed_angles()
    joints = [_joint(name) for name in equation.left.split(", ")]
    if len(set(joints)) < len(joints):
        raise unreadable(equation.left)

    def residual(text: str, left: str) -> float:
        """Largest difference of a printed row from the number said [°]."""
        columns = [*joints, *(k + 6 for k in joints)]
        return float(np.abs(degrees[:, columns] - quantity(text)[0]).max())

    return both(equation, residual)


def _joint(name: str) -> int:
    found = re.fullmatch(r"\\theta_\{([1-6])i\}", name)
    if not found:
        raise unreadable(name)
    return int(found[1]) - 1


def _initial_angles(equation: Equation) -> ClaimResult:
    """The start position's angles, printed once alone and once as t = 0 of the tables."""
    degrees, _ = printed_angles()
    if equation.left != r"\mathtt{Out[161]}, \mathtt{Out[162]}":
        raise unreadable(equation.left)

    def residual(text: str, left: str) -> float:
        """Largest difference from the tables' first row, relative to what stands there.

        Where the row has a zero, the difference itself [°].
        """
        found = re.fullmatch(r"\(((?:(?:\\pm |\\mp )?[\d.]+(?:, |(?=\)))){6})\)°", text)
        if not found:
            raise unreadable(text)
        worst = 0.0
        for leg, upper in enumerate((True, False)):
            for k, cell in enumerate(found[1].split(", ")):
                sign, _, digits = cell.rpartition(" ")
                value = quantity(digits)[0]
                if sign and (sign == r"\pm") != upper:
                    value = -value
                there = degrees[0, 6 * leg + k]
                worst = max(worst, abs(value - there) / (abs(there) or 1.0))
        return worst

    return both(equation, residual, "as the tables Out[347] to Out[358] have it at t = 0")


def _printed_angles(robot: Scout, program: Gait, equation: Equation) -> ClaimResult:
    """The printed angles come out of the program's splines by closed-form kinematics."""
    degrees, half = printed_angles()
    if equation.left != r"\mathtt{Out[347]} \ldots \mathtt{Out[358]}":
        raise unreadable(equation.left)
    t = np.arange(len(degrees))
    found = np.degrees(joint_trajectory(robot, program.sample(t.astype(float))).q)
    gap = np.abs(found - degrees)

    def residual(text: str, left: str) -> float:
        """Largest difference [°] beyond half the last digit and the program's solver.

        One more where the text counts other angles, or names other times.
        """
        words = re.fullmatch(r"\\text\{(\d+) angles, t = (\d+) … (\d+)\}", text)
        if not words:
            raise unreadable(text)
        said = tuple(int(x) for x in words.groups())
        return beyond(gap, half + SOLVER, 1.0) + float(said != (gap.size, t[0], t[-1]))

    return both(equation, residual, f"{degrees.size} angles, largest gap {gap.max():.1e}°")
