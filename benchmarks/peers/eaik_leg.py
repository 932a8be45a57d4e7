"""EAIK on Scout's leg."""

from __future__ import annotations

import numpy as np

from scout_pin.kinematics.geometry import LegGeometry


class Eaik:
    """EAIK on Scout's leg: batches, single poses, and its answers as angles of the leg.

    Its zero configuration is γ = 0, all frames parallel.
    """

    def __init__(self, leg: LegGeometry, poses: np.ndarray) -> None:
        from eaik.IK_HP import HPRobot

        letters = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}
        axes = np.array([letters[a] for a in "zyzzzx"])
        origins = np.array(
            [[leg.x_0, 0, 0], [0, 0, -leg.z_1], [leg.x_2, 0, 0], [leg.x_3, 0, 0],
             [leg.x_4, 0, 0], [leg.x_5, 0, 0], [0, leg.y_6, 0]]
        )  # fmt: skip
        self.leg, self.robot = leg, HPRobot(axes, origins)
        self.targets = poses.copy()
        self.targets[:, :3, :3] = poses[:, :3, :3] @ leg.foot.T

    def batched(self) -> object:
        """All poses in one call."""
        return self.robot.IK_batched(self.targets)

    def single(self) -> object:
        """The first pose."""
        return self.robot.IK(self.targets[0])

    def angles(self, number: int) -> np.ndarray:
        """Every solution of one pose, ``(k, 6)``; its least-squares answers reach nothing."""
        found = self.robot.IK(self.targets[number])
        exact = ~np.array(found.is_LS, dtype=bool)
        return np.array(found.Q)[exact] - self.leg.beta
