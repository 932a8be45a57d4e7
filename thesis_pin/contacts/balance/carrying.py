"""What motors, the base and joints that nothing holds get of a load, through closed loops.

Everything is linear in the load: motors' torques and the base's wrench are those of
:mod:`thesis_pin.loops.system.solve`, for a motion's own load and for a unit of each contact force.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.forces.loads import open_tree_forces
from thesis_pin.loops.forces.wrenches import base_wrenches
from thesis_pin.loops.system.solve import solve
from thesis_pin.loops.system.survey import Survey

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Carried:
    """Shares of loads.

    Attributes:
        motors: Of each motor [N·m] or [N], shape ``(n, motors, loads)``.
        idle: What neither motors nor loops carry, of all other joints, ``(n, passive, loads)``.
    """

    motors: Array
    idle: Array


class Carrying:
    """The shares of a robot at some configurations.

    Args:
        robot: The robot.
        q: Closed configurations, shape ``(n, nq)``.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
    """

    def __init__(self, robot: ClosedRobot, q: Array, precision: float | None = None) -> None:
        self.robot, self.q = robot, q
        self.data = robot.model.createData()
        self.survey: Survey | None = None
        if robot.equations:
            self.survey = surveyed(robot, q[0], precision)
            self.matrices = robot.system.jacobian(robot.system.poses(self.data, q))

    def forces(self, v: Array, a: Array, sliding: Array | None = None) -> tuple[Array, Array]:
        """What a motion needs without a floor.

        Args:
            v: Rates, shape ``(n, nv)``.
            a: Accelerations, same shape.
            sliding: See :func:`thesis_pin.loops.forces.loads.passive_forces`.

        Returns:
            Generalized forces ``(n, nv)``; and the wrench on the root about its origin, world
            axes [N], [N·m], ``(n, 6)``.
        """
        tau = open_tree_forces(self.robot, self.data, self.q, v, a, sliding)
        return tau, base_wrenches(self.robot, self.q, tau[:, self.robot.base])

    def shares(self, loads: Array, rows: NDArray[np.intp]) -> Carried:
        """Shares of loads ``(k, nv, loads)`` at some of the configurations ``(k,)``."""
        robot = self.robot
        if self.survey is None:
            return Carried(loads[:, robot.actuated], loads[:, robot.passive])
        count, _, many = loads.shape
        driven = np.concatenate([robot.actuated, robot.base])
        matrices = np.repeat(self.matrices[rows], many, axis=0)
        flat = np.swapaxes(loads, 1, 2).reshape(count * many, -1)
        solved = solve(self.survey, robot.scale, matrices, flat, driven, robot.passive)

        def back(values: Array) -> Array:
            return np.swapaxes(values.reshape(count, many, -1), 1, 2)

        return Carried(back(solved.driven[:, : len(robot.actuated)]), back(solved.rest))


def velocity_scale(robot: ClosedRobot) -> Array:
    """A length on motors that slide, 1 on those that turn: torques compare, ``(motors,)``."""
    return np.asarray(robot.scale.columns[robot.actuated])


def total_mass(robot: ClosedRobot) -> float:
    """Mass of the whole robot [kg]."""
    return float(pin.computeTotalMass(robot.model))
