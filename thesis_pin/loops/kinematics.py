"""Kinematics of any robot with closed loops: residuals, mobility, closing, following.

Every function takes one configuration or a stack: q ``(..., nq)``, v ``(..., nv)``.
The loops' residual and Jacobian are in the axes of each loop's first frame, and
the residual is the second frame seen from the first. Forces are in
:mod:`thesis_pin.loops.dynamics`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import ArrayLike

from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.numeric.arrays import finite_array, together, vector
from thesis_pin.numeric.checks import instance, whole
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.tolerances import TOLERANCES

_AXES = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def residual(robot: ClosedRobot, q: np.ndarray) -> np.ndarray:
    """Opening of the loops [m], [rad], shape ``(..., equations)``; zero when closed."""
    return each(robot, lambda q: constraints(robot, robot.model.createData(), q)[0], q=q)


def jacobian(robot: ClosedRobot, q: np.ndarray) -> np.ndarray:
    """Constraint Jacobian, shape ``(..., equations, nv)``: d residual / dq for closed loops.

    For ball joints (3d) that holds in open configurations too; for welds (6d) the
    rows are the relative twist, which is d residual only where the loop is closed.
    """
    return each(robot, lambda q: constraints(robot, robot.model.createData(), q)[1], q=q)


def residual_derivative(robot: ClosedRobot, q: np.ndarray) -> np.ndarray:
    """d residual / dq in open configurations too, shape ``(..., equations, nv)``.

    The same as :func:`jacobian` but for open welds, where Pinocchio's rows are the
    relative twist in the first frame's axes.
    """

    def one(q: np.ndarray) -> np.ndarray:
        gap, matrix, _ = constraints(robot, robot.model.createData(), q)
        return _derivative(robot, gap, matrix)

    return each(robot, one, q=q)


def drift(robot: ClosedRobot, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Ȧ v of closed loops, shape ``(..., equations)``: their acceleration at v̇ = 0."""
    return each(
        robot, lambda q, v: constraint_drift(robot, robot.model.createData(), q, v), q=q, v=v
    )


@dataclass(frozen=True)
class Mobility:
    """Freedom of a configuration, by counting and by rank.

    Attributes:
        equations: Number of loop equations.
        independent: How many of them are independent here.
        counted: Degrees of freedom if all were (Chebyshev–Grübler–Kutzbach).
        freedom: Degrees of freedom by rank.
        motors: Number of motors.
        held: Degrees of freedom that the motors hold here; less than ``freedom`` where
            something moves while they stand still.
        condition: Largest over smallest singular value of the independent equations.
    """

    equations: int
    independent: int
    counted: int
    freedom: int
    motors: int
    held: int
    condition: float


def mobility(robot: ClosedRobot, q: ArrayLike) -> Mobility:
    """Degrees of freedom at one configuration ``(nq,)``."""
    instance("robot", robot, ClosedRobot, "load()")
    _, values, rows = np.linalg.svd(jacobian(robot, vector("q", q, robot.model.nq)))
    rank = int((values > TOLERANCES.rank * values[0]).sum()) if values.size else 0
    nv = robot.model.nv
    driven = np.linalg.svd(rows[rank:, list(robot.actuated)], compute_uv=False)
    return Mobility(
        equations=robot.equations,
        independent=rank,
        counted=nv - robot.equations,
        freedom=nv - rank,
        motors=len(robot.actuators),
        held=int((driven > TOLERANCES.rank).sum()),
        condition=float(values[0] / values[rank - 1]) if rank else 1.0,
    )


