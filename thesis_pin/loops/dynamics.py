"""Inverse dynamics of any robot with closed loops and motors.

Pinocchio 4 has forward dynamics for bilateral loops (``constraintDynamics``) and
no inverse dynamics. It is linear algebra: with r(q) = 0 the loop equations and
A = ∂r/∂q, the motion obeys

    M v̇ + h = B τ + Aᵀ λ.

The columns of A that belong to passive joints give λ, its other columns then the
torques. How many equations are independent is known from a walk through the assembly
(:mod:`thesis_pin.loops.system.survey`), so that a file's rounding can't pose as a real equation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.surveying import surveyed
from thesis_pin.loops.forces.forward import ForwardDynamics as ForwardDynamics
from thesis_pin.loops.forces.forward import forward_dynamics as forward_dynamics
from thesis_pin.loops.forces.forward import simulate as simulate
from thesis_pin.loops.forces.inverse import InverseWork
from thesis_pin.loops.forces.loads import (
    Wrenches,
    checked_wrenches,
)
from thesis_pin.loops.forces.uncertainty import State
from thesis_pin.loops.system.idle import IdleGroup
from thesis_pin.numeric.arrays import finite_array, spread, together
from thesis_pin.numeric.checks import instance

Array = NDArray[np.float64]

_CHUNK = 2048  # samples worked on at once, so that memory stays bounded


@dataclass(frozen=True)
class LoopDynamics(Brief):
    """Motor torques and loop forces of a motion.

    Attributes:
        torque: Of the motors at their joints [N·m] or [N], in their order, ``(..., motors)``.
        force: On the first frame's body at each loop's second origin, world axes [N], shape
            ``(..., loops, 3)``.
        moment: The same for loops that forbid turns [N·m], zero for ball joints and rods.
        coupling: Force of each coupling per unit of its equation, ``(..., couplings)``:
            a joint of factor f gets f times it.
        base: On a free flyer's root link, what the world must supply: force, then moment
            about its origin, world axes [N], [N·m], ``(..., 6)``; ``(..., 0)`` without one.
        joint_force: Generalized forces that the open tree needs, shape ``(..., nv)``.
        residual: Largest part of them that motors and loops leave unexplained,
            relative to the largest of them, shape ``(...)``.
        unexplained: The same without the load on harmless idle freedoms, shape ``(...)``.
        idle_load: Load on each idle group, relative to the largest force, ``(..., groups)``.
        freedom: Degrees of freedom by rank, shape ``(...)``.
        condition: Condition number of Nᵀ B, shape ``(...)``.
        uncertainty: How far the torques may be off because of ``noise`` and ``digits``,
            relative to the largest of them, shape ``(...)``: an estimate. Noise that shows
            neither in dependent equations nor in nearly round directions isn't in here.
        gaps: Opening of each loop [m], [rad], shape ``(..., loops, 2)``.
        unique: Whether the motors' torques are determined (as many as freedoms).
        determined: Whether the loop forces are (independent equations), shape ``(...)``.
        noise: How far the file's digits let dependent equations differ, or loops stay open
            [rad].
        idle: Motions that no motor holds.
        digits: Directions of the file that are nearly round, the furthest first.
    """

    torque: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    coupling: np.ndarray
    base: np.ndarray
    joint_force: np.ndarray
    residual: np.ndarray
    unexplained: np.ndarray
    idle_load: np.ndarray
    freedom: np.ndarray
    condition: np.ndarray
    uncertainty: np.ndarray
    gaps: np.ndarray
    unique: np.ndarray
    determined: np.ndarray
    noise: float
    idle: tuple[IdleGroup, ...]
    digits: tuple[str, ...] = ()


def inverse_dynamics(
    robot: ClosedRobot,
    q: ArrayLike,
    v: ArrayLike,
    a: ArrayLike,
    *,
    external: Wrenches | None = None,
    sliding: ArrayLike | None = None,
    check: bool = True,
    precision: float | None = None,
) -> LoopDynamics:
    """Motor torques and loop forces that a motion of the closed robot needs.

    Damping, friction, springs and armature of the description count. Redundant motors
    share the load with the least sum of squares; loop forces that dependent equations
    leave open are the smallest that fit, metres scaled by the loop's size.

    Args:
        robot: The robot.
        q: Closed configurations, shape ``(..., nq)``.
        v: Rates that keep the loops closed, shape ``(..., nv)``.
        a: Accelerations that do, shape ``(..., nv)``.
        external: Frame → wrench that acts on it from outside: force, then moment about the
            frame's origin, world axes [N], [N·m], shape ``(6,)`` or ``(..., 6)``.
        sliding: Which way each joint's Coulomb friction is overcome, 1, −1 or 0, as v; None for
            the sign of its rate where that isn't zero.
        check: Refuse motions that open the loops, and loads that neither motors nor loops
            carry.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        Torques, forces, and how well determined they are.

    Raises:
        BadInput: The motion opens a loop (see :func:`close`, :func:`follow`).
        SingularPose: Torques don't exist at a pose, or the file's noise may turn them over.
        NoSolution: Neither motors nor loops carry some load.
        ModelError: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
    """
    model = instance("robot", robot, ClosedRobot, "thesis_pin.load()").model
    q, v, a = together(
        q=finite_array("q", q, model.nq),
        v=finite_array("v", v, model.nv),
        a=finite_array("a", a, model.nv),
    )
    stack = q.shape[:-1]
    if not q.size:
        raise BadInput("the stack is empty", allowed="at least one sample")
    wrenches = checked_wrenches(robot, external, stack)
    if sliding is not None:
        sliding = spread("sliding", finite_array("sliding", sliding, model.nv), stack)
        sliding = sliding.reshape(-1, model.nv)
    q, v, a = (x.reshape(-1, x.shape[-1]) for x in (q, v, a))
    survey = surveyed(robot, q[0], precision)
    work = InverseWork(robot, survey, precision, check)
    parts = []
    for first in range(0, len(q), _CHUNK):
        some = slice(first, first + _CHUNK)
        pushed = [(frame, wrench[some]) for frame, wrench in wrenches]
        slides = None if sliding is None else sliding[some]
        parts.append(work.chunk(first, State(q[some], v[some], a[some], pushed, slides)))
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    shaped = {name: x.reshape((*stack, *x.shape[1:])) for name, x in joined.items()}
    digits = () if robot.rounding is None else robot.rounding.digits
    return LoopDynamics(**shaped, noise=survey.noise, idle=survey.idle, digits=digits)
