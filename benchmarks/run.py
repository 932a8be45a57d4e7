"""One table of ratios against peers, all measured in the same run.

Run ``python benchmarks/run.py``. Times are medians on this machine; only the
ratios mean anything elsewhere.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pollard

import scout_pin
from scout_pin.dynamics import (
    free_flyer_state,
    free_flying_forces,
    inverse_dynamics,
    joint_trajectory,
)
from scout_pin.forward import leg_forward_kinematics
from scout_pin.kinematics import leg_inverse_kinematics
from scout_pin.rates import leg_rates
from thesis_pin.command_line import print_table


def median_time(work: Callable[[], object], count: int, repeats: int = 7) -> float:
    """Median seconds per item of work on ``count`` items."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return float(np.median(times)) / count


def newton(model: pin.Model, frame: int, target: pin.SE3, start: np.ndarray) -> np.ndarray:
    """The usual loop on Pinocchio: damped Newton steps until the sole is there."""
    data, q = model.createData(), start.copy()
    for _ in range(100):
        pin.framesForwardKinematics(model, data, q)
        error = pin.log6(data.oMf[frame].actInv(target)).vector
        if np.linalg.norm(error) < 1e-10:
            break
        jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL)
        step = np.linalg.lstsq(jacobian, error, rcond=None)[0]
        q = pin.integrate(model, q, step)
    return q


def scout_kinematics(count: int = 20_000) -> list[tuple[str, float, str, float]]:
    """Leg inverse kinematics and rates: name, seconds, peer, its seconds."""
    robot = scout_pin.load()
    leg = robot.legs["left"]
    rng = np.random.default_rng(0)
    theta = rng.uniform(-1, 1, (count, 6))
    poses = leg_forward_kinematics(leg, theta)
    one = pin.SE3(poses[0])
    rows = []
    stack = median_time(lambda: leg_inverse_kinematics(leg, poses), count)
    single = median_time(lambda: [leg_inverse_kinematics(leg, one) for _ in range(200)], 200)
    # A leg of its own, fixed at the torso, for the numeric peer.
    names = [n for n in robot.model.names if n.startswith("right") or n == "root_joint"]
    alone = pin.buildReducedModel(
        robot.model, [robot.model.getJointId(n) for n in names], pin.neutral(robot.model)
    )
    frame = alone.getFrameId("left_sole")
    few = 100
    targets = [pin.SE3(pose) for pose in poses[:few]]
    numeric = median_time(
        lambda: [newton(alone, frame, t, s + 0.1) for t, s in zip(targets, theta, strict=False)],
        few,
        repeats=3,
    )
    rows.append(("leg IK, stack", stack, "Newton on Pinocchio", numeric))
    rows.append(("leg IK, one pose", single, "Newton on Pinocchio", numeric))
    try:
        from eaik.IK_HP import HPRobot
    except ImportError:
        pass
    else:
        letters = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}
        axes = np.array([letters[a] for a in "zyzzzx"])
        origins = np.array(
            [[leg.x_0, 0, 0], [0, 0, -leg.z_1], [leg.x_2, 0, 0], [leg.x_3, 0, 0],
             [leg.x_4, 0, 0], [leg.x_5, 0, 0], [0, leg.y_6, 0]]
        )  # fmt: skip
        other = HPRobot(axes, origins)
        turned = poses[:2000].copy()
        turned[:, :3, :3] = turned[:, :3, :3] @ leg.foot.T
        eaik = median_time(lambda: other.IK_batched(turned), 2000, repeats=3)
        rows.append(("leg IK, stack", stack, "EAIK, batched", eaik))
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(count))
    joints = joint_trajectory(robot, motion)
    seen = motion.left_foot.seen_from(motion.torso)
    rates = median_time(lambda: leg_rates(leg, joints.q[:, :6], seen), count)
    rows.append(("leg rates", rates, "leg IK, stack", stack))
    return rows


def scout_dynamics(count: int = 20_000) -> list[tuple[str, float, str, float]]:
    """Contact inverse dynamics against bare RNEA."""
    robot = scout_pin.load()
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(count))
    joints = joint_trajectory(robot, motion)
    state = free_flyer_state(motion.torso, joints)
    rnea = median_time(lambda: free_flying_forces(robot, *state), count)
    contact = median_time(lambda: inverse_dynamics(robot, motion, joints), count)
    whole = median_time(
        lambda: inverse_dynamics(robot, motion, joint_trajectory(robot, motion)), count
    )
    peer = "RNEA, one thread"
    return [
        ("contact inverse dynamics", contact, peer, rnea),
        ("task space to torques", whole, peer, rnea),
    ]


SUITES = [
    scout_kinematics,
    scout_dynamics,
    lambda: pollard.pollard_kinematics(median_time),
    lambda: pollard.pollard_dynamics(median_time),
]


def main() -> None:
    """Run every suite and print one table."""
    rows = []
    for suite in SUITES:
        for name, ours, peer, theirs in suite():
            cells = (name, f"{ours * 1e6:.2f}", peer, f"{theirs * 1e6:.2f}", f"{ours / theirs:.3g}")
            rows.append(cells)
    print_table(("work", "µs", "against", "µs", "ratio"), rows, title="Time per item")


if __name__ == "__main__":
    main()
