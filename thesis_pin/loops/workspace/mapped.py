"""Where a robot can go on a grid, and how well its motors hold it there."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import BadInput
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close, motor_positions
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import Tool
from thesis_pin.loops.workspace import continuation
from thesis_pin.loops.workspace.conditioning import LENGTH, Measure, conditioned, measure
from thesis_pin.loops.workspace.continuation import spread
from thesis_pin.loops.workspace.grid import Grid, grid_of
from thesis_pin.loops.workspace.leading import Led
from thesis_pin.model.loading import frame_id
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import function, instance, real
from thesis_pin.numeric.workers import silent
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

REACHABLE, OPEN, LIMIT, SINGULAR, OTHER, CUT_OFF = range(6)
WORDS = ("reachable", "open", "limit", "singular", "other assembly", "cut off")
"""What a cell is called, by its state."""

MEANINGS = (
    "reachable inside the joints' ranges",
    "the loops stay open: out of reach",
    "a joint leaves its range",
    "singular: what leads doesn't determine the joints, or the motors don't hold the robot",
    "reachable in another assembly only",
    "no way through the grid leads there",
)
"""The same in a sentence each."""

_BLOCK = 4096  # cells at once
_SHOWN = 64  # cells that show how many of a frame's motions there are


@dataclass(frozen=True, eq=False)
class Workspace(Brief):
    """Reach and conditioning on a grid; arrays have the grid's shape.

    Attributes:
        robot: The robot, its root held.
        grid: What led it.
        measure: What the condition number is of.
        still: Motors that nothing led: they stayed at the pose.
        state: Index into :data:`WORDS`.
        q: Configurations, NaN where none closes, shape ``(..., nq)``.
        motors: Positions of the motors [rad], [m], NaN likewise, shape ``(..., motors)``.
        condition: Condition number, NaN where a cell isn't reachable.
        determinant: Of motors to frame, where that is square; NaN likewise, or everywhere.
        beyond: Joint that leaves its range by most, -1 for none, by number.
        joints: Names of these joints.
        seams: Pairs of neighbours closed in different ways; none unless the map winds.
        rooted: Whether a root that flies freely was held, so that coordinates are seen from it.
    """

    robot: ClosedRobot
    grid: Grid
    measure: Measure
    still: tuple[str, ...]
    state: NDArray[np.int8]
    q: Array
    motors: Array
    condition: Array
    determinant: Array
    beyond: NDArray[np.intp]
    joints: tuple[str, ...]
    seams: int
    rooted: bool = False

    def _cell(self) -> Cell:
        count, inside = int(self.reachable.sum()), self.condition[self.reachable]
        said = [
            f"{count} of {self.state.size} cells are reachable ({count / self.state.size:.0%})."
        ]
        if inside.size:
            said.append(f"Condition number {inside.min():.3g} to {inside.max():.3g}; 1 is best.")
        rows = [
            (word, str(int((self.state == k).sum())), MEANINGS[k])
            for k, word in enumerate(WORDS)
            if (self.state == k).any()
        ]
        title = f"Workspace of {self.robot.model.name}"
        return Cell(title, said, None, ("cells", "number", "are"), rows, prose=True)

    @property
    def words(self) -> tuple[str, ...]:
        """What each state is called."""
        return WORDS

    @property
    def reachable(self) -> NDArray[np.bool_]:
        """Whether a cell is reached inside the joints' ranges, at a pose that isn't singular."""
        return np.asarray(self.state == REACHABLE)


def evaluate_workspace(
    robot: ClosedRobot,
    along: Mapping[str, ArrayLike],
    *,
    at: Mapping[str, float] | None = None,
    frame: str | None = None,
    length: float = LENGTH,
    pose: ArrayLike | None = None,
    precision: float | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Workspace:
    """Reach and conditioning of any robot over a grid, in the assembly of a pose.

    Args:
        robot: From :func:`thesis_pin.load`; a root that flies freely is held, and coordinates are
            seen from it.
        along: Axes of the grid, one to three: name → values in ascending order. Names are
            x, y, z [m], roll, pitch, yaw [rad] of the frame, and joints or motors.
        at: What else leads and stands still: name → value. Motors that nothing leads stay at
            the pose where only motors lead.
        frame: The frame that leads, or that the condition number is of; None without one.
        length: Length that shifts are divided by in condition numbers [m].
        pose: Configuration from which cells are reached, which picks the assembly, shape
            ``(nq,)``; None for the least open of the description's.
        precision: What counts as dependent; see
            :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        progress: Told the cells done and their total.

    Returns:
        Every cell is closed from a neighbour, along the way there: the robot stays in one assembly.

    Raises:
        UnknownName: A name or the frame isn't the robot's.
        BadInput: The grid makes no sense.
        Unreachable: The loops can't be closed near the pose.
        SingularPose: What leads doesn't determine the other joints.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    function("progress", progress, "progress(done, total)")
    length = real("length", length, low=1e-6, unit="m")
    if frame is not None:
        frame_id(robot.model, frame)
    start = assembly(robot, precision=precision).q if pose is None else pose
    closed = close(robot, vector("pose", start, robot.model.nq), precision=precision)
    rooted = len(robot.base) > 0
    if rooted:
        robot, closed = _rooted(robot), closed[7:]
    grid = grid_of(robot, along, at, frame)
    led = Led(robot, grid, closed, precision)
    wave = spread(led, progress)
    q = _unwound(robot, wave.q[:, -robot.model.nq :])
    state, beyond, names = _named(robot, wave.state, q)
    good = np.flatnonzero(state == REACHABLE)
    some = q[good[np.linspace(0, len(good) - 1, _SHOWN).astype(int)]] if good.size else closed[None]
    rows = Tool(frame or "", grid.told).rows
    told = () if grid.joints else grid.told
    how = measure(robot, some, frame, told, rows, length, precision)
    condition, determinant = _conditions(robot, how, q, good, precision)
    state[good[np.isnan(condition[good])]] = SINGULAR
    shape = grid.shape
    return Workspace(
        robot,
        grid,
        how,
        led.still,
        state.reshape(shape),
        q.reshape(*shape, -1),
        motor_positions(robot, q).reshape(*shape, -1),
        condition.reshape(shape),
        determinant.reshape(shape),
        beyond.reshape(shape),
        names,
        wave.seams,
        rooted,
    )


