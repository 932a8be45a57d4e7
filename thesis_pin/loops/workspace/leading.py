"""A robot led over a grid: where its joints and base stand in a cell, and how they move there."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import SingularPose
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.chaining import place
from thesis_pin.loops.configurations.closing import close_stack, motor_positions
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import COORDINATES, Tool
from thesis_pin.loops.motion.tool import inverted, lifted, refuse_redundant, tool_view
from thesis_pin.loops.motion.turned import pose_told
from thesis_pin.loops.motion.whole import driven_by
from thesis_pin.loops.system.newton import CUT, settle
from thesis_pin.loops.system.survey import Survey
from thesis_pin.loops.workspace.grid import Grid
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Cells = NDArray[np.bool_]

_ITERATIONS = 12  # Newton steps from a neighbour, of which four are the rule
_OUTSIDE = 1e-7  # share of a column outside the space that equations span which is rounding
_MANY = 60  # Newton steps on the way from the pose, which may be singular

_MORE = "Name more with --along or --at"


class Led:
    """A robot, or one seen from a frame, whose led coordinates are those of a grid.

    Args:
        robot: The robot.
        grid: What leads it.
        pose: A closed configuration, shape ``(nq,)``.
        precision: What counts as dependent.

    Attributes:
        view: The robot whose motors and base are what is led.
        still: Motors that nothing leads: they stay at the pose.
        start: Values of the axes at the pose, shape ``(axes,)``.
        q: The pose as a configuration of the view.

    Raises:
        SingularPose: What is led doesn't determine the other joints.
    """

    def __init__(
        self, robot: ClosedRobot, grid: Grid, pose: Array, precision: float | None
    ) -> None:
        self.grid, self.robot, self._precision = grid, robot, precision
        self.tool = Tool(grid.frame, grid.told) if grid.frame and grid.told else None
        motors = robot.actuators or tuple(singles(robot.model))
        alone = self.tool is not None or not set(grid.joints) <= set(motors)
        self.still = () if alone else tuple(name for name in motors if name not in grid.joints)
        if self.tool is not None:
            self.view = tool_view(robot, self.tool, grid.joints, pose)
            self.still = self.view.actuators[len(grid.joints) :]
        else:
            self.view = driven_by(robot, (*grid.joints, *self.still))
        self.q = lifted(self.view, pose[None])[0]
        self._data = self.view.model.createData()
        here = motor_positions(self.view, self.q)
        own = dict(zip(self.view.actuators, here.tolist(), strict=True))
        self._fixed = own | dict(grid.held)
        self._there = np.zeros(6)
        if self.tool is not None:
            told = pose_told(robot, self.tool, pose)
            self._there[:3] = told[:3]
            self._there[3:] = _angles(told[3:], self.tool)
            self.q[:7] = inverted(self.tool, told[None], *np.zeros((2, 1, 7)))[0][0]
        own |= dict(zip(COORDINATES, self._there.tolist(), strict=True)) if self.tool else {}
        self.start = np.array([own[axis.name] for axis in grid.axes])
        self.survey: Survey = surveyed(self.view, self.q, precision)
        if self.tool is not None:
            refuse_redundant(robot, self.view, self.q, precision, _MORE)
        if heavy := [group for group in self.survey.idle if not group.light]:
            names = "; ".join(dict.fromkeys(", ".join(group.joints[:6]) for group in heavy))
            raise SingularPose(
                f"what leads doesn't determine the other joints: {names} move meanwhile",
                remedy=_MORE,
            )
        matrix = self.view.system.jacobian(self.view.system.poses(self._data, self.q[None]))[0]
        scaled = self.view.scale.rows[:, None] * matrix * self.view.scale.columns
        self._range = np.linalg.svd(scaled)[0][:, : self.survey.rank]

    def way(self, steps: int, target: Array) -> Array:
        """Everything that leads, from the pose to a cell: ``(steps, names)``, the pose left out."""
        order = self.grid.names
        start = np.array([self._own(name) for name in order])
        end = np.array([*target, *(self.grid.held[name] for name in self.grid.held)])
        shares = np.arange(1, steps + 1)[:, None] / steps
        return np.asarray(start + shares * (end - start))

    def _own(self, name: str) -> float:
        """Where something that leads is at the pose."""
        if self.tool is not None and name in self.tool.told:
            return float(self._there[COORDINATES.index(name)])
        position = motor_positions(self.view, self.q)
        return float(position[self.view.actuators.index(name)])

    def placed(self, q: Array, values: Array, held: bool = True) -> Array:
        """Configurations ``(n, nq)`` with what leads them where it is told to be.

        Args:
            q: They, else.
            values: Of the axes, ``(n, axes)``; with ``held`` false of everything that leads.
            held: Whether the rest stands where the grid holds it.
        """
        names = self.grid.names if not held else tuple(axis.name for axis in self.grid.axes)
        each = dict(zip(names, values.T, strict=True))
        count = len(q)
        motors = np.empty((count, len(self.view.actuators)))
        for k, name in enumerate(self.view.actuators):
            motors[:, k] = each[name] if name in each else self._fixed[name]
        base = np.tile(q[:1, :7], (count, 1))
        if self.tool is not None:
            there = np.tile(self._there, (count, 1))
            for k, name in enumerate(COORDINATES):
                if name in self.grid.held and held:
                    there[:, k] = self.grid.held[name]
                if name in each and name in self.tool.told:
                    there[:, k] = each[name]
            base = self._base(there)
        return place(self.view, q, motors, base)

    def _base(self, there: Array) -> Array:
        """Poses of the base for coordinates of the frame ``(n, 6)``."""
        assert self.tool is not None
        value = np.zeros((len(there), 7))
        value[:, :3] = there[:, :3]
        turns = [pin.Quaternion(pin.rpy.rpyToMatrix(angles)).coeffs() for angles in there[:, 3:]]
        value[:, 3:] = turns
        return inverted(self.tool, value, *np.zeros((2, len(there), 7)))[0]

    def velocities(self, q: Array, values: Array) -> Array:
        """How the view moves per unit of each axis, passive joints at rest: ``(n, nv, axes)``."""
        result = np.zeros((len(q), self.view.model.nv, len(self.grid.axes)))
        for k, axis in enumerate(self.grid.axes):
            if self.tool is None or axis.name not in self.tool.told:
                result[:, self.view.actuated[self.view.actuators.index(axis.name)], k] = 1.0
                continue
            number = COORDINATES.index(axis.name)
            if number < 3:
                result[:, number, k] = -1.0
                continue
            there = np.tile(self._there, (len(q), 1))
            for j, name in enumerate(COORDINATES):
                there[:, j] = self.grid.held.get(name, self._there[j])
            for j, one in enumerate(self.grid.axes):
                if one.name in self.tool.told:
                    there[:, COORDINATES.index(one.name)] = values[:, j]
            spin = _spin(there[:, 3:], number - 3)
            result[:, :3, k] = np.cross(spin, there[:, :3])
            result[:, 3:6, k] = -spin
        return result

    def patiently(self, q: Array) -> tuple[Array, bool]:
        """A placed configuration ``(nq,)`` closed by many steps, and whether it is."""
        found, reasons = close_stack(
            self.view, self._data, q[None], self.view.passive, _MANY, self._precision
        )
        return found.q[0], not reasons[0]

    def closed(self, q: Array) -> tuple[Array, Cells]:
        """Steps of the passive joints from placed configurations: where they end, which close."""
        view, survey = self.view, self.survey
        equations, scale, cut = view.system, view.scale, 10 * survey.noise
        found = settle(equations, scale, self._data, q, view.passive, CUT, _ITERATIONS)
        good = self._close(found.gap)
        todo = np.flatnonzero(~good & (found.scaled < CUT * 10))
        if todo.size:
            finer = settle(
                equations,
                scale,
                self._data,
                found.q[todo],
                view.passive,
                cut,
                _ITERATIONS,
                survey.passive_rank,
            )
            found.replace(todo, finer, self._close(finer.gap))
            good = self._close(found.gap)
        return found.q, good

    def _close(self, gap: Array) -> Cells:
        scaled = np.abs(self.view.scale.rows * gap).max(axis=1, initial=0.0)
        wide = np.abs(gap).max(axis=1, initial=0.0)
        return np.asarray((wide <= TOLERANCES.loop_closure) | (scaled <= self.survey.threshold))

    def tangents(self, q: Array, values: Array) -> tuple[Array, Cells, Array]:
        """How all joints move per unit of each axis at closed configurations.

        Returns:
            Shape ``(n, nv, axes)``; whether what leads determines it; a sign that changes where
            it doesn't, 0 where nobody knows, each ``(n,)``.
        """
        view, scale, passive = self.view, self.view.scale, self.view.passive
        moving = self.velocities(q, values)
        if not len(passive):
            return moving, np.ones(len(q), dtype=bool), np.ones(len(q))
        columns = scale.columns[passive]
        matrices = scale.rows[:, None] * view.system.jacobian(view.system.poses(self._data, q))
        own = matrices[:, :, passive] * columns
        cut = max(10 * self.survey.noise, TOLERANCES.determined)
        inverse, kept = view.system.parts(passive).pseudo_inverses(own, cut)
        moving[:, passive] = -columns[:, None] * (inverse @ (matrices @ moving))
        return moving, kept >= self.survey.passive_rank, self._signs(own)

    def without_idle(self, q: Array, moved: Array) -> Array:
        """Scaled motions of the passive joints ``(passive,)`` without those that nothing holds."""
        if not self.survey.idle:
            return moved
        passive = self.view.passive
        matrix = self.view.system.jacobian(self.view.system.poses(self._data, q[None]))[0]
        own = self.view.scale.rows[:, None] * matrix[:, passive] * self.view.scale.columns[passive]
        held = np.linalg.svd(own, full_matrices=False)[2][: self.survey.passive_rank]
        return np.asarray(held.T @ (held @ moved))

    def _signs(self, own: Array) -> Array:
        """The sign of the passive columns' determinant, in the space that the equations span.

        Of planar linkages, which have dependent equations, that space is the same everywhere;
        where it isn't, there is no sign.
        """
        sign = np.zeros(len(own))
        if self._range.shape[1] == own.shape[2]:
            inside = self._range.T @ own
            size = np.abs(own).max(axis=(1, 2))
            left = np.abs(own - self._range @ inside).max(axis=(1, 2))
            known = left <= max(self.survey.threshold, _OUTSIDE) * size
            sign[known] = np.linalg.slogdet(inside[known])[0]
        return sign


def _angles(turn: Array, tool: Tool) -> Array:
    """Roll, pitch and yaw of the quaternion of what is told of a frame."""
    alone = [k for k in range(3) if tool.rows[3 + k]]
    if len(alone) == 1:
        found = np.zeros(3)
        found[alone] = 2 * np.arctan2(turn[alone], turn[3])
        return found
    return np.asarray(pin.rpy.matrixToRpy(pin.Quaternion(*turn[[3, 0, 1, 2]]).matrix()))


def _spin(angles: Array, axis: int) -> Array:
    """ω per rate of roll, pitch or yaw at angles ``(n, 3)``: ``(n, 3)``."""
    pitch, yaw = angles[:, 1], angles[:, 2]
    zero = np.zeros(len(angles))
    if axis == 2:
        return np.column_stack([zero, zero, zero + 1.0])
    if axis == 1:
        return np.column_stack([-np.sin(yaw), np.cos(yaw), zero])
    return np.column_stack(
        [np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), -np.sin(pitch)]
    )
