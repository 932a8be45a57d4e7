"""What the samples of a gait leave open, carried through kinematics and dynamics.

Every variant of a smoothed gait (see :mod:`scout_pin.motion.variants`) is judged as the gait
itself is, all of them in one stack.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.dynamics.stability import momentum, support_margin, zero_moment_point
from scout_pin.model import Scout
from scout_pin.motion.gait import BODIES, Gait, GaitMotion
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.motion.variants import Variants
from scout_pin.specification import SIDES
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.errors import ThesisPinError
from thesis_pin.numeric.rotations import euler_placement
from thesis_pin.numeric.trajectory import BodyMotion, JointTrajectory
from thesis_pin.smoothing.rates import resting
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Result = TypeVar("Result")

SAMPLES = 201
"""Evenly spaced samples at which variants are judged, beside extremes and those at changes."""


@dataclass(frozen=True)
class Judged:
    """Numbers of some samples for each variant that could be worked out.

    Attributes:
        torque, speed: Of each joint, shape ``(variants, k, 12)``.
        margin: Of the ZMP [m], ``(variants, k)``.
        contact: Distance of a single standing foot's wrench inside its cone [N·m],
            infinite in double support, ``(variants, k)``.
        violation: Least wrench that is missing in double support [N·m], ``(variants, k)``.
        friction_used: Largest share of friction in use, 0 if none, ``(variants, k)``.
        lowest: Height of a swinging sole's lowest corner [m], infinite if both stand,
            ``(variants, k)``.
    """

    torque: Array
    speed: Array
    margin: Array
    contact: Array
    violation: Array
    friction_used: Array
    lowest: Array

    def part(self, some: slice) -> Judged:
        """Some of the variants."""
        return Judged(**{name: values[some] for name, values in vars(self).items()})


@dataclass(frozen=True)
class Drawn:
    """The variants of a gait beside its own curves, judged.

    Attributes:
        keep: Samples of the gait's motion at which they are judged, shape ``(k,)``.
        rival: Order 3's curve, one variant; None if it couldn't be worked out.
        draws: The draws that could.
        lost: How many draws couldn't.
        resting: Joints at samples of the whole motion whose rate isn't known to differ
            from zero, booleans ``(n, 12)``.
        creeping: Those of them whose rate isn't known to be zero either.
    """

    keep: NDArray[np.intp]
    rival: Judged | None
    draws: Judged
    lost: int
    resting: NDArray[np.bool_]
    creeping: NDArray[np.bool_]


def kept(gait: Gait, variants: Variants, t: Array) -> NDArray[np.intp]:
    """Samples at times t at which variants are judged: evenly, and all around changes."""
    even = np.linspace(0, len(t) - 1, min(len(t), SAMPLES)).round().astype(np.intp)
    side = 2.0 * TOLERANCES.instant * (gait.end - gait.start)
    edges = [e for one in variants.changes for e in (one.start, one.end)]
    edges += [e for phase in gait.phases for e in (phase.start, phase.end)]
    edges += [e for pair in variants.hidden for e in pair]
    near = np.abs(t[:, None] - np.unique(edges)).min(axis=1) <= side
    return np.union1d(even, np.flatnonzero(near))


def drawn(
    robot: Scout,
    gait: Gait,
    motion: GaitMotion,
    joints: JointTrajectory,
    unit: float,
    extremes: Sequence[int] = (),
    branch: str | Sequence[str] | None = None,
) -> Drawn | None:
    """Judge the variants of a gait; None if it has none.

    Args:
        robot: The biped, with a free-flyer root.
        gait: The gait.
        motion: Its sampled motion.
        joints: Its joint trajectory; variants begin on its branches.
        unit: Seconds in the gait's unit of t.
        extremes: Samples at which the gait itself has its least and largest numbers.
        branch: The branch it was asked to take; None left it open.
    """
    variants = gait.variants
    if variants is None:
        return None
    keep = np.union1d(kept(gait, variants, motion.t), np.asarray(extremes, dtype=np.intp))
    own, count = motion.part(keep), len(keep)
    stack = _stack(variants, own, unit)

    def follow(some: Sequence[int]) -> JointTrajectory:
        motions = stack.part(_rows(some, count))
        return joint_trajectory(robot, motions, branch=branch, reference=joints.q[0])

    alive, followed = _survivors(range(variants.count - 1), follow)
    rates = followed.v.reshape(len(alive), count, -1)
    first = int(alive[0] == 0)
    rival = rates[0] if first else None
    still, creeping = resting(motion.t, keep, joints.v, rates[first:], rival)

    def judge(some: Sequence[int]) -> Judged:
        rows = _rows([alive.index(number) for number in some], count)
        moved = replace(followed.part(rows), resting=np.tile(still[keep], (len(some), 1)))
        return judged(robot, stack.part(_rows(some, count)), moved, len(some))

    alive, found = _survivors(alive, judge)
    first = int(alive[0] == 0)
    return Drawn(
        keep,
        found.part(slice(0, 1)) if first else None,
        found.part(slice(first, None)),
        variants.count - 2 - (len(alive) - first),
        still,
        creeping,
    )


def judged(robot: Scout, motion: GaitMotion, joints: JointTrajectory, count: int) -> Judged:
    """Numbers of a stack of motions, one after the other.

    Args:
        robot: The biped.
        motion: As many samples of each as of the others.
        joints: Its joint trajectory.
        count: How many motions.
    """
    dynamics = inverse_dynamics(robot, motion, joints)
    com, rate = momentum(robot, *free_flyer_state(motion.torso, joints))
    margin = support_margin(robot, motion, zero_moment_point(robot.mass, com, rate))
    double = motion.support.all(axis=1)
    single = np.where(motion.support, dynamics.contact_margin, np.inf).min(axis=1)
    used = np.nan_to_num(dynamics.friction_used, nan=0.0).max(axis=1)
    values = {
        "torque": dynamics.torque,
        "speed": joints.v,
        "margin": margin,
        "contact": np.where(double, np.inf, single),
        "violation": np.where(double, dynamics.double_violation, 0.0),
        "friction_used": used,
        "lowest": lowest_corners(robot, motion),
    }
    return Judged(**{name: v.reshape(count, -1, *v.shape[1:]) for name, v in values.items()})


def lowest_corners(robot: Scout, motion: GaitMotion) -> Array:
    """Height of the swinging sole's lowest corner at each sample [m]; infinite if both stand."""
    lowest = np.full(len(motion.t), np.inf)
    for k, side in enumerate(SIDES):
        swings = np.flatnonzero(~motion.support[:, k])
        foot = (motion.left_foot if side == "left" else motion.right_foot).part(swings)
        if swings.size:
            lowest[swings] = robot.sole_vertices(side, foot.placement)[..., 2].min(axis=1)
    return lowest


