"""The neutral pose: whether the soles are level in it, and which angles would make them so."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from scout_pin.kinematics.forward import leg_forward_kinematics, leg_frames
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.specification import SIDES, Specification
from thesis_pin.numeric.arrays import wrap
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class Tilt:
    """A sole that isn't level with the torso in the neutral pose.

    Attributes:
        side: Of the leg.
        angle: Between the sole's normal and the torso's [rad].
        level: β_5 and β_6 that make it level [rad]; None if no such angles do.
    """

    side: str
    angle: float
    level: tuple[float, float] | None

    def sentence(self, beta: np.ndarray) -> str:
        """What is wrong, and what would mend it; ``beta`` are β_1 … β_6 [rad]."""
        text = (
            f"the {self.side} sole is tilted by {np.degrees(self.angle):.3g}° in the neutral pose"
        )
        if self.level is None:
            return f"{text}, and no β_5 and β_6 make it level: check β_1 to β_4, β_7 and β_8"
        changes = [
            f"β_{k + 1} = {_degrees(new)}° instead of {_degrees(float(beta[k]))}° "
            f"(legs.{self.side}.beta_deg, number {k + 1})"
            for k, new in zip((4, 5), self.level, strict=True)
            if abs(float(wrap(np.array(new - beta[k])))) > TOLERANCES.sole_tilt / 10
        ]
        return f"{text}; {' and '.join(changes)} would make it level"


def tilts(specification: Specification) -> list[Tilt]:
    """Soles that aren't level in the neutral pose; none where ``neutral_soles`` is ``tilted``."""
    if specification.neutral_soles == "tilted":
        return []
    found = []
    for side in SIDES:
        leg = LegGeometry.of(specification, side)
        normal = leg_forward_kinematics(leg, np.zeros(6))[:3, 2]
        angle = float(np.arctan2(np.hypot(normal[0], normal[1]), normal[2]))
        if angle > TOLERANCES.sole_tilt:
            found.append(Tilt(side, angle, _level(leg)))
    return found


def _level(leg: LegGeometry) -> tuple[float, float] | None:
    """β_5 and β_6 nearest to the leg's own with which the sole is level.

    Along e the sole's normal has s6 g_2 + c6 g_3, g its components in the foot link; that
    has to be e's own height. Then γ_5 turns it upright in the plane.
    """
    frames = leg_frames(leg, np.zeros((1, 6)))
    e, j3 = frames.axes[2, :, 0], frames.axes[1, :, 0]
    i3 = np.cross(j3, e)
    g = leg.foot[:, 2]
    size, phase = float(np.hypot(g[1], g[2])), float(np.arctan2(g[2], g[1]))
    if size < abs(e[2]):
        return None
    turn = float(np.arcsin(e[2] / size)) if size > 0.0 else 0.0
    choices = []
    for six in (turn - phase, np.pi - turn - phase):
        across = np.cos(six) * g[1] - np.sin(six) * g[2]
        five = np.arctan2(j3[2], i3[2]) - np.arctan2(across, g[0]) - leg.beta[2] - leg.beta[3]
        change = np.abs(wrap(np.array([five - leg.beta[4], six - leg.beta[5]])))
        choices.append((float(change.max()), float(five), float(six)))
    _, five, six = min(choices)
    return five, six


def _degrees(angle: float) -> str:
    return f"{round(np.degrees(angle) % 360.0, 3) % 360.0:g}"
