"""What the kinematics of a leg need of its specification."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from scout_pin.kinematics.signs import SUMMANDS, angle_sums
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import rotation
from thesis_pin.numeric.turns import need_turns
from thesis_pin.tolerances import TOLERANCES


@dataclass(frozen=True)
class LegGeometry(Brief):
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

    @property
    def forward_part(self) -> float:
        """Component of joint 6's axis along the sole's y, to the toes."""
        return float(self.foot[0, 1])

    @cached_property
    def heelwards(self) -> bool:
        """Whether the axis of joint 6 points to the heel, against the sole's y."""
        return self.forward_part < 0.0

    @cached_property
    def neutral_axis(self) -> tuple[float, float, float]:
        """Axis e of joint 3 in the neutral pose, in the torso's axes."""
        (c1, c2), (s1, s2) = np.cos(self.beta[:2]).tolist(), np.sin(self.beta[:2]).tolist()
        return c1 * s2, s1 * s2, c2

    @cached_property
    def ankle_arm(self) -> tuple[float, float, float]:
        """From p5 to the sole in the sole's axes [m]."""
        x, y, z = (self.foot[1] * self.y_6 + self.foot[0] * self.x_5).tolist()
        return x, y, z

    @cached_property
    def foot_map(self) -> np.ndarray:
        """What the closed form needs of a placement P torso to sole, as P @ foot_map, ``(4, 4)``.

        Its columns are −j11, k11, p5 and a, the sole's placement being an array ``(4, 4)``.
        """
        a, j, k = self.foot
        columns = np.zeros((4, 4))
        columns[:3] = np.stack([-j, k, -self.y_6 * j - self.x_5 * a, a], axis=1)
        columns[3, 2] = 1.0
        return columns

    @cached_property
    def foot_maps(self) -> np.ndarray:
        """:attr:`foot_map` for placements whose twelve entries are rows of an array, ``(12, 12)``.

        Gives the components of −j11, then of k11, p5 and a.
        """
        maps: np.ndarray = np.einsum("rq,cd->qcdr", self.foot_map, np.eye(3)).reshape(12, 12)
        return maps

    @cached_property
    def betas(self) -> tuple[float, ...]:
        """:attr:`beta` as floats in (−π, π]."""
        return tuple(wrap(self.beta).tolist())

    @cached_property
    def bounds(self) -> tuple[tuple[float, float, float], ...]:
        """Of each joint β in (−π, π], lower and upper limit with their tolerance, floats [rad]."""
        rows = (
            wrap(self.beta),
            self.lower - TOLERANCES.joint_limit,
            self.upper + TOLERANCES.joint_limit,
        )
        return tuple((beta, lower, upper) for beta, lower, upper in np.transpose(rows).tolist())

    @cached_property
    def sums(self) -> np.ndarray:
        """θ − π of all branches as sums of a pose's angles, ``(13, 48)``: :mod:`signs`."""
        return angle_sums(self.beta).reshape(SUMMANDS, 48)
