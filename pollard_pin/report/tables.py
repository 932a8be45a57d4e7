"""What a trajectory report and kinematics say: tables, paragraphs, small documents."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.coordinates import POSE_NAMES
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.display.counted import counted
from thesis_pin.report import branches
from thesis_pin.report.info import assumed_values
from thesis_pin.report.tables import Part, Table

if TYPE_CHECKING:  # inverse kinematics alone needs no report
    from pollard_pin.kinematics.forward import Assemblies
    from pollard_pin.report.document import TrajectoryReport


def motors_table(report: TrajectoryReport) -> Table:
    """What every motor has to do; the last column has the other reading's torques."""
    a, (reading, other) = report.actuators, report.other_reading
    columns = {
        "motor": a.names,
        "": ACTUATOR_SYMBOLS[: len(a.names)],
        "peak N·m": [f"{value:.4f}" for value in a.peak_torque],
        "RMS N·m": [f"{value:.4f}" for value in a.rms_torque],
        "peak rad/s": [f"{value:.3f}" for value in a.peak_speed],
        "peak W": [f"{value:.4f}" for value in a.peak_power],
        "work + J": [f"{value:.4f}" for value in a.positive_work],
        "work − J": [f"{value:z.4f}" for value in a.negative_work],
        "net J": [f"{value:z.5f}" for value in a.net_work],
        f"peak N·m, {reading}": [f"{value:.4f}" for value in other[: len(a.names)]],
    }
    note = "The last column has the other reading of the printed inertias."
    return Table.of("Motors", columns, note)


def summary(report: TrajectoryReport) -> Iterator[Part]:
    """A trajectory report in a table and paragraphs."""
    time = report.joints.time
    yield Table(
        f"{report.robot.specification.name} on {report.path.name}, {report.path.duration:g} s, "
        f"{report.robot.inertia} inertias (N·m, rad/s, W, J)",
        ("motor", "peak", "RMS", "speed", "power", "work +", "work −", "net"),
        [row[1:9] for row in motors_table(report).rows[: 6 if report.three is None else 3]],
    )
    condition, margin = report.holding.condition, report.solutions.margin
    tool = report.tool_speed
    reading, other = report.other_reading
    force, joint_force = report.loop_force_size.max(axis=0), report.peak_reactions[0]
    joint = int(np.argmax(joint_force))
    if report.three is None:
        yield (
            f"Energy: the motors' net work is {report.actuators.net_work.sum() * 1e3:z.4f} mJ, the "
            f"robot's energy changes by {report.energy_change * 1e3:z.4f} mJ."
        )
    yield from (
        f"Loop reactions: up to {force[0]:.3f} N and {force[1]:.3f} N in the ball joints; the "
        f"most loaded other joint is {JOINT_NAMES[joint]} with "
        f"{joint_force[joint]:.2f} N.",
        f"Actuation: condition number {condition.min():.2f} to {condition.max():.2f} "
        f"(largest at t = {time[condition.argmax()]:.3f} s), determinant of constant sign. "
        f"Reach margin at least {margin.min():z.3f} (t = {time[margin.argmin()]:.3f} s).",
        f"The spray tip moves at {tool.min():.4g} to {tool.max():.4g} m/s (fastest at "
        f"t = {time[tool.argmax()]:.3f} s).",
        f"With {reading} inertias the base motors of six would peak at "
        f"{', '.join(f'{value:.3f}' for value in other[:3])} N·m.",
    )
    if report.headlines is not None:
        from pollard_pin.report.uncertainty.document import open_table

        yield open_table(report.headlines)
    yield from (
        "",
        *(f"Warning: {one}." for one in (*report.foreign, *report.doubts())),
        *report.verdict(),
        *(f"Note: {note}." for note in report.path.notes),
        "",
        *resting_on(report.assumptions()),
    )


def resting_on(assumptions: Sequence[dict[str, object]]) -> Iterator[str]:
    """What numbers rest on, a line each."""
    yield "These numbers rest on assumptions:"
    for one in assumptions:
        yield f"- {str(one['name']).replace('_', ' ')}{_values(one)}: {one['why']}"


def _values(assumption: dict[str, object]) -> str:
    """The numbers of an assumption in brackets, if they are few."""
    hidden = ("name", "why", "link", "inertia", "inertia_convention")
    shown = {key: value for key, value in assumption.items() if key not in hidden}
    return f" ({assumed_values(shown)})" if 0 < len(shown) <= 4 else ""


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


def solutions_table(solutions: Solutions) -> Iterator[Part]:
    """Joint angles of one pose: two tables, a row a branch."""
    for title, joints in (("chain 0", range(6)), ("chains 1 and 2", range(6, 12))):
        rows = []
        for k, branch in enumerate(solutions.branches):
            if not solutions.reachable[k]:
                continue
            angles = [f"{np.degrees(solutions.angles[k, j]):z.3f}" for j in joints]
            rows.append((str(branch), *angles))
        if rows:
            columns = ("branch", *(JOINT_SYMBOLS[j] for j in joints))
            yield Table(f"{title}, degrees", columns, rows)
    yield _best(solutions)


def _best(solutions: Solutions) -> str:
    """How many branches are valid, and what can be said of the best."""
    labels = solutions.branches
    best = labels.index(DEFAULT_BRANCH) if DEFAULT_BRANCH in labels else 0
    best = best if solutions.valid[best] else int(np.argmax(solutions.valid))
    count = int(solutions.valid.sum())
    return (
        f"{count} of {len(labels)} branches {'is' if count == 1 else 'are'} valid. "
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


def modes_table(robot: Pollard, modes: Assemblies) -> Iterator[Part]:
    """The assembly modes of one set of motor angles."""
    rows = []
    for k in range(int(modes.count)):
        pose = [f"{value:z.4f}" for value in modes.pose[k, :3]]
        pose += [f"{value:z.2f}" for value in np.degrees(modes.pose[k, 3:])]
        rows.append((str(robot.branch_of(modes.angles[k])), *pose))
    if rows:
        yield Table("assembly modes, metres and degrees", ("branch", *POSE_NAMES), rows)
    worst = float(np.nanmax(modes.residual))
    yield from (
        f"{counted(len(rows), 'assembly mode')}; ball joints closed to {worst:.0e} m.",
        *(
            f"{robot.branch_of(modes.angles[k])} is outside the joint limits: "
            f"{', '.join(JOINT_SYMBOLS[j] for j in np.flatnonzero(modes.outside[k]))}."
            for k in range(len(rows))
            if modes.outside[k].any()
        ),
    )
