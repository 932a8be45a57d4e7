"""What a path asks of Pollard anywhere along it, whatever the timing.

Along a path the joints' rates are q′ ṡ and their accelerations q′ s̈ + q″ ṡ², so that torques and
ball-joint forces are a s̈ + b ṡ² + d: three evaluations of inverse dynamics at a place give a, b
and d.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pollard_pin.coordinates import pose_from_placement
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.kinematics.geometry import Branch
from pollard_pin.kinematics.rates import stack_rates
from pollard_pin.model import Pollard
from pollard_pin.motion.chain import Chain
from pollard_pin.specification import ACTUATORS
from thesis_pin.display.brief import Brief
from thesis_pin.timing.rows import Array
from thesis_pin.timing.track import Values


@dataclass(frozen=True, eq=False)
class PathTrack(Brief):
    """The geometry of a path on a robot; see :class:`thesis_pin.timing.track.Track`.

    Attributes:
        robot: The robot.
        branch: The solution of inverse kinematics.
        chain: The geometry.
    """

    robot: Pollard
    branch: Branch
    chain: Chain

    @property
    def ends(self) -> Array:
        """Where pieces begin and end, ``(pieces + 1,)``."""
        return self.chain.ends

    @property
    def stops(self) -> NDArray[np.bool_]:
        """At which of these the motion has to rest, the same shape."""
        return self.chain.stops

    def values(self, piece: int, at: Array) -> Values:
        """Torques, speeds and ball-joint forces over ṡ and s̈ at places of a piece."""
        robot = self.robot
        tool, near = self.chain.piece(piece, at)
        pose = pose_from_placement(tool.position, tool.rotation, near)
        solutions = robot.inverse_kinematics(pose, self.branch).require("place on the path")
        posture, q = solutions.posture, solutions.angles
        v, a = stack_rates(robot.geometry, q, tool)
        none = np.zeros_like(v)
        rest, pushed, passing = (
            inverse_dynamics_at(robot, q, rate, bend, posture)
            for rate, bend in ((none, none), (none, v), (v, a))
        )
        effort = (pushed.torque - rest.torque, passing.torque - rest.torque, rest.torque)
        force = (
            pushed.loop_force - rest.loop_force,
            passing.loop_force - rest.loop_force,
            rest.loop_force,
        )
        motors = list(ACTUATORS)
        return Values(
            np.stack(effort, axis=1),
            v[:, motors],
            a[:, motors],
            np.stack(force, axis=1),
            tool.velocity,
            tool.acceleration,
        )
