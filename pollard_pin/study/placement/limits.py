"""A robot whose motors have other limits."""

from __future__ import annotations

from collections.abc import Sequence

from pollard_pin.model import Pollard
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance


def with_limits(
    robot: Pollard,
    torque: float | Sequence[float] | None = None,
    speed: float | Sequence[float] | None = None,
) -> Pollard:
    """The same robot with other limits of its motors.

    Args:
        robot: The robot.
        torque: Of each motor [N·m]: one number, six in the order of
            :data:`~pollard_pin.ACTUATOR_NAMES`, or None for the specification's.
        speed: The same of its speed [rad/s].

    Raises:
        BadInput: There are neither one nor six positive numbers.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    held = robot.specification
    limits: dict[str, object] = {}
    for name, key, given in (("torque", "effort", torque), ("speed", "velocity", speed)):
        if given is None:
            continue
        values = finite_array(name, given).reshape(-1)
        if len(values) not in (1, 6) or not (values > 0).all():
            raise BadInput(
                f"limits of {name} are {values.tolist()}",
                allowed="one positive number, or six in the order of the motors",
            )
        limits[key] = tuple(values.tolist()) if len(values) > 1 else float(values[0])
        limits["why"] = "other limits of the motors were asked for"
    if not limits:
        return robot
    assumed = held.assumptions
    joints = assumed.joint_limits.model_copy(update=limits)
    other = held.model_copy(
        update={"assumptions": assumed.model_copy(update={"joint_limits": joints})}
    )
    return Pollard(other, robot.inertia)
