"""What a gait report and inverse kinematics say: tables, paragraphs, small documents."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.implausible import implausible
from scout_pin.kinematics.branches import BRANCHES, knee
from scout_pin.kinematics.inverse import LegSolutions
from scout_pin.report.judged.servos import servo_limits
from scout_pin.specification import JOINT_SYMBOLS
from thesis_pin.report import branches
from thesis_pin.report.tables import Part, Table

if TYPE_CHECKING:  # inverse kinematics alone needs no report
    from scout_pin.model import Scout
    from scout_pin.report.document import GaitReport


_NARROW = (0, 1, 2, 3, 4, 5, 8)
"""Columns that a terminal has room for."""


def joints_table(report: GaitReport) -> Table:
    """What every joint has to do."""
    a = report.actuators
    columns = {
        "joint": a.names,
        "": JOINT_SYMBOLS,
        "peak N·m": [f"{value:.3f}" for value in a.peak_torque],
        "RMS N·m": [f"{value:.3f}" for value in a.rms_torque],
        "peak rad/s": [f"{value:.2f}" for value in a.peak_speed],
        "peak W": [f"{value:.3f}" for value in a.peak_power],
        "work + mJ": [f"{value * 1e3:.1f}" for value in a.positive_work],
        "work − mJ": [f"{value * 1e3:z.1f}" for value in a.negative_work],
        "servo": [f"{value:.0%}" for value in report.servo_use],
    }
    note = "'servo' is the worst |τ|/stall + |θ̇|/no-load, at most 100 %."
    return Table.of("Joints", columns, note)


def summary(report: GaitReport) -> Iterator[Part]:
    """A gait report in a table and paragraphs."""
    s, f, time = report.robot, report.fastest, report.joints.time
    yield joints_table(report).only(
        f"{s.specification.name}, gait {report.gait.name!r}: {time[-1] - time[0]:g} s, "
        f"time unit {report.time_unit:g} s, {len(time)} samples",
        _NARROW,
    )
    torque, line = (f"{x:.4f} s" if x is not None else "none" for x in (f.torque, f.line))
    used = report.peak_friction_used
    yield from (
        f"Servo limits: {'; '.join(servo_limits(s.specification))}; "
        "'servo' is |τ|/stall + |ω|/no-load, at most 100%.",
        f"Fastest time unit by speed {f.speed:.4f} s, by torque {torque}, by both (line) {line}.",
        f"ZMP margin: worst {_margin(report)}; stable in {report.stable_share:.1%} of the time.",
        f"Floor wrench: admissible in {report.dynamics.admissible.mean():.1%} of samples; "
        "friction used up to " + ("–." if used is None else f"{used:.0%}."),
        _clearance(report),
        f"The soles come within {report.sole_gap[0] * 1e3:.1f} mm of each other "
        f"(t = {report.motion.t[report.sole_gap[1]]:g}).",
    )
    yield from _left_out(report)
    yield report.stance.sentence()
    for impact in report.impacts:
        normal = impact.impulse[0, 2]
        yield (
            f"Touchdown of the {impact.side} foot at t = {impact.t:g}: "
            f"{-impact.foot_velocity[2] * 1e3:z.0f} mm/s down, impulse {normal * 1e3:z.1f} mN·s, "
            f"joints jump by {abs(impact.velocity_jump).max():.2f} rad/s, "
            f"{impact.energy_lost * 1e3:z.2f} mJ lost"
            + ("." if impact.admissible else "; the foot slips, tips or spins in it.")
        )
    if report.headlines is not None:
        from scout_pin.report.uncertainty.document import open_table

        yield open_table(report.headlines)
    yield from ("", *(f"Warning: {one}." for one in (*report.foreign, *report.doubts())))
    yield from (*report.verdict(), *(f"Note: {note}." for note in report.gait.notes))
    yield from (f"Warning: {one}" for one in implausible(s.specification))


def _left_out(report: GaitReport) -> Iterator[str]:
    """Which links are held against each other, if any, and which aren't."""
    found = report.collisions
    touching = ", ".join(" and ".join(pair) for pair in found.neutral)
    if found.judged:
        yield (
            f"Links that are held against each other and the soles: {', '.join(found.judged)}; "
            "left out: neighbours"
            + (f", and what touches in the neutral pose: {touching}." if touching else ".")
        )


def _margin(report: GaitReport) -> str:
    """The least margin, with its interval if samples leave it one."""
    if report.headlines is None:
        return f"{report.margin.min() * 1e3:z.1f} mm"
    from thesis_pin.report.resolution import millimetres

    return millimetres(report.headlines.margin)


def _clearance(report: GaitReport) -> str:
    """How high the feet swing."""
    if report.clearance is None or report.lowest_corner is None:
        return "No foot swings."
    low = min(report.swings, key=lambda swing: swing.clearance)
    return (
        f"Mid-swing clearance: {low.clearance * 1e3:z.1f} mm ({low.side} foot, t = {low.start:g} "
        f"to {low.end:g}); lowest corner of a swinging sole {report.lowest_corner * 1e3:z.1f} mm."
    )


def ik_document(
    robot: Scout,
    solutions: LegSolutions,
    pose: np.ndarray,
    only: int | Sequence[int] | None = None,
) -> dict[str, object]:
    """Inverse kinematics of one foot pose, JSON-ready.

    Args:
        robot: The biped.
        solutions: All branches of one pose.
        pose: The pose as asked for: x, y, z [m], pitch, roll, yaw [rad], ``(6,)``.
        only: Number of the branch to say, or several; None says all.
    """
    excess = (solutions.excess, True)
    return branches.document(
        "scout-pin",
        robot.specification.name,
        joints=solutions.geometry.names,
        coordinates=POSE_NAMES,
        pose=pose,
        branches=[
            branches.branch(
                solutions,
                k,
                branches.label(BRANCHES[k]),
                solutions.explain((), k),
                reach_excess=excess,
            )
            | {"knee": knee(solutions.geometry, k)}
            for k in _numbers(only)
        ],
        explanation=solutions.explain((), only),
    )


def _numbers(only: int | Sequence[int] | None) -> Sequence[int]:
    if only is None:
        return range(len(BRANCHES))
    return (only,) if isinstance(only, int) else only


def solutions_table(solutions: LegSolutions, only: int | Sequence[int] | None = None) -> list[Part]:
    """Joint angles of one pose, a row a branch; ``only`` as for :func:`ik_document`."""
    rows = []
    for k in _numbers(only):
        label = branches.label(BRANCHES[k])
        if not solutions.reachable[k]:
            rows.append((label, *[""] * 6, f"{solutions.excess[k] * 1e3:z.1f} mm off"))
            continue
        angles = [f"{value:z.2f}" for value in np.degrees(solutions.angles[k])]
        rows.append((label, *angles, "valid" if solutions.valid[k] else "limits"))
    side = solutions.geometry.names[0].split("_")[0]
    columns = ("branch", "hip yaw", "roll", "pitch", "knee", "ankle", "roll", "")
    text = solutions.explain((), only)
    return [
        Table(f"{side} leg, angles in degrees", columns, rows),
        text[0].upper() + text[1:] + ".",
    ]