def _named(
    robot: ClosedRobot, became: NDArray[np.int8], q: Array
) -> tuple[NDArray[np.int8], NDArray[np.intp], tuple[str, ...]]:
    """What cells are called, which joint leaves its range by most, -1 for none, and the joints."""
    state = np.full(len(became), CUT_OFF, dtype=np.int8)
    for one, word in (
        (continuation.OPEN, OPEN),
        (continuation.OTHER, OTHER),
        (continuation.SINGULAR, SINGULAR),
        (continuation.CLOSED, REACHABLE),
    ):
        state[became == one] = word
    names, excess = _excess(robot, q)
    beyond = np.where(excess.max(axis=1) > TOLERANCES.joint_limit, excess.argmax(axis=1), -1)
    beyond[state != REACHABLE] = -1
    state[beyond >= 0] = LIMIT
    return state, beyond, names


def _conditions(
    robot: ClosedRobot, how: Measure, q: Array, good: NDArray[np.intp], precision: float | None
) -> tuple[Array, Array]:
    """Condition numbers and determinants of some cells; NaN of others, and of singular ones."""
    condition, determinant = np.full((2, len(q)), np.nan)
    for first in range(0, len(good), _BLOCK):
        part = good[first : first + _BLOCK]
        condition[part], determinant[part] = conditioned(robot, how, q[part], precision)
    lost = good[~(condition[good] < 1 / TOLERANCES.near_singular)]
    condition[lost] = determinant[lost] = np.nan
    return condition, determinant


def _rooted(robot: ClosedRobot) -> ClosedRobot:
    """The same robot with its root held in the world."""
    if any(robot.model.frames[k].parentJoint == 0 for loop in robot.loops for k in loop.ids):
        raise BadInput("the root flies freely, and a loop ties the robot to the world")
    beside = replace(robot.supplement, free_root=False, poses={})
    return ClosedRobot(replace(robot.description, supplement=beside))


def _unwound(robot: ClosedRobot, q: Array) -> Array:
    """The same poses with angles in their joints' ranges, where whole turns bring them there."""
    q = q.copy()
    tied = {name for one in robot.couplings for name in one.coefficients}
    for name, one in singles(robot.model).items():
        if not one.turns or one.continuous or name in tied or not np.isfinite(one.high - one.low):
            continue
        angle = q[:, one.q]
        turns = np.round(((one.low + one.high) / 2 - angle) / (2 * np.pi))
        inside = one.excess(q) <= TOLERANCES.joint_limit
        q[:, one.q] = np.where(inside, angle, angle + 2 * np.pi * turns)
    return q


def _excess(robot: ClosedRobot, q: Array) -> tuple[tuple[str, ...], Array]:
    """Every joint's name, and by how much it is outside its range: ``(n, joints)``."""
    known = singles(robot.model)
    excess = np.nan_to_num(np.column_stack([one.excess(q) for one in known.values()]))
    return tuple(known), excess
