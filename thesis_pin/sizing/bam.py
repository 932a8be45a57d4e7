"""Parameter files of Rhoban's identified servo models → actuators.

A file holds what an identification of one servo on a pendulum found, at its output: the torque
constant ``kt``, the winding's resistance ``R``, the rotor's inertia ``armature`` and friction that
grows, model by model (``m1`` to ``m6``), with speed, standstill (Stribeck) and load. The line
that is made of it runs from the torque that breaks away from rest to the speed that is left
without load, so that it lies below the identified curve.

Source: Duclusaud, Passault, Padois, Ly: Extended Friction Models for the Physics Simulation of
Servo Actuators (2024), models M1 to M6; the program of the same authors (github.com/Rhoban/bam).
"""

from __future__ import annotations

import json
from math import sqrt
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from thesis_pin.errors import BadInput
from thesis_pin.model.specification import Positive, validate
from thesis_pin.sizing.actuator import Actuator

Friction = Annotated[float, Field(ge=0)]


class Identified(BaseModel):
    """What such a file says of a servo, at its output; what isn't there is zero."""

    model_config = ConfigDict(extra="allow", frozen=True, allow_inf_nan=False)

    actuator: str
    model: str
    kt: Positive
    R: Positive
    armature: Friction = 0.0
    friction_base: Friction = 0.0
    friction_viscous: Friction = 0.0
    friction_stribeck: Friction = 0.0
    load_friction_base: Friction = 0.0
    load_friction_stribeck: Friction = 0.0
    load_friction_motor: Friction = 0.0
    load_friction_external: Friction = 0.0
    load_friction_motor_stribeck: Friction = 0.0
    load_friction_external_stribeck: Friction = 0.0
    load_friction_external_quad: Friction = 0.0

    def line(self, voltage: float) -> tuple[float, float]:
        """Torque that breaks away from rest [N·m], and speed without load [rad/s].

        Args:
            voltage: At the winding [V].
        """
        push = self.kt * voltage / self.R
        # Friction from the load's side and from the motor's: of what pushes and what is pushed.
        pushing, pushed = (
            self.load_friction_base + own
            for own in (self.load_friction_motor, self.load_friction_external)
        )
        free = push * (1 - pushing) - self.friction_base
        slope = self.kt**2 / self.R * (1 - pushing) + self.friction_viscous
        pushing += self.load_friction_stribeck + self.load_friction_motor_stribeck
        pushed += self.load_friction_stribeck + self.load_friction_external_stribeck
        left = push * (1 - pushing) - self.friction_base - self.friction_stribeck
        linear, square = 1 + pushed, self.load_friction_external_quad
        # linear·τ + square·τ² = left, in the form that also holds for square = 0.
        torque = 2 * left / (linear + sqrt(linear**2 + 4 * square * left)) if left > 0 else 0.0
        return torque, free / slope


def read_identified(text: str, where: str, voltage: float | None) -> Actuator:
    """The actuator that a file describes.

    Args:
        text: The file's text.
        where: Its name, for messages.
        voltage: At which it is used [V].

    Raises:
        BadInput: It isn't JSON, no voltage is given, or its friction holds it at that.
        SpecificationError: A parameter is missing or none.
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise BadInput(f"the list isn't valid JSON: {error}", where=where) from None
    servo = validate("identified servo", Identified, data, where=where)
    if voltage is None:
        raise BadInput(
            "it holds a servo's resistance and torque constant, and its line needs a voltage",
            where=where,
            remedy="Give the voltage (--voltage)",
        )
    torque, speed = servo.line(voltage)
    if not (torque > 0 and speed > 0):
        raise BadInput(f"at {voltage:g} V its friction holds it", where=where, allowed="more")
    return Actuator(
        f"{servo.actuator} ({servo.model})",
        torque,
        speed,
        voltage=voltage,
        reflected=servo.armature,
        notes=(
            "its line is worked out from identified parameters, after the friction of its gear; "
            "limits of current aren't among them",
        ),
        where=where,
    )
