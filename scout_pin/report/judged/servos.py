"""Which servo drives which joints, and what it gives: each servo by itself."""

from __future__ import annotations

from scout_pin.specification import SIDES, Specification


def servo_limits(specification: Specification) -> list[str]:
    """One clause a servo in use: its limits, and the joints that it drives."""
    used = [name for side in SIDES for name in specification.leg(side).servos]
    clauses = []
    for name in dict.fromkeys(used):
        servo = specification.actuator(name)
        said = f"{name} {servo.stall_torque:g} N·m, {servo.no_load_speed:g} rad/s"
        if servo.armature:
            said += f", rotor {servo.armature:.3g} kg·m² at the joint"
        joints = specification.driven_by(name)
        if len(joints) < len(used):
            said += f" ({', '.join(joints)})"
        clauses.append(said)
    return clauses