def close(
    robot: ClosedRobot, guess: ArrayLike, motors: ArrayLike | None = None, *, iterations: int = 60
) -> np.ndarray:
    """Close the loops by Newton steps from a guess.

    Args:
        robot: The robot.
        guess: Configuration to start from, shape ``(..., nq)``; picks the assembly mode.
        motors: Positions of the motors, which then stay put, shape ``(..., motors)``;
            ``None`` lets every joint move.
        iterations: Most Newton steps.

    Returns:
        Closed configuration, shape ``(..., nq)``; its residual is below
        ``TOLERANCES.loop_closure`` and usually near 1e-15.

    Raises:
        Unreachable: The steps don't converge: no closed configuration near the guess.
    """
    iterations = whole("iterations", iterations, 1)
    if motors is None:
        return each(robot, lambda q: newton_close(robot, q, slice(None), iterations), guess=guess)

    def one(q: np.ndarray, positions: np.ndarray) -> np.ndarray:
        q = q.copy()
        q[robot.actuated_q] = positions
        return newton_close(robot, q, robot.passive, iterations)

    return each(robot, one, guess=guess, motors=motors)


def follow(
    robot: ClosedRobot,
    time: ArrayLike,
    motors: ArrayLike,
    rates: ArrayLike,
    accelerations: ArrayLike,
    guess: ArrayLike,
) -> JointTrajectory:
    """Motion of all joints from that of the motors.

    Args:
        robot: A robot with as many motors as degrees of freedom.
        time: Sample times [s], shape ``(n,)``.
        motors: Positions of the motors, shape ``(n, motors)``.
        rates: Their rates, same shape.
        accelerations: Their accelerations, same shape.
        guess: Configuration near the first sample, shape ``(nq,)``.

    Returns:
        Closed configurations, rates and accelerations; each sample starts from the
        one before, so the motion stays in one assembly mode.

    Raises:
        Unreachable: A sample can't be closed.
        SingularPose: The motors don't determine the passive joints at a sample.
    """
    instance("robot", robot, ClosedRobot, "load()")
    count, nv = len(robot.actuators), robot.model.nv
    motors, rates, accelerations = (
        finite_array(name, value, None, count)
        for name, value in (("motors", motors), ("rates", rates), ("accelerations", accelerations))
    )
    time = finite_array("time", time, None)
    shapes = [x.shape for x in (time, motors, rates, accelerations)]
    if shapes != [(len(time),), *[(len(time), count)] * 3] or not len(time):
        raise BadInput(
            f"time, motors, rates and accelerations have shapes {', '.join(map(str, shapes))}",
            allowed=f"(n,), then three times (n, {count}), n at least 1",
        )
    q, v, a = np.empty((len(motors), robot.model.nq)), *np.zeros((2, len(motors), nv))
    data, current = robot.model.createData(), vector("guess", guess, robot.model.nq)
    for k, positions in enumerate(motors):
        current = q[k] = close(robot, current, positions)
        matrix = constraints(robot, data, current)[1]
        passive = matrix[:, robot.passive]
        values = np.linalg.svd(passive, compute_uv=False)
        if len(robot.passive) > (values > TOLERANCES.rank * values[0]).sum():
            raise SingularPose("the motors don't determine the other joints", where=f"sample {k}")
        v[k, robot.actuated], a[k, robot.actuated] = rates[k], accelerations[k]
        v[k, robot.passive] = -np.linalg.lstsq(passive, matrix @ v[k])[0]
        known = constraint_drift(robot, data, current, v[k]) + matrix @ a[k]
        a[k, robot.passive] = -np.linalg.lstsq(passive, known)[0]
    return JointTrajectory(time, q, v, a)


def each(
    robot: ClosedRobot, function: Callable[..., np.ndarray], **vectors: ArrayLike
) -> np.ndarray:
    """Apply a function of single samples over broadcast stacks.

    Args:
        robot: The robot.
        function: Takes one sample of each vector, in their order.
        **vectors: ``q`` or ``guess`` ``(..., nq)``, ``v`` ``(..., nv)``, ``motors`` or
            ``torque`` ``(..., motors)``.

    Raises:
        BadInput: A vector has another size or isn't finite, stacks differ or are empty.
    """
    model = instance("robot", robot, ClosedRobot, "load()").model
    sizes = {"q": model.nq, "guess": model.nq, "v": model.nv}
    motors = len(robot.actuators)
    given = {name: finite_array(name, x, sizes.get(name, motors)) for name, x in vectors.items()}
    arrays = together(**given)
    stack = arrays[0].shape[:-1]
    flat = [x.reshape(-1, x.shape[-1]) for x in arrays]
    results = [function(*sample) for sample in zip(*flat, strict=True)]
    if not results:
        raise BadInput("the stack is empty", allowed="at least one sample")
    return np.stack(results).reshape(*stack, *np.shape(results[0]))


