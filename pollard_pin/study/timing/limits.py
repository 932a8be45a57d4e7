"""Limits of Pollard's motors, as laws of motion take them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, Specification
from thesis_pin.errors import BadInput, WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import instance, real
from thesis_pin.timing.limits import Limits


def motor_limits(
    specification: Specification,
    *,
    torque: float | Sequence[float] | None = None,
    speed: float | Sequence[float] | None = None,
    line: bool = False,
    rotor: float | Sequence[float] | None = None,
    force: float | None = None,
    tool_speed: float | None = None,
    tool_acceleration: float | None = None,
) -> Limits:
    """Limits of a motion.

    Args:
        specification: Gives the motors' torques and speeds where these are None.
        torque: Largest torque of each motor [N·m]: one number, or six.
        speed: Largest speed of each [rad/s], likewise.
        line: Whether torque and speed share: |τ|/torque + |ω|/speed ≤ 1.
        rotor: Inertia of each motor's rotor at its joint, N² J [kg·m²], instead of the
            specification's; one number, or six.
        force: Largest force in each ball joint [N].
        tool_speed: [m/s].
        tool_acceleration: [m/s²].
    """
    instance("specification", specification, Specification, "Specification.read()")
    efforts, speeds = specification.assumptions.joint_limits.of_motors()
    own = specification.motors.armature()
    return Limits(
        ACTUATOR_NAMES,
        efforts if torque is None else _six("torque", torque),
        speeds if speed is None else _six("speed", speed),
        line,
        None if rotor is None else _six("rotor", rotor, zero=True) - own,
        _bound("force", force, "N"),
        _bound("tool speed", tool_speed, "m/s"),
        _bound("tool acceleration", tool_acceleration, "m/s²"),
    )


def _six(name: str, values: float | Sequence[float], *, zero: bool = False) -> np.ndarray:
    array = finite_array(name, values)
    count = len(ACTUATOR_NAMES)
    if array.shape not in ((), (count,)):
        raise WrongShape(name, array.shape, f"() or ({count},), as {', '.join(ACTUATOR_NAMES)}")
    wrong = array < 0 if zero else array <= 0
    if wrong.any():
        raise BadInput(
            f"{name} is {float(array[wrong].flat[0]):g}",
            allowed="not negative" if zero else "positive numbers",
        )
    return np.array(np.broadcast_to(array, (count,)))


def _bound(name: str, value: float | None, unit: str) -> float | None:
    return None if value is None else real(name, value, low=1e-9, high=1e9, unit=unit)
