"""What the kinematics of a leg need of its specification."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.turns import need_turns


@dataclass(frozen=True)
class LegGeometry:
    """The lengths and angles of one leg that its kinematics need.

    Attributes:
        x_0: Signed lateral place of the hip [m]; negative on the left.
        z_1, x_2, x_3, x_4, x_5, y_6: Lengths [m], appendix B.2.
        beta: Constant angles β_1 … β_6 [rad], shape ``(6,)``, appendix B.3.
        foot: Rotation from the foot link to the sole, Rz(β_7) Ry(β_8).
        lower, upper: Joint limits [rad], shape ``(6,)``.
        names: Joint names.
    """

    x_0: float
    z_1: float
    x_2: float
    x_3: float
    x_4: float
    x_5: float
    y_6: float
    beta: np.ndarray
    foot: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    names: tuple[str, ...]

    @classmethod
    def of(cls, specification: Specification, side: str) -> LegGeometry:
        """Geometry of the ``"left"`` or ``"right"`` leg of a specification."""
        leg, number = specification.leg(side), SIDES.index(side)
        lower, upper = specification.assumptions.joint_range.radians()
        mine = slice(6 * number, 6 * number + 6)
        return cls(
            x_0=(-1.0, 1.0)[number] * leg.x_0,
            z_1=leg.z_1,
            x_2=leg.x_2,
            x_3=leg.x_3,
            x_4=leg.x_4,
            x_5=leg.x_5,
            y_6=leg.y_6,
            beta=np.radians(leg.beta_deg),
            foot=rotation("z", np.radians(leg.beta_7_deg))
            @ rotation("y", np.radians(leg.beta_8_deg)),
            lower=lower[mine],
            upper=upper[mine],
            names=JOINT_NAMES[mine],
        )

    @cached_property
    def turned(self) -> bool:
        """Whether limits hold some angles only whole turns from (−π, π]."""
        return need_turns(self.lower, self.upper)

    @cached_property
    def foot_rows(self) -> list[list[float]]:
        """The first two rows of :attr:`foot`: axes of the foot link, seen from the sole."""
        rows: list[list[float]] = self.foot[:2].tolist()
        return rows

    @property
    def heelwards(self) -> bool:
        """Whether the axis of joint 6 points to the heel, against the sole's y."""
        return self.foot_rows[0][1] < 0.0
