"""How well motors hold a robot, or a frame of it: a condition number at closed configurations.

With the motions N that the loops leave, the rates of the motors are Bᵀ N and the twist of a
frame F N; motors to frame is J = (Bᵀ N)(F N)⁺, whose condition says by how much the frame's
errors, or its forces, differ with their direction. Shifts and turns become comparable by a
length: that much of a shift counts as one radian.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import SingularPose
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.joints import singles
from thesis_pin.loops.system.rows import POINT, WELD, Mask
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.complements import complement
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

LENGTH = 0.1
"""Length [m] that shifts are divided by before a condition number is taken."""

_SEEN = 1e-6  # singular value, relative to the largest, from which a motion is seen


@dataclass(frozen=True, eq=False)
class Measure:
    """What condition number is taken.

    Attributes:
        motors: Joints of the motors.
        frame: The frame they hold; None for all that they hold.
        rows: Which shifts and turns of it, in the world's axes.
        length: Length that shifts are divided by [m].
        freedoms: How many of its motions there are.
    """

    motors: tuple[str, ...]
    frame: str | None
    rows: Mask
    length: float
    freedoms: int

    def said(self) -> str:
        """It in words."""
        if self.frame is None:
            return "of the motors against all motions that the loops leave"
        names = " ".join(
            name
            for name, row in zip(("x", "y", "z", "ωx", "ωy", "ωz"), self.rows, strict=True)
            if row
        )
        scale = f", {self.length:g} m count as 1 rad" if any(self.rows[3:]) else ""
        return f"of the motors against {names} of frame {self.frame}{scale}"


def measure(
    robot: ClosedRobot,
    q: Array,
    frame: str | None,
    told: tuple[str, ...],
    rows: Mask,
    length: float,
    precision: float | None,
) -> Measure:
    """What condition number suits a robot.

    Args:
        robot: The robot.
        q: Closed configurations, of which the best shows what the frame does elsewhere too,
            shape ``(n, nq)``.
        frame: The frame that counts; None without one.
        told: Which coordinates of it lead the robot; where none does, its place counts if that
            shows all that it can do, else place and orientation.
        rows: The same as a mask.
        length: Length that shifts are divided by [m].
        precision: What counts as dependent.

    Raises:
        SingularPose: The frame doesn't move with the motors.
    """
    motors = robot.actuators or tuple(singles(robot.model))
    if frame is None:
        return Measure(motors, None, WELD, length, 0)
    shown = {
        one: max(
            _rank(values)
            for values in np.linalg.svd(
                _maps(robot, Measure(motors, frame, one, length, 0), q, precision)[1],
                compute_uv=False,
            )
        )
        for one in ((rows,) if told else (POINT, WELD))
    }
    most = max(shown.values())
    for one, rank in shown.items():
        if rank == most > 0:
            return Measure(motors, frame, one, length, rank)
    raise SingularPose(
        f"frame {frame!r} doesn't move with the motors here", remedy="Name another frame or --pose"
    )


def conditioned(
    robot: ClosedRobot, how: Measure, q: Array, precision: float | None
) -> tuple[Array, Array]:
    """Condition numbers at closed configurations ``(n, nq)``, and determinants.

    Returns:
        Each ``(n,)``: infinite where the motors lose something; NaN for determinants of what
        isn't square. A determinant's sign changes where they do.
    """
    driven, seen = _maps(robot, how, q, precision)
    nothing = np.full(len(q), np.nan)
    if how.frame is None:
        values = np.linalg.svd(driven, compute_uv=False)
        rank = _rank(values[np.argmax(values.min(axis=1))])
        return _condition(np.asarray(values, dtype=np.float64), rank), nothing
    left, values, right = np.linalg.svd(seen, full_matrices=False)
    rank = how.freedoms
    strong = values[:, rank - 1] > TOLERANCES.near_singular * values[:, 0]
    inverse = np.where(strong[:, None], 1.0 / np.where(values > 0, values, 1.0)[:, :rank], 0.0)
    back = np.swapaxes(right[:, :rank], 1, 2) * inverse[:, None]
    matrix = driven @ (back @ np.swapaxes(left[:, :, :rank], 1, 2))
    found = _condition(np.linalg.svd(np.asarray(matrix, dtype=float), compute_uv=False), rank)
    found[~strong] = np.inf
    square = matrix.shape[1] == matrix.shape[2] == rank
    return found, np.where(strong, np.linalg.det(matrix), np.nan) if square else nothing


def _maps(
    robot: ClosedRobot, how: Measure, q: Array, precision: float | None
) -> tuple[Array, Array]:
    """Rates of the motors and of the frame for the motions that the loops leave."""
    model, scale = robot.model, robot.scale
    data = model.createData()
    motions = np.broadcast_to(np.eye(model.nv), (len(q), model.nv, model.nv))
    if robot.equations:
        rank = surveyed(robot, q[0], precision).rank
        matrices = robot.system.jacobian(robot.system.poses(data, q))
        scaled = scale.rows[:, None] * matrices * scale.columns
        motions = complement(np.linalg.svd(scaled, full_matrices=False)[2][:, :rank])
    kinds = singles(model)
    units = [1.0 if kinds[name].turns else how.length for name in how.motors]
    places = [kinds[name].v for name in how.motors]
    if how.frame is None:
        return motions[:, places], motions[:, :0]
    driven = motions[:, places] * (scale.columns[places] / units)[:, None]
    number = frame_id(model, how.frame)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    jacobians = np.empty((len(q), 6, model.nv))
    for k, one in enumerate(q):
        pin.computeJointJacobians(model, data, one)
        pin.updateFramePlacement(model, data, number)
        jacobians[k] = pin.getFrameJacobian(model, data, number, axes).reshape(6, -1)
    jacobians[:, :3] /= how.length
    return driven, (jacobians[:, list(how.rows)] * scale.columns) @ motions


def _rank(values: Array) -> int:
    return int((values > _SEEN * values[0]).sum()) if values.size and values[0] > 0 else 0


def _condition(values: Array, rank: int) -> Array:
    with np.errstate(divide="ignore", invalid="ignore"):
        found = values[:, 0] / values[:, max(rank, 1) - 1]
    return np.where(np.isfinite(found), found, np.inf)
