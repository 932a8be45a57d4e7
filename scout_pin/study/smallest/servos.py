"""The same biped with other servos, and what a gait asks of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.numeric.checks import choice
from thesis_pin.sizing.actuator import RATED, Actuator
from thesis_pin.sizing.smallest.family import Family

Per = Literal["robot", "group", "joint"]
PERS: tuple[Per, ...] = ("robot", "group", "joint")


def with_servos(robot: Scout, servos: Sequence[Actuator]) -> Scout:
    """The biped with other servos: their torque, speed and rotor; masses and sizes stay.

    Args:
        robot: The biped.
        servos: One for each of the twelve joints.
    """
    specification = robot.specification
    made, legs = {}, {}
    for side, some in zip(SIDES, (servos[:6], servos[6:]), strict=True):
        leg = specification.leg(side)
        names = []
        for joint, old, new in zip(range(6), leg.servos, some, strict=True):
            name = f"{side} {joint + 1}"
            names.append(name)
            made[name] = specification.servos[old].model_copy(
                update={
                    "stall_torque": new.stall_torque,
                    "no_load_speed": new.no_load_speed,
                    "rotor_inertia": new.armature,
                    "gear_ratio": 1.0,
                }
            )
        legs[side] = leg.model_copy(update={"servo": tuple(names)})
    changed = specification.model_copy(
        update={"servos": made, "legs": specification.legs.model_copy(update=legs)}
    )
    return Scout(changed, robot.root, robot.inertia)


def motor_family(
    robot: Scout,
    *,
    speed: float | None = None,
    armature: float | None = None,
    exponent: float = 0.0,
    power: float | None = None,
    rating: float = RATED,
) -> Family:
    """Servos of any size that are otherwise the specification's.

    Args:
        robot: The biped.
        speed: No-load speed [rad/s]; None for that of each joint's own servo.
        armature: N² J of a servo of 1 N·m [kg·m²]; None for that of each joint's own servo.
        exponent: How it grows with the stall torque.
        power: Greatest power [W], instead of the speed.
        rating: Share of the stall torque that is borne for long.
    """
    return Family.of(
        len(JOINT_NAMES),
        robot.no_load_speed if speed is None else speed,
        robot.specification.armature() if armature is None else armature,
        exponent=exponent,
        power=power,
        rating=rating,
    )


def of_size(family: Family, torque: float) -> list[Actuator]:
    """Twelve servos of a stall torque [N·m]."""
    return [family.actuator(torque, joint) for joint in range(len(JOINT_NAMES))]


def groups(per: Per) -> dict[str, tuple[int, ...]]:
    """Joints whose servos are alike: all twelve, those of both legs, or none.

    Raises:
        UnknownName: ``per`` is none of these.
    """
    choice("way to group joints", per, PERS)
    if per == "robot":
        return {"all servos": tuple(range(12))}
    if per == "joint":
        return {name: (k,) for k, name in enumerate(JOINT_NAMES)}
    bare = [name.removeprefix("left_") for name in JOINT_NAMES[:6]]
    return {f"{name} of both legs": (k, k + 6) for k, name in enumerate(bare)}
