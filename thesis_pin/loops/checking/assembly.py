"""One way to assemble a robot: a closed configuration, looked for near a pose first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.checking.poses import in_range, named_pose, neutral
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close_one, loop_gaps
from thesis_pin.loops.joints import singles
from thesis_pin.loops.kinematics import linearized, residual
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

GUESSES = 20
"""Spread-out configurations from which a closed one is looked for, after the poses."""

_SPREAD = 1.5  # rad or m, half the width of the guesses about the neutral configuration
_SHIFTS, _NEAR = 2, 0.1  # tries beside each pose, and how far from it [rad], [m]
_NEWTON, _PATIENCE = 60, 25  # steps of an attempt, and those in which it may not get nearer
_FITS, _STEPS, _LAST = 4, 60, 300  # of a search for the least gap; steps of the best one


@dataclass(frozen=True)
class Gap:
    """How far one loop is open.

    Attributes:
        loop: Its name; a coupling's too.
        frames: Names of its frames; empty for a coupling.
        distance: What ought to be no distance [m].
        angle: What ought to be no angle [rad].
    """

    loop: str
    frames: tuple[str, ...]
    distance: float
    angle: float

    def __str__(self) -> str:
        parts = [f"{self.distance * 1e3:.3g} mm"] * bool(self.distance or not self.angle)
        parts += [f"{np.degrees(self.angle):.3g}°"] * bool(self.angle)
        between = f" between {self.frames[0]} and {self.frames[1]}" if self.frames else ""
        return f"{' and '.join(parts)}{between}"


@dataclass(frozen=True, eq=False)
class Assembly:
    """Where a robot was looked at.

    Attributes:
        q: The configuration: closed, or of the least gap that was found, shape ``(nq,)``.
        closed: Whether it is closed.
        start: From where it was found, in words.
        gaps: Each loop's, then each coupling's.
        outside: Joints outside their range in it, and by how much [rad], [m].
    """

    q: Array
    closed: bool
    start: str
    gaps: tuple[Gap, ...]
    outside: dict[str, float]

    @property
    def widest(self) -> Gap | None:
        """The loop that is open furthest; None if there is none."""
        return max(self.gaps, key=lambda gap: max(gap.distance, gap.angle), default=None)


def assembly(
    robot: ClosedRobot, pose: str | None = None, *, precision: float | None = None
) -> Assembly:
    """A closed configuration of a robot, inside the joints' ranges if there is one.

    The search starts at the pose asked for, whose joints may be outside their ranges; without
    one at the neutral pose and the description's named ones, the least open first, then at
    guesses inside the ranges.

    Args:
        robot: The robot.
        pose: See :func:`thesis_pin.loops.checking.poses.named_pose`; then nothing else is tried.
        precision: What counts as dependent; see
            :func:`thesis_pin.loops.configurations.surveying.surveyed`.

    Returns:
        What was found; if nothing closes, where the gap is least.
    """
    best: Assembly | None = None
    starts = list(_starts(robot, pose))
    # What somebody put outside its range stays there, and is said.
    told = set() if pose is None else set(outside(robot, starts[0][1]))
    nearest: list[tuple[float, str, Array]] = []
    data = robot.model.createData()
    for start, q in starts:
        settled, reason = close_one(robot, data, q, _NEWTON, precision, _PATIENCE)
        if reason:
            size = float(np.abs(robot.scale.rows * residual(robot, settled.q)).max())
            nearest.append((size, start, in_range(robot, settled.q)))
            continue
        closed = settled.q
        found = Assembly(closed, True, start, gaps(robot, closed), outside(robot, closed))
        if told.issuperset(found.outside):
            return found
        if best is None or max(found.outside.values()) < max(best.outside.values()):
            best = found
    nearest.sort(key=lambda one: one[0])
    return best or _least_open(robot, [(start, q) for _, start, q in nearest])


def gaps(robot: ClosedRobot, q: Array) -> tuple[Gap, ...]:
    """How far each loop, then each coupling, is open at a configuration ``(nq,)``."""
    opening = residual(robot, q)
    found = [
        Gap(loop.name, loop.frames, *map(float, gap))
        for loop, gap in zip(robot.loops, loop_gaps(robot, opening), strict=True)
    ]
    known, first = singles(robot.model), len(opening) - len(robot.couplings)
    for coupling, value in zip(robot.couplings, np.abs(opening[first:]).tolist(), strict=True):
        turns = any(known[name].turns for name in coupling.coefficients if name in known)
        distance, angle = (0.0, value) if turns else (value, 0.0)
        found.append(Gap(coupling.name, (), distance, angle))
    return tuple(found)


def outside(robot: ClosedRobot, q: Array) -> dict[str, float]:
    """Joints outside their range at a configuration ``(nq,)``, and by how much [rad], [m]."""
    found = {}
    for name, joint in singles(robot.model).items():
        excess = float(joint.excess(q))
        if excess > TOLERANCES.joint_limit:
            found[name] = excess
    return found


def _starts(robot: ClosedRobot, pose: str | None) -> Iterator[tuple[str, Array]]:
    if pose is not None:
        poses = [(f"pose {pose}", named_pose(robot, pose))]
    else:
        poses = [("the neutral pose", neutral(robot))]
        poses += [(f"pose {name}", named_pose(robot, name)) for name in robot.supplement.poses]
        poses.sort(key=lambda one: float(np.abs(residual(robot, one[1])).max(initial=0.0)))
    generator = np.random.default_rng(0)
    for name, q in poses:
        yield name, q
        for _ in range(_SHIFTS):  # a stretched linkage doesn't know which way to bend
            yield name, _shifted(robot, q, _NEAR, generator)
    for number in range(GUESSES if pose is None else 0):
        start = f"guess {number + 1} of {GUESSES}"
        yield start, _shifted(robot, neutral(robot), _SPREAD, generator)


def _shifted(robot: ClosedRobot, q: Array, spread: float, generator: np.random.Generator) -> Array:
    """A random configuration about another, inside the joints' ranges; its root stays."""
    step = generator.uniform(-spread, spread, robot.model.nv)
    step[robot.base] = 0.0
    return in_range(robot, np.asarray(pin.integrate(robot.model, q, step)))


