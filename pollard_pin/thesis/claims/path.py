"""Check of appendix B: can the printed path be followed?

Source: Pollard thesis, appendix B.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from pollard_pin.kinematics.geometry import USEFUL_BRANCHES
from pollard_pin.model import Pollard
from pollard_pin.thesis.claims.given import Check, Given, thesis_robot, value_of
from pollard_pin.thesis.references import References
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation

_DIRECTIONS, _SAMPLES = 150, 961


def path_points(catalogue: Catalogue, members: tuple[str, ...]) -> np.ndarray:
    """The curve at evenly spaced t of its interval, the last member [m], shape ``(n, 3)``."""
    *curve, interval = members
    ends = interval.strip().removeprefix("(").removesuffix(")").split(",")
    first, last = (float(value_of(catalogue, end, Given(pi=np.pi))) for end in ends)
    given = Given(t=np.linspace(first, last, _SAMPLES))
    return np.stack([value_of(catalogue, member, given) for member in curve], axis=-1) * 1e-3


def best_margins(robot: Pollard, points: np.ndarray) -> np.ndarray:
    """Largest reach margin over tool directions and branches at each point, ``(n,)``.

    The turn about the tool's own axis moves the wrist's last joint alone, so
    directions spread over a sphere are all there is to try.
    """
    k = np.arange(_DIRECTIONS) + 0.5
    polar, around = np.arccos(1 - 2 * k / _DIRECTIONS), np.pi * (1 + math.sqrt(5)) * k
    poses = np.zeros((len(points), _DIRECTIONS, 6))
    poses[..., :3] = points[:, None]
    # x axis of Rx(θ) Ry(ψ): (cos ψ, sin θ sin ψ, −cos θ sin ψ)
    poses[..., 3], poses[..., 4] = polar, around
    branches = [branch for branch in USEFUL_BRANCHES if branch.w == branch.e1 == branch.e2 == 1]
    return np.asarray(robot.inverse_kinematics(poses, branches).margin.max(axis=(1, 2)))


def _path(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """Whether the tip can follow the printed curve with any orientation of the tool."""
    robot = thesis_robot()
    printed = path_points(catalogue, tuple(equation.printed))
    margins = best_margins(robot, printed)
    moved = path_points(catalogue, equation.members("corrected"))
    upright = robot.inverse_kinematics(np.pad(moved, ((0, 0), (0, 3)))).margin.min()
    shifts = np.arange(0.0, 1.0, 0.01)
    poses = np.pad(printed, ((0, 0), (0, 3)))[None] + np.eye(6)[0] * shifts[:, None, None]
    fits = shifts[robot.inverse_kinematics(poses).margin.min(axis=1) >= 0]
    note = (
        f"the best margin over all orientations is {margins.min():.1f} at the worst point and "
        f"negative on {(margins < 0).mean():.0%} of the curve; 0.45 m farther out it is at least "
        f"{upright:.2f} with one orientation all along, which any shift by {fits.min():.2f} to "
        f"{fits.max():.2f} m allows"
    )
    effect: dict[str, float | str] = {"the path": "can't be followed"}
    short, mended = (max(0.0, -float(margin)) for margin in (margins.min(), upright))
    return ClaimResult(short, mended, note, effect)


CHECKS: Mapping[str, Check] = {"path": _path}
"""Checks by the first part of a claim's name."""
