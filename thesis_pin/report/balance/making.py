"""Balance reports made: of a pose that is held, or of a motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.balance.carrying import total_mass
from thesis_pin.contacts.balance.dynamics import foot_dynamics, gravity_size
from thesis_pin.contacts.balance.result import FootDynamics
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.finding import find_feet
from thesis_pin.contacts.soles.foot import Foot, check_free
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.joints import singles
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.loops.motion.whole import whole_motion
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.trajectory import JointTrajectory
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.balance.drawn import Judge, drawn
from thesis_pin.report.balance.setting import HELD, Setting, held, moving
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.report.torque.nearby import Way
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

HELD_POSE = "held pose"
"""What the motion of a pose is called."""


def balance_report(
    robot: ClosedRobot,
    motion: JointMotion | None = None,
    *,
    pose: ArrayLike | None = None,
    placed: bool = False,
    feet: Sequence[Foot] | None = None,
    support: ArrayLike | None = None,
    floor: Floor | None = None,
    fitted: bool = False,
    sharing: str = "torque",
    precision: float | None = None,
    chosen: Sequence[str] = (),
) -> BalanceReport:
    """Say whether a robot keeps its balance, and what its motors and feet have to bear.

    A pose is held on all feet: the robot is put on the floor, unless its root is ``placed``. In a
    motion feet bear load where ``support`` says it, else where they are low and slow. A root
    that the motion doesn't tell follows from a sole that bears load all the time.

    Args:
        robot: From :func:`thesis_pin.load`, with a free root.
        motion: From :func:`thesis_pin.read_motion`; None to hold the pose.
        pose: Configuration that is held, or near the motion's start, shape ``(nq,)``; None for
            the least open of the description's.
        placed: Whether the pose's root is where it is to be.
        feet: They; None for a guess, see :func:`thesis_pin.find_feet`.
        support: Which feet bear load, booleans ``(n, feet)`` of a motion, ``(feet,)`` of a pose.
        floor: The floor; None for a level one: under a pose that isn't placed at height 0, else
            at the lowest that a foot gets.
        fitted: Whether the floor says its slope only: its height is taken as if there was none.
        sharing: See :func:`thesis_pin.foot_dynamics`.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        chosen: What somebody chose before, in sentences; for the verdict.

    Raises:
        BadInput: The root is tied to the world; or nothing says where it is.
        Unreachable, SingularPose, TrajectoryError, NoSolution: See :func:`torque_report`.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    check_free(robot)
    start = assembly(robot, precision=precision).q if pose is None else pose
    closed = close(robot, vector("pose", start, robot.model.nq), precision=precision)
    said = list(chosen)
    if feet is None:
        feet = find_feet(robot, pose=closed)
        said.append(f"Feet, which nobody named: {', '.join(foot.name for foot in feet)}.")
    said += _sources(feet)
    if motion is None:
        setting = held(robot, closed, placed, feet, floor, support, fitted)
        motion = JointMotion(
            HELD_POSE, HELD, tuple(singles(robot.model)), *_still(robot, setting.whole.joints)
        )
    else:
        instance("motion", motion, JointMotion, "thesis_pin.read_motion()")
        whole = whole_motion(robot, motion, closed, precision=precision)
        told = motion.base is not None and motion.tool is None
        setting = moving(robot, whole, feet, floor, support, told, fitted)
    joints, judge = setting.whole.joints, _judging(robot, feet, setting, sharing, precision)
    every = np.arange(len(joints.time))
    found = judge(joints.q, joints.v, joints.a, None, every)
    opened = None
    if motion.variants is not None:
        worst = int(found.violation.argmax()), int(found.margin.argmin())
        extremes = [*worst, *np.abs(found.torque).argmax(axis=0).tolist()]
        opened = drawn(Way(robot, motion, setting.whole, precision, {}), extremes, judge)
        if opened is not None and opened.motors.sliding is not None:
            del found  # of very many samples two don't fit into memory
            found = judge(joints.q, joints.v, joints.a, opened.motors.sliding, every)
    carried = replace(found.loops, base=found.loops.base[:, :0])
    motors = TorqueReport(
        robot, motion, setting.whole, carried, precision, None if opened is None else opened.motors
    )
    return BalanceReport(motors, found, motion.name == HELD_POSE, (*said, *setting.said), opened)


def _judging(
    robot: ClosedRobot,
    feet: Sequence[Foot],
    setting: Setting,
    sharing: str,
    precision: float | None,
) -> Judge:
    """What works out the contact forces of motions in a setting."""
    slack = TOLERANCES.balance * total_mass(robot) * gravity_size(robot)
    time = setting.whole.joints.time

    def judge(
        q: Array, v: Array, a: Array, sliding: Array | None, rows: NDArray[np.intp]
    ) -> FootDynamics:
        """Of one motion, at some samples of the setting's own."""
        moved = setting.placed(robot, JointTrajectory(time[rows], q, v, a))
        return foot_dynamics(
            robot,
            feet,
            moved.q,
            moved.v,
            moved.a,
            support=setting.stands[rows],
            floor=setting.floor,
            sharing=sharing,
            slack=slack,
            sliding=sliding,
            precision=precision,
        )

    return judge


def _sources(feet: Sequence[Foot]) -> list[str]:
    """Where the soles are from, alike ones together."""
    by: dict[str, list[str]] = {}
    for foot in feet:
        size = ""
        if foot.kind == "sole":
            length, width = np.ptp(foot.corners, axis=0) * 1e3
            size = f" of {length:.4g} × {width:.4g} mm"
        by.setdefault(f"{foot.kind}{size}, {foot.source}", []).append(foot.name)
    return [f"{', '.join(names)}: {what}." for what, names in by.items()]


def _still(robot: ClosedRobot, joints: JointTrajectory) -> tuple[Array, Array, Array]:
    columns = [one.position(joints.q) for one in singles(robot.model).values()]
    position = np.column_stack(columns)
    return position, np.zeros_like(position), np.zeros_like(position)