def _stack(variants: Variants, own: GaitMotion, unit: float) -> GaitMotion:
    """Motions of all variants but the gait's own, one after the other."""
    count = variants.count - 1
    values = {}
    for name in BODIES:
        found = np.zeros((3, 6, count, len(own.t)))
        for k, curve in enumerate(variants.curves[name]):
            for order in range(min(3, len(curve.c))):
                found[order, k] = curve(own.t, order)[:, 1:].T / unit**order
        values[name] = found.reshape(3, 6, -1)
    return stacked(values, np.tile(own.t, count), np.tile(own.support, (count, 1)), unit)


def stacked(
    values: Mapping[str, Array], t: Array, support: NDArray[np.bool_], unit: float
) -> GaitMotion:
    """A motion from coordinates with their rates and accelerations.

    Args:
        values: Of each body, per second, shape ``(3, 6, n)``.
        t: Times in the gait's unit, ``(n,)``.
        support: Feet in support, ``(n, 2)``.
        unit: Seconds in that unit.
    """
    bodies = []
    for name in BODIES:
        found, rates, second = values[name]
        turns = euler_placement("xyz", found[3:].T, rates[3:].T, second[3:].T)
        rotation, omega, alpha = turns
        place, velocity, acceleration = (part[:3].copy().T for part in (found, rates, second))
        bodies.append(BodyMotion(rotation, place, velocity, acceleration, omega, alpha))
    torso, left, right = bodies
    return GaitMotion(t * unit, t, support, torso, left, right)


def _rows(numbers: Sequence[int], count: int) -> NDArray[np.intp]:
    """Rows of some motions in a stack."""
    return (np.asarray(numbers, dtype=np.intp)[:, None] * count + np.arange(count)).ravel()


def _survivors(
    numbers: Sequence[int], work: Callable[[Sequence[int]], Result]
) -> tuple[list[int], Result]:
    """What comes out of all motions of a stack, or of those that can be worked out."""
    try:
        return list(numbers), work(numbers)
    except ThesisPinError as error:
        alive = []
        for number in numbers:
            with suppress(ThesisPinError):
                work([number])
                alive.append(number)
        if not alive:
            raise error
        return alive, work(alive)


def extremes_of(
    robot: Scout, joints: JointTrajectory, dynamics: ContactDynamics, margin: np.ndarray
) -> list[int]:
    """Samples of the least margins and of the largest torques and uses of a servo.

    Args:
        robot: The biped.
        joints: Joint trajectory of the gait itself.
        dynamics: Its torques and floor wrenches.
        margin: Its margins [m], shape ``(n,)``.
    """
    torque = np.abs(dynamics.torque)
    use = torque / robot.stall_torque + np.abs(joints.v) / robot.no_load_speed
    single = np.where(dynamics.support, dynamics.contact_margin, np.inf).min(axis=1)
    found = [margin.argmin(), single.argmin(), *torque.argmax(axis=0), *use.argmax(axis=0)]
    return [int(sample) for sample in found]