def constraints(
    robot: ClosedRobot, data: pin.Data, q: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Residual, Jacobian, and the rotation of each loop's first frame."""
    pin.computeJointJacobians(robot.model, data, q)
    gaps, rows = [np.empty(0)], [np.empty((0, robot.model.nv))]
    rotations = np.empty((len(robot.loops), 3, 3))
    for k, model in enumerate(robot.constraint_models):
        constraint = model.createData()
        model.calc(robot.model, data, constraint)
        gaps.append(np.array(constraint.constraint_position_error))
        rows.append(np.array(model.jacobian(robot.model, data, constraint)))
        rotations[k] = constraint.oMc1.rotation
    return np.concatenate(gaps), np.concatenate(rows), rotations


def constraint_drift(
    robot: ClosedRobot, data: pin.Data, q: np.ndarray, v: np.ndarray
) -> np.ndarray:
    """Ȧ v at one closed configuration ``(nq,)``, shape ``(equations,)``."""
    pin.forwardKinematics(robot.model, data, q, v, np.zeros(robot.model.nv))
    pin.updateFramePlacements(robot.model, data)
    parts = [np.empty(0)]
    for loop in robot.loops:
        one, two = (
            pin.getFrameClassicalAcceleration(robot.model, data, k, _AXES) for k in loop.ids
        )
        turned = data.oMf[loop.ids[0]].rotation.T
        parts.append(turned @ (two.linear - one.linear))
        if loop.size == 6:
            parts.append(turned @ (two.angular - one.angular))
    return np.concatenate(parts)


def newton_close(
    robot: ClosedRobot, q: np.ndarray, movable: slice | np.ndarray, iterations: int
) -> np.ndarray:
    """Newton steps of the movable joints from q ``(nq,)`` until the loops are closed."""
    data, best, size = robot.model.createData(), q, math.inf
    for _ in range(iterations):
        gap, matrix, _ = constraints(robot, data, q)
        now = float(np.abs(gap).max(initial=0.0))
        # Quadratic convergence ends in rounding: stop when a step no longer helps.
        if now >= size and size < TOLERANCES.loop_closure:
            break
        best, size = q, now
        if now == 0.0:
            break
        step = np.zeros(robot.model.nv)
        step[movable] = -np.linalg.lstsq(
            _derivative(robot, gap, matrix)[:, movable], gap, rcond=1e-10
        )[0]
        step *= min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-300))
        q = pin.integrate(robot.model, q, step)
    if size > TOLERANCES.loop_closure:
        raise Unreachable(
            f"the loops stay open by {size:.2e} after {iterations} Newton steps",
            allowed=f"{TOLERANCES.loop_closure:.0e}",
            remedy="Start nearer to a closed configuration, or move the motors",
        )
    return best


def _derivative(robot: ClosedRobot, gap: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    row, blocks = 0, [np.empty((0, robot.model.nv))]
    for loop in robot.loops:
        block = matrix[row : row + loop.size]
        if loop.size == 6:
            # log6 is derived in the second frame's axes, the twist is in the first's.
            moved = pin.exp6(gap[row : row + 6])
            block = pin.Jlog6(moved) @ moved.toActionMatrixInverse() @ block
        blocks.append(block)
        row += loop.size
    return np.concatenate(blocks)


def project_rates(robot: ClosedRobot, data: pin.Data, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Nearest rates, by kinetic energy, that keep the loops closed."""
    matrix = constraints(robot, data, q)[1]
    mass = pin.crba(robot.model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    spread = np.linalg.solve(mass, matrix.T)
    return np.asarray(v - spread @ np.linalg.lstsq(matrix @ spread, matrix @ v, rcond=1e-10)[0])
