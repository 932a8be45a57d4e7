"""How far a file's noise may move torques, relative to the largest of them.

Two witnesses of that noise are heard. Dependent equations and gaps show it in the mechanism
itself (:attr:`Survey.blur`); near a singular pose the error is what moving along the weakest
motion does. Directions a little off a round one show it in the file: the robot with these
made round is asked for the same motion (:mod:`thesis_pin.model.formats.rounding`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close_stack, motor_positions, place_motors
from thesis_pin.loops.configurations.rates import passive_rates
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.forces.judging import DOUBTFUL, is_uncertain, weakest_motion
from thesis_pin.loops.forces.loads import external_forces, open_tree_forces
from thesis_pin.loops.system.solve import Solved, solve
from thesis_pin.loops.system.survey import Survey

Array = NDArray[np.float64]

CAREFUL = 5.0
"""How much larger than its estimate an uncertainty is said to be [-]."""

_TWICE = 2.0  # the same where the error itself is worked out
_TRIED = 16  # weakest samples of a block, and samples spread over it, that are worked out
_STEPS = 60  # Newton steps at most


@dataclass(frozen=True, eq=False)
class State:
    """A stack of states with what acts from outside.

    Attributes:
        q, v, a: Configurations, rates and accelerations, shape ``(n, …)``.
        wrenches: Frames and the wrenches on them, ``(n, 6)`` each.
        sliding: Which way friction is overcome, see
            :func:`thesis_pin.loops.forces.loads.passive_forces`.
    """

    q: Array
    v: Array
    a: Array
    wrenches: list[tuple[int, Array]]
    sliding: Array | None = None

    def at(self, places: NDArray[np.intp]) -> State:
        """Some of them."""
        wrenches = [(frame, wrench[places]) for frame, wrench in self.wrenches]
        sliding = None if self.sliding is None else self.sliding[places]
        return State(self.q[places], self.v[places], self.a[places], wrenches, sliding)


def motor_loads(robot: ClosedRobot, survey: Survey, data: pin.Data, state: State) -> Solved:
    """What carries the load of states, without checks."""
    poses = robot.system.poses(data, state.q)
    tau = open_tree_forces(robot, data, state.q, state.v, state.a, state.sliding)
    if state.wrenches:
        tau -= external_forces(robot, data, poses, state.wrenches)
    driven = np.concatenate([robot.actuated, robot.base])
    matrices = robot.system.jacobian(poses)
    return solve(survey, robot.scale, matrices, tau, driven, robot.passive)


def by_noise(
    robot: ClosedRobot,
    survey: Survey,
    data: pin.Data,
    state: State,
    matrices: Array,
    torque: Array,
    largest: Array,
    weakest: Array,
) -> Array:
    """What the noise does that the mechanism shows, ``(n,)``; infinite where nothing is known.

    Where that is little, its estimate from the weakest singular value alone.

    Args:
        robot: The robot.
        survey: Of its assembly.
        data: Pinocchio's data, overwritten.
        state: States.
        matrices: Jacobians of the equations there, unscaled.
        torque: Of the motors, shape ``(n, motors)``.
        largest: What changes are relative to, shape ``(n,)``.
        weakest: Weakest singular value that counts, or less [rad], shape ``(n,)``.
    """
    with np.errstate(divide="ignore"):
        result = np.asarray(CAREFUL * survey.blur / weakest**2)
    some = np.flatnonzero(is_uncertain(survey, weakest))
    if not some.size or not survey.rank:
        return result
    scale = robot.scale
    scaled = scale.rows[:, None] * matrices[some] * scale.columns
    values, motions = weakest_motion(robot, survey, scaled)
    here, step, share = state.at(some), survey.blur / values, np.zeros(len(some))
    for sign in (1.0, -1.0):
        moves = sign * step[:, None] * motions * scale.columns
        moved = np.array(
            [pin.integrate(robot.model, *both) for both in zip(here.q, moves, strict=True)]
        )
        there = replace(here, q=moved)
        other = motor_loads(robot, survey, data, there).driven[:, : torque.shape[1]]
        share = np.maximum(share, _change(other, torque[some], largest[some]))
    # A step as long as the way to the singularity may end beyond it: nothing is known.
    result[some] = np.where(step > 0.5 * values, np.inf, CAREFUL * share)
    return result


def by_rounding(
    robot: ClosedRobot,
    survey: Survey,
    state: State,
    torque: Array,
    largest: Array,
    weakest: Array,
    precision: float | None,
) -> Array:
    """What nearly round directions of the file do, ``(n,)``; 0 where there are none.

    Where their noise is too little for a warning, its estimate from the weakest singular
    value alone. Else some samples are worked out for the robot with these made round, and the
    others estimated by the largest ratio that was met.

    Args:
        robot: The robot.
        survey: Of its assembly.
        state: States.
        torque: Of the motors, shape ``(n, motors)``.
        largest: What changes are relative to, shape ``(n,)``.
        weakest: Weakest singular value that counts, or less [rad], shape ``(n,)``.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
    """
    result = np.zeros(len(torque))
    if robot.rounding is None or not survey.rank or not torque.shape[1]:
        return result
    with np.errstate(divide="ignore"):
        law = np.asarray(robot.rounding.noise / weakest**2)
    doubtful = np.flatnonzero(CAREFUL * law > 0.1 * DOUBTFUL)
    if not doubtful.size:
        return CAREFUL * law
    order = doubtful[np.argsort(weakest[doubtful], kind="stable")]
    spread = doubtful[:: max(1, len(doubtful) // _TRIED)]
    tried = np.unique(np.concatenate([order[:_TRIED], spread[:_TRIED]]))
    result, waiting = CAREFUL * law, tried
    while waiting.size:
        other = _torque_when_round(robot, survey, state.at(waiting), precision)
        if other is None:
            return np.zeros(len(torque))
        share = _TWICE * _change(other, torque[waiting], largest[waiting])
        if waiting is tried:
            known = np.isfinite(share)
            ratios = share[known] / law[tried[known]]
            result = law * float(ratios.max(initial=0.0) if known.any() else CAREFUL)
        result[waiting] = share
        # Estimates that would be warned of are worked out too.
        rest = np.setdiff1d(doubtful, tried) if waiting is tried else np.empty(0, dtype=np.intp)
        waiting = rest[result[rest] > DOUBTFUL]
    return result


def _torque_when_round(
    robot: ClosedRobot, survey: Survey, state: State, precision: float | None
) -> Array | None:
    """Motor torques of the same motion with nearly round directions made round.

    Returns:
        Shape ``(n, motors)``, infinite where the motors can't stand there; None if dependent
        equations are so no longer, so that the file meant its directions.
    """
    lost = None if robot.equations > survey.rank else np.full((len(state.q), 1), np.inf)
    other, data = robot.rounded, robot.rounded.model.createData()
    q = place_motors(other, state.q, motor_positions(robot, state.q))
    try:
        closed, reasons = close_stack(other, data, q, other.passive, _STEPS, precision)
        known = surveyed(other, closed.q[0], precision)
    except BadInput:
        return lost
    if (known.rank, known.passive_rank) != (survey.rank, survey.passive_rank):
        return lost
    v, a = state.v.copy(), state.a.copy()
    errors = passive_rates(other, known, data, closed.q, v, a)
    moved = replace(state, q=closed.q, v=v, a=a)
    torque = motor_loads(other, known, data, moved).driven[:, : len(robot.actuators)]
    open_ones = [bool(why or error) for why, error in zip(reasons, errors, strict=True)]
    torque[open_ones] = np.inf
    return lost if all(open_ones) else torque


def _change(other: Array, torque: Array, largest: Array) -> Array:
    change = np.abs(other - torque).max(axis=1, initial=0.0)
    return np.asarray(change / np.where(largest > 0, largest, 1.0))
