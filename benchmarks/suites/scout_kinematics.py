"""Scout's leg: inverse kinematics against EAIK, Newton's method and SciPy; rates."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import partial

import numpy as np
import pinocchio as pin
from machine import installed, wide_features
from measuring import Equal, Goal, Peer, Row, Scale
from peers.common import nearest
from peers.newton import Leg
from processes import measured_child

import scout_pin
from scout_pin.kinematics.branches import BRANCHES, taken_branches
from scout_pin.kinematics.following import leg_angles
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.kinematics.rates import leg_rates
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.report.branches import label

EVERY = "leg IK, all 8 branches"
ANGLES = "angles of the nearest branch [rad]"
_CHILD = """
import numpy as np, scout_pin
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.inverse import leg_inverse_kinematics
leg = scout_pin.load().legs["left"]
poses = leg_forward_kinematics(leg, np.random.default_rng(0).uniform(-1, 1, ({count}, 6)))
def work():
    leg_inverse_kinematics(leg, poses)
"""


def rows(scale: Scale) -> Iterator[Row]:
    """Every row, once its data are made."""
    robot = scout_pin.load()
    leg = robot.legs["left"]
    theta = np.random.default_rng(0).uniform(-1, 1, (scale.sizes[-1], 6))
    poses = leg_forward_kinematics(leg, theta)
    few = slice(scale.few)
    alone = Leg(robot, poses[few], theta[few] + 0.1)
    for size in scale.sizes:
        # A single pose as people have it; stacks as arrays.
        target = pin.SE3(poses[0]) if size == 1 else poses[:size]
        ours = partial(leg_inverse_kinematics, leg, target)
        yield Row(
            EVERY,
            size,
            ours,
            _eaik(robot, poses[: min(size, 2000)]),
            _equal_to_eaik(robot, poses[: min(size, 20)]),
            (Goal(1.6),) if size == 1 else (Goal(1 / 20),) if size >= 10_000 else (),
        )
    yield _one_branch(robot, poses[:1], theta[:1])
    stack = partial(leg_inverse_kinematics, leg, poses[: scale.many])

    def gap(theirs: list[np.ndarray]) -> float:
        angles = leg_inverse_kinematics(leg, poses[few]).angles
        return max(nearest(*pair) for pair in zip(angles, theirs, strict=True))

    newton, fsolve = (
        (Peer(name, scale.few, work), Equal(ANGLES, lambda work=work: gap(work()), allowed))
        for name, work, allowed in (
            ("Newton on Pinocchio", alone.newton, 1e-8),
            ("SciPy's fsolve", alone.fsolve, 1e-6),
        )
    )
    yield Row(EVERY, scale.many, stack, *newton, (Goal(1 / 500),))
    yield Row(EVERY, scale.many, stack, *fsolve)
    yield _without_wide_loops(scale)
    yield _rates(robot, alone, scale)


def _one_branch(robot: scout_pin.Scout, poses: np.ndarray, theta: np.ndarray) -> Row:
    """The branch that made a pose, against all branches of EAIK."""
    leg, pose = robot.legs["left"], pin.SE3(poses[0])
    signs = label(BRANCHES[int(taken_branches(leg, theta)[0])])

    def difference() -> float:
        return float(np.abs(leg_angles(leg, pose, signs) - theta[0]).max())

    return Row(
        "leg IK, one branch",
        1,
        partial(leg_angles, leg, pose, signs),
        _eaik(robot, poses),
        Equal("angles that made the pose [rad]", difference, 1e-9),
        (Goal(1.0),),
    )


def _eaik(robot: scout_pin.Scout, poses: np.ndarray) -> Peer:
    name = "EAIK, one call" if len(poses) == 1 else "EAIK, batched"
    if not installed("eaik"):
        return Peer(name, len(poses), None)
    from peers.eaik_leg import Eaik

    other = Eaik(robot.legs["left"], poses)
    return Peer(name, len(poses), other.single if len(poses) == 1 else other.batched)


def _equal_to_eaik(robot: scout_pin.Scout, poses: np.ndarray) -> Equal:
    """Both find as many branches, and the same."""
    leg = robot.legs["left"]

    def difference() -> float:
        from peers.eaik_leg import Eaik

        other, found = Eaik(leg, poses), leg_inverse_kinematics(leg, poses)
        worst = 0.0
        for k in range(len(poses)):
            theirs = other.angles(k)
            if len(theirs) != found.reachable[k].sum():
                return np.inf
            worst = max(worst, *(nearest(found.angles[k], one) for one in theirs))
        return worst

    return Equal(ANGLES, difference, 1e-6)


def _without_wide_loops(scale: Scale) -> Row:
    """As on processors without AVX-512, beside what this one can."""
    wide, count = wide_features(), scale.many
    environment = os.environ | {"NPY_DISABLE_CPU_FEATURES": " ".join(wide)} if wide else None
    text = _CHILD.format(count=count)
    ours, theirs = (
        partial(measured_child, text, 1 if scale.quick else 9, environment=one)
        for one in (environment, None)
    )
    what = "with it" if wide else "the same, as this processor has none"
    peer = Peer(what, count, theirs)
    return Row(f"{EVERY}, NumPy without AVX-512", count, ours, peer, None, (Goal(0.35, "µs"),))


def _rates(robot: scout_pin.Scout, alone: Leg, scale: Scale) -> Row:
    leg, count = robot.legs["left"], scale.many
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(count))
    seen, angles = (
        motion.left_foot.seen_from(motion.torso),
        joint_trajectory(robot, motion).q[:, :6],
    )
    few = slice(None, None, max(1, len(angles) // scale.few))
    some = seen.part(few)
    velocity = np.column_stack([some.velocity, some.omega])
    acceleration = np.column_stack([some.acceleration, some.alpha])
    theirs = partial(alone.rates, np.ascontiguousarray(angles[few]), velocity, acceleration)

    def difference() -> float:
        pairs = zip(leg_rates(leg, angles[few], some), theirs(), strict=True)
        return max(float(np.abs(a - b).max() / max(1.0, np.abs(b).max())) for a, b in pairs)

    return Row(
        "leg's rates and accelerations",
        len(angles),
        lambda: leg_rates(leg, angles, seen),
        Peer("Pinocchio's Jacobian, solved", len(velocity), theirs),
        Equal("rates and accelerations, relative", difference, 1e-8),
    )
