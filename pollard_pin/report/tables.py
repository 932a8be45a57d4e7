"""Tables and small documents of the command ``pollard-pin``."""

from __future__ import annotations

import numpy as np

from pollard_pin.coordinates import POSE_NAMES
from pollard_pin.kinematics.forward import Assemblies
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.command.output import print_table, print_text
from thesis_pin.report import branches


def print_report(report: TrajectoryReport) -> None:
    """Print the summary of a trajectory report."""
    a, time = report.actuators, report.joints.time
    three = report.three is not None
    rows = []
    for k, symbol in enumerate(ACTUATOR_SYMBOLS[: 3 if three else 6]):
        rows.append(
            (
                symbol,
                f"{a.peak_torque[k]:.4f}",
                f"{a.rms_torque[k]:.4f}",
                f"{a.peak_speed[k]:.3f}",
                f"{a.peak_power[k]:.4f}",
                f"{a.positive_work[k]:.4f}",
                f"{a.negative_work[k]:.4f}",
                f"{a.net_work[k]:.5f}",
            )
        )
    print_table(
        ("motor", "peak", "RMS", "speed", "power", "work +", "work −", "net"),
        rows,
        title=f"{report.robot.specification.name} on {report.path.name}, "
        f"{report.path.duration:g} s, {report.robot.inertia} inertias "
        "(N·m, rad/s, W, J)",
    )
    condition, margin = report.holding.condition, report.solutions.margin
    reading, other = report.other_reading
    force, joint_force = report.loop_force_size.max(axis=0), report.peak_reactions[0]
    joint = int(np.argmax(joint_force))
    if not three:
        print_text(
            f"Energy: the motors' net work is {report.work_done[-1].sum() * 1e3:.4f} mJ, the "
            f"robot's energy changes by {report.energy_change * 1e3:.4f} mJ."
        )
    print_text(
        f"Loop reactions: up to {force[0]:.3f} N and {force[1]:.3f} N in the ball joints; the "
        f"most loaded other joint is {JOINT_NAMES[joint]} with "
        f"{joint_force[joint]:.2f} N.",
        f"Actuation: condition number {condition.min():.2f} to {condition.max():.2f} "
        f"(largest at t = {time[condition.argmax()]:.3f} s), determinant of constant sign. "
        f"Reach margin at least {margin.min():.3f} (t = {time[margin.argmin()]:.3f} s).",
        f"With {reading} inertias the base motors of six would peak at "
        f"{', '.join(f'{value:.3f}' for value in other[:3])} N·m.",
        "",
        *report.verdict(),
        "",
        "These numbers rest on assumptions:",
        *(
            f"- {str(one['name']).replace('_', ' ')}{_values(one)}: {one['why']}"
            for one in report.assumptions()
        ),
    )


def _values(assumption: dict[str, object]) -> str:
    """The numbers of an assumption in brackets, if they are few."""
    parts = [
        f"{key.replace('_', ' ')} {value}"
        for key, value in assumption.items()
        if key not in ("name", "why", "link", "inertia", "inertia_convention")
    ]
    return f" ({', '.join(parts)})" if 0 < len(parts) <= 4 else ""


def ik_document(robot: Pollard, solutions: Solutions) -> dict[str, object]:
    """Inverse kinematics of one pose on several branches, JSON-ready."""
    own = {
        "margin": (solutions.margin, True),
        "loop_residual": (solutions.loop_residual, False),
        "rod_angles": (solutions.rod_angles, False),
    }
    return branches.document(
        "pollard-pin",
        robot.specification.name,
        joints=JOINT_NAMES,
        coordinates=POSE_NAMES,
        pose=solutions.pose.reshape(6),
        branches=[
            branches.branch(solutions, k, str(one), solutions.explain(k), **own)
            for k, one in enumerate(solutions.branches)
        ],
        explanation=_best(solutions),
    )


def print_solutions(solutions: Solutions) -> None:
    """Print joint angles of one pose: two tables, a row a branch."""
    for title, joints in (("chain 0", range(6)), ("chains 1 and 2", range(6, 12))):
        rows = []
        for k, branch in enumerate(solutions.branches):
            if not solutions.reachable[k]:
                continue
            angles = [f"{np.degrees(solutions.angles[k, j]):.3f}" for j in joints]
            rows.append((str(branch), *angles))
        if rows:
            columns = ("branch", *(JOINT_SYMBOLS[j] for j in joints))
            print_table(columns, rows, title=f"{title}, degrees")
    print_text(_best(solutions))


def _best(solutions: Solutions) -> str:
    """How many branches are valid, and what can be said of the best."""
    labels = solutions.branches
    best = labels.index(DEFAULT_BRANCH) if DEFAULT_BRANCH in labels else 0
    best = best if solutions.valid[best] else int(np.argmax(solutions.valid))
    return (
        f"{int(solutions.valid.sum())} of {len(labels)} branches are valid. "
        f"{labels[best]}: {solutions.explain(best)}."
    )


def fk_document(robot: Pollard, modes: Assemblies) -> dict[str, object]:
    """Assembly modes of one set of motor angles, JSON-ready."""
    return {
        "schema": "pollard-pin/forward-kinematics",
        "version": 1,
        "robot": robot.specification.name,
        "actuators": list(ACTUATOR_NAMES),
        "joints": list(JOINT_NAMES),
        "modes": [
            {
                "branch": str(robot.branch_of(modes.angles[k])),
                "pose": modes.pose[k],
                "angles": modes.angles[k],
                "residual": float(modes.residual[k]),
                "outside_limits": [JOINT_NAMES[j] for j in np.flatnonzero(modes.outside[k])],
            }
            for k in range(int(modes.count))
        ],
    }


def print_modes(robot: Pollard, modes: Assemblies) -> None:
    """Print the assembly modes of one set of motor angles."""
    rows = []
    for k in range(int(modes.count)):
        pose = [f"{value:.4f}" for value in modes.pose[k, :3]]
        pose += [f"{value:.2f}" for value in np.degrees(modes.pose[k, 3:])]
        rows.append((str(robot.branch_of(modes.angles[k])), *pose))
    if rows:
        print_table(("branch", *POSE_NAMES), rows, title="assembly modes, metres and degrees")
    worst = float(np.nanmax(modes.residual))
    print_text(
        f"{len(rows)} assembly modes; ball joints closed to {worst:.0e} m.",
        *(
            f"{robot.branch_of(modes.angles[k])} is outside the joint limits: "
            f"{', '.join(JOINT_SYMBOLS[j] for j in np.flatnonzero(modes.outside[k]))}."
            for k in range(len(rows))
            if modes.outside[k].any()
        ),
    )
