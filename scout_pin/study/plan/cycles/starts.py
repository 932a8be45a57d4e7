"""Where searches for a cycle begin: the weight sways over the stance foot, somewhat lowered."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
import pinocchio as pin

from scout_pin.kinematics.branches import taken_branches
from scout_pin.model import Scout
from scout_pin.specification import SIDES
from scout_pin.study.plan.cycles.feet import Steps
from scout_pin.study.plan.cycles.splines import KNOTS, Cyclic
from scout_pin.study.plan.request import PlanRequest
from thesis_pin.errors import BadInput, Unreachable

_GUESSES = ((6.0, 20.0, -12.0), (10.0, 30.0, -20.0), (3.0, 12.0, -6.0), (12.0, 40.0, -30.0))
"""Roll either way [°], sway and lowering [mm] of a torso :data:`_HIGH` above the floor. Lowered by
6 mm at least: at the thesis's height a sway straightens the knee."""

_HIGH = 0.2344
STARTS = 2 * len(_GUESSES)

SHARE = 0.25
"""Share of a step in which both feet stand, to begin with."""


@dataclass(frozen=True)
class Build:
    """What a search's beginning needs to know of a robot.

    Attributes:
        height: Of the torso in the neutral pose, of the shorter leg [m].
        forward: How far the torso is ahead of a sole's origin, its centre of mass above the
            sole's middle [m].
    """

    height: float
    forward: float

    @classmethod
    def of(cls, robot: Scout) -> Build:
        """The build of a biped with a free-flyer root."""
        neutral = pin.neutral(robot.model)
        com = pin.centerOfMass(robot.model, robot.model.createData(), neutral)
        soles = np.concatenate([robot.specification.leg(side).sole for side in SIDES])
        middle = (soles[:, 1].min() + soles[:, 1].max()) / 2
        heights = [-float(foot[2, 3]) for foot in robot.neutral_feet().values()]
        return cls(min(heights), float(middle - com[1]))


def starts(build: Build, steps: Steps, cyclic: Cyclic, step_length: float) -> Iterator[np.ndarray]:
    """Coefficients ``(6, size)`` to begin with, one after the other."""
    u = np.arange(cyclic.size) / KNOTS
    sway = np.sin(np.pi * (u - SHARE / 2))
    size, middle = build.height / _HIGH, sum(steps.across) / 2 - steps.aside / 2
    for sign, (roll, aside, lower) in product((1.0, -1.0), _GUESSES):
        wanted = np.zeros((cyclic.size, 6))
        wanted[:, 0] = middle - sway * aside * 1e-3 * size
        wanted[:, 1] = build.forward - step_length / 2
        wanted[:, 2] = build.height + lower * 1e-3 * size
        wanted[:, 4] = sign * np.radians(roll) * sway
        yield cyclic.fitted(wanted)


def standing_branches(
    robot: Scout, build: Build, steps: Steps, request: PlanRequest
) -> tuple[int, int]:
    """The branches on which the legs stand side by side, knees bent a little.

    Raises:
        BadInput: The legs don't reach that far.
    """
    torso = np.eye(4)
    height = 0.95 * build.height
    if request.height is not None:
        height = float(np.clip(height, *request.height))
    torso[:3, 3] = sum(steps.across) / 2, build.forward, height
    feet = [np.eye(4), np.eye(4)]
    for foot, across in zip(feet, steps.across, strict=True):
        foot[0, 3] = across
    try:
        theta = robot.inverse_kinematics(torso, feet[0], feet[1], branch=request.branch)
    except Unreachable as error:
        raise BadInput(
            f"the feet can't stand {(steps.across[1] - steps.across[0]) * 1e3:.4g} mm apart, "
            f"{height * 1e3:.4g} mm below the torso's origin: {error.what}",
            where="foot_spacing, height",
            allowed="places that the legs reach",
            remedy="Ask for another foot_spacing or height, or for another branch",
        ) from None
    left, right = (
        int(taken_branches(robot.legs[side], theta[None, 6 * k : 6 * k + 6])[0])
        for k, side in enumerate(SIDES)
    )
    return left, right