def _least_open(robot: ClosedRobot, starts: list[tuple[str, Array]]) -> Assembly:
    """Where the loops are open least: the least of bounded minima from several starts.

    Metres and radians are weighed as the robot's scale does, so that a loop isn't called
    wide open because it is a large one.
    """
    fits = [(*_fitted(robot, q, _STEPS), start) for start, q in starts[:_FITS]]
    _, near, start = min(fits, key=lambda fit: fit[0])
    _, best = _fitted(robot, near, _LAST)
    return Assembly(best, False, start, gaps(robot, best), outside(robot, best))


def _fitted(robot: ClosedRobot, q: Array, steps: int) -> tuple[float, Array]:
    """A minimum near a configuration inside the ranges: half the squared gaps, and where."""
    from scipy.optimize import minimize  # which only a robot that doesn't close needs

    weights, data = robot.scale.rows, robot.model.createData()

    def opening(step: Array) -> tuple[float, Array]:
        moved = pin.integrate(robot.model, q, step)
        gap, matrix = linearized(robot, data, moved)
        gap, matrix = weights * gap, weights[:, None] * matrix
        turned = pin.dIntegrate(robot.model, q, step, pin.ArgumentPosition.ARG1)
        return float(gap @ gap) / 2, np.asarray(turned.T @ (matrix.T @ gap))

    found = minimize(
        opening,
        np.zeros(robot.model.nv),
        jac=True,
        method="L-BFGS-B",
        bounds=_bounds(robot, q),
        options={"maxiter": steps, "ftol": 1e-14, "gtol": 1e-12},
    )
    return float(found.fun), in_range(robot, np.asarray(pin.integrate(robot.model, q, found.x)))


def _bounds(robot: ClosedRobot, q: Array) -> list[tuple[float, float]]:
    """How far each velocity's coordinate may go from a configuration."""
    bounds = [(-np.inf, np.inf)] * robot.model.nv
    for joint in singles(robot.model).values():
        if not joint.continuous:
            bounds[joint.v] = joint.low - float(q[joint.q]), joint.high - float(q[joint.q])
    return bounds
