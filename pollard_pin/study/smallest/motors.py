"""Which motors there are for Pollard, and which of its six are alike."""

from __future__ import annotations

from typing import Literal

from pollard_pin.model import Pollard
from pollard_pin.specification import ACTUATOR_NAMES
from thesis_pin.numeric.checks import choice
from thesis_pin.sizing.actuator import RATED
from thesis_pin.sizing.smallest.family import Bound, Family

Per = Literal["group", "joint", "robot"]
PERS: tuple[Per, ...] = ("group", "joint", "robot")
BASE, WRIST = (0, 1, 2), (3, 4, 5)


def motor_family(
    robot: Pollard,
    *,
    speed: float | None = None,
    armature: float | None = None,
    exponent: float = 0.0,
    power: float | None = None,
    rating: float = RATED,
    bound: Bound = "box",
) -> Family:
    """Motors of any size that are otherwise the specification's.

    Args:
        robot: The robot.
        speed: No-load or greatest speed [rad/s]; None for the specification's limit of each.
        armature: N² J of a motor of 1 N·m [kg·m²]; None for the specification's of each.
        exponent: How it grows with the stall torque.
        power: Greatest power [W], instead of the speed.
        rating: Share of the stall torque that is borne for long.
        bound: How torque and speed bound each other; the trajectory report judges a box.
    """
    specification = robot.specification
    return Family.of(
        len(ACTUATOR_NAMES),
        specification.assumptions.joint_limits.of_motors()[1] if speed is None else speed,
        specification.motors.armature() if armature is None else armature,
        exponent=exponent,
        bound="line" if power is not None else bound,
        power=power,
        rating=rating,
    )


def groups(per: Per) -> dict[str, tuple[int, ...]]:
    """Motors that are alike: the base's and the wrist's, none, or all six.

    Raises:
        UnknownName: ``per`` is none of these.
    """
    choice("way to group motors", per, PERS)
    if per == "robot":
        return {"all motors": (*BASE, *WRIST)}
    if per == "joint":
        return {name: (k,) for k, name in enumerate(ACTUATOR_NAMES)}
    return {"base motors": BASE, "wrist motors": WRIST}
