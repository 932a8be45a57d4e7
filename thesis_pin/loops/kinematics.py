"""Kinematics of any robot with closed loops: residuals, mobility, closing, following.

Every function takes one configuration or a stack: q ``(..., nq)``, v ``(..., nv)``.
The loops' residual and Jacobian are in the axes of each loop's first frame, and
the residual is the second frame seen from the first. Forces are in
:mod:`thesis_pin.loops.dynamics`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike, NDArray

from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import Closing as Closing
from thesis_pin.loops.configurations.closing import close as close
from thesis_pin.loops.configurations.closing import close_each as close_each
from thesis_pin.loops.configurations.following import Following as Following
from thesis_pin.loops.configurations.following import follow as follow
from thesis_pin.loops.configurations.following import follow_each as follow_each
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.system.equations import Poses
from thesis_pin.loops.system.idle import IdleGroup
from thesis_pin.loops.system.rows import WELD
from thesis_pin.numeric.arrays import finite_array, together, vector
from thesis_pin.numeric.checks import instance

Array = NDArray[np.float64]


def residual(robot: ClosedRobot, q: ArrayLike) -> Array:
    """Opening of the loops [m], [rad], shape ``(..., equations)``; zero when closed.

    Of a loop first the forbidden shifts, then the forbidden turns: for welds (6d) the
    logarithm of the placement, for hinges the least turn that makes the axes parallel. Of
    a rod the distance beyond its length, of a coupling what its equation is off by.
    """
    q, stack = _stack(robot, q)
    poses = robot.system.poses(robot.model.createData(), q)
    return _opening(robot, poses).reshape(*stack, -1)


def jacobian(robot: ClosedRobot, q: ArrayLike) -> Array:
    """Constraint Jacobian, shape ``(..., equations, nv)``: d residual / dq for closed loops.

    For shifts (3d) that holds in open configurations too; for turns (6d, hinges) the
    rows are the relative twist, which is d residual only where the loop is closed.
    """
    q, stack = _stack(robot, q)
    found = robot.system.jacobian(robot.system.poses(robot.model.createData(), q))
    return found.reshape(*stack, *found.shape[1:])


def residual_derivative(robot: ClosedRobot, q: ArrayLike) -> Array:
    """d residual / dq, in open configurations too, shape ``(..., equations, nv)``.

    The same as :func:`jacobian` but for open welds, whose rows are the relative twist; of
    hinges and universal joints only in closed configurations.
    """
    q, stack = _stack(robot, q)
    poses = robot.system.poses(robot.model.createData(), q)
    found = _opening_derivative(robot, poses)
    return found.reshape(*stack, *found.shape[1:])


def linearized(robot: ClosedRobot, data: pin.Data, q: Array) -> tuple[Array, Array]:
    """:func:`residual` and :func:`residual_derivative` at one configuration ``(nq,)``.

    For searches, which would spend their time on making Pinocchio's data anew.
    """
    poses = robot.system.poses(data, q[None])
    return _opening(robot, poses)[0], _opening_derivative(robot, poses)[0]


def _opening(robot: ClosedRobot, poses: Poses) -> Array:
    """The residual at poses, shape ``(samples, equations)``."""
    found = robot.system.gap(poses)
    for rows, placements in _welds(robot, poses):
        found[:, rows] = [pin.log6(place).vector for place in placements]
    return found


def _opening_derivative(robot: ClosedRobot, poses: Poses) -> Array:
    """Its derivative, shape ``(samples, equations, nv)``."""
    found = robot.system.jacobian(poses)
    for rows, placements in _welds(robot, poses):
        for sample, place in enumerate(placements):
            turned = np.kron(np.eye(2), place.rotation.T)  # log6 is derived in the second's axes
            found[sample, rows] = pin.Jlog6(place) @ turned @ found[sample, rows]
    return found


def _welds(robot: ClosedRobot, poses: Poses) -> Iterator[tuple[slice, list[pin.SE3]]]:
    """Rows of each weld, and its second frame seen from the first, sample by sample."""
    for k, (loop, rows) in enumerate(zip(robot.loops, robot.system.rows, strict=True)):
        if loop.rows == WELD:
            ends = zip(poses.turns[:, :, k], poses.points[:, :, k], strict=True)
            yield (
                rows,
                [pin.SE3(t[0], p[0]).actInv(pin.SE3(t[1], p[1])) for t, p in ends],
            )


def drift(robot: ClosedRobot, q: ArrayLike, v: ArrayLike) -> Array:
    """Ȧ v of closed loops, shape ``(..., equations)``: their acceleration at v̇ = 0."""
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    given = together(q=finite_array("q", q, model.nq), v=finite_array("v", v, model.nv))
    (q, stack), v = _stack(robot, given[0]), given[1].reshape(-1, model.nv)
    poses = robot.system.poses(model.createData(), q, v)
    return robot.system.drift(poses, v).reshape(*stack, -1)


def _stack(robot: ClosedRobot, q: ArrayLike) -> tuple[Array, tuple[int, ...]]:
    """Configurations in one row, and the shape of their stack."""
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    q = finite_array("q", q, model.nq)
    if not q.size:
        raise BadInput("the stack is empty", allowed="at least one sample")
    return q.reshape(-1, model.nq), q.shape[:-1]


@dataclass(frozen=True)
class Mobility:
    """Freedom of a configuration, by counting and by rank.

    Attributes:
        equations: Number of loop equations.
        independent: How many of them are independent here.
        counted: Degrees of freedom if all were (Chebyshev–Grübler–Kutzbach).
        freedom: Degrees of freedom by rank; 0 if it moves only infinitesimally.
        motors: Number of motors.
        held: Degrees of freedom that the motors hold here; less than ``freedom`` where
            something moves while they stand still.
        condition: Largest over smallest scaled singular value of the independent equations.
        base: How many of the freedoms are a free flyer's, which no motor holds.
        moves: Whether it moves further than infinitesimally, or is a structure.
        noise: How far the file's digits let dependent equations differ [rad].
        weakest: Scaled singular value of the weakest independent equation [rad].
        idle: Motions that no motor holds, base aside.
        elsewhere: Number of equations that are independent at generic poses of the assembly;
            more than ``independent`` where branches cross, which the dynamics refuse.
    """

    equations: int
    independent: int
    counted: int
    freedom: int
    motors: int
    held: int
    condition: float
    base: int = 0
    moves: bool = True
    noise: float = 0.0
    weakest: float = 1.0
    idle: tuple[IdleGroup, ...] = ()
    elsewhere: int = 0

    @property
    def by_tolerance(self) -> bool:
        """Whether it moves only because equations that differ a little count as equal."""
        return self.noise > 1e-6 and self.freedom > 0


def mobility(robot: ClosedRobot, q: ArrayLike, *, precision: float | None = None) -> Mobility:
    """Degrees of freedom at one closed configuration ``(nq,)``.

    Args:
        robot: The robot.
        q: The configuration, shape ``(nq,)``.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Raises:
        Unreachable: The loops can't be closed near q.
        ModelError: Nobody can tell whether some equation is real.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    q = vector("q", q, model.nq)
    survey, scale = surveyed(robot, q, precision), robot.scale
    matrix = scale.rows[:, None] * jacobian(robot, q) * scale.columns
    parts = robot.system.parts()
    _, values, rows = parts.svd(matrix)
    rank = int((values > 10 * survey.noise).sum())
    driven = np.linalg.svd(parts.complement(rows[:rank])[robot.actuated], compute_uv=False)
    return Mobility(
        equations=robot.equations,
        independent=rank,
        counted=model.nv - robot.equations,
        freedom=model.nv - rank if survey.moves else 0,
        motors=len(robot.actuators),
        held=int((driven > 10 * survey.noise).sum()) if survey.moves else 0,
        condition=float(values[0] / values[rank - 1]) if rank else 1.0,
        base=len(robot.base),
        moves=survey.moves,
        noise=survey.noise,
        weakest=float(values[rank - 1]) if rank else 1.0,
        idle=survey.idle,
        elsewhere=survey.rank,
    )
