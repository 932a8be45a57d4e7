"""What a description says of a joint's drive: its range, its servo, its friction."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from scout_pin.making.chains import Turn
from scout_pin.making.legs import neat
from scout_pin.specification import Servo
from thesis_pin.errors import ModelError
from thesis_pin.model.mechanism.description import Description
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import TOLERANCES


def turn_range(turn: Turn, sign: int) -> tuple[float, float]:
    """Lower and upper limit [deg]."""
    limit = turn.joint.limit
    if turn.joint.kind == "continuous" or limit is None:
        return -180.0, 180.0
    low, high = sorted((sign * limit[0], sign * limit[1]))
    return neat(float(np.degrees(low))), neat(float(np.degrees(high)))


def servo_of(
    turn: Turn,
    description: Description,
    given: Sequence[float] | None,
    servos: dict[tuple[float, float, float], str],
) -> str:
    """Name of the servo with a joint's limits and rotor; a new one if there is none yet."""
    limit = turn.joint.limit
    torque, speed = (limit[2], limit[3]) if limit is not None else (0.0, 0.0)
    usable = all(0.0 < value < 1e6 for value in (torque, speed))
    if not usable and given is None:
        raise ModelError(
            f"joint {shown(turn.joint.name)} has effort {torque:g} N·m and velocity "
            f"{speed:g} rad/s",
            where=f"{description.where}:{turn.joint.line}",
            allowed="both positive",
            remedy="Write the servo's into its <limit>, or say --servo TORQUE SPEED",
        )
    if not usable and given is not None:
        torque, speed = given
    rotor = float(description.supplement.armature.get(turn.joint.name, 0.0))
    return servos.setdefault((float(torque), float(speed), rotor), f"servo_{len(servos) + 1}")


def size_of(torque: float, speed: float) -> tuple[float, float, float]:
    """A box [m] to draw a servo by: a hobby servo's, or as large as its power and torque ask."""
    usual = Servo(stall_torque=torque, no_load_speed=speed).size
    needed = max(
        0.25 * torque * speed / TOLERANCES.power_density, torque / TOLERANCES.torque_density
    )
    scale = max(1.0, 1.1 * (needed / float(np.prod(usual))) ** (1 / 3))
    a, b, c = (round(scale * edge, 4) for edge in usual)
    return a, b, c


def one_or_all(values: list[float]) -> float | tuple[float, ...]:
    return values[0] if len(set(values)) == 1 else tuple(values)


def friction_of(description: Description, joints: Sequence[str]) -> tuple[dict[str, object], str]:
    """Friction of all joints, and what to say if it is one number for several."""
    beside = description.supplement
    viscous = [description.joints[j].damping + beside.damping.get(j, 0.0) for j in joints]
    coulomb = [description.joints[j].friction + beside.friction.get(j, 0.0) for j in joints]
    said = ""
    if len(set(viscous)) > 1 or len(set(coulomb)) > 1:
        said = "The joints' friction differs and the specification has one: the largest is taken."
    why = "the file's, the largest of all joints" if said else "the file's"
    return {"why": why, "viscous": max(viscous), "coulomb": max(coulomb)}, said
