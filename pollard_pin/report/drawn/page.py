"""The trajectory report as a page one can mail."""

from __future__ import annotations

from pollard_pin.report.document import TrajectoryReport
from pollard_pin.report.drawn.curves import plots
from pollard_pin.report.drawn.view import path_scene
from pollard_pin.report.tables import motors_table
from pollard_pin.report.uncertainty.document import open_table
from pollard_pin.specification import JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.pages.page import Page, Tile, closing_tables, html
from thesis_pin.report.tables import Table
from thesis_pin.report.uncertainty.document import columns_table


def trajectory_page(report: TrajectoryReport) -> bytes:
    """A trajectory report as one self-contained HTML file.

    Args:
        report: The report; plots show every peak of its curves.
    """
    return html(page_of(report))


def page_of(report: TrajectoryReport) -> Page:
    """The same before it becomes HTML."""
    return Page(
        title=f"{report.robot.specification.name.capitalize()}: path {report.path.name}",
        subtitle=f"{report.path.duration:.4g} s, branch {report.branch}, "
        f"{report.robot.inertia} inertias, {len(report.joints.time)} samples",
        good=report.within_limits,
        verdict=[
            *(f"Warning: {one}." for one in (*report.foreign, *report.doubts())),
            *report.verdict(),
            *(f"Note: {note}." for note in report.path.notes),
        ],
        tiles=tiles(report),
        plots=plots(report),
        tables=_tables(report),
        scene=path_scene(report),
    )


def tiles(report: TrajectoryReport) -> list[Tile]:
    """The report's key numbers."""
    a = report.actuators
    return [
        Tile("peak torque at the base", f"{a.peak_torque[:3].max():.3f} N·m"),
        Tile("peak torque in the wrist", f"{a.peak_torque[3:].max() * 1e3:.1f} mN·m"),
        Tile("peak power of a motor", f"{a.peak_power.max():.3f} W"),
        Tile("work given by the motors", f"{a.positive_work.sum():.3f} J"),
        Tile("peak ball-joint force", f"{report.loop_force_size.max():.2f} N"),
        Tile("fastest spray tip", f"{report.tool_speed.max():.3f} m/s"),
        Tile("least reach margin", f"{report.solutions.margin.min():z.3f}"),
        Tile("largest condition number", f"{report.holding.condition.max():.1f}"),
        Tile("loops open by, most", f"{report.solutions.loop_residual.max():.1e} m"),
    ]


def _open(report: TrajectoryReport) -> list[Table]:
    """What samples of finite resolution leave open, and what they resolve."""
    held, variants = report.headlines, report.path.variants
    if held is None or variants is None:
        return []
    return [open_table(held), columns_table(variants.columns, variants.rate)]


def _tables(report: TrajectoryReport) -> list[Table]:
    joints = Table(
        "Joint reactions, peaks",
        ("joint", "", "force N", "moment N·m"),
        [
            (name, JOINT_SYMBOLS[k], f"{force:.3f}", f"{moment:.4f}")
            for k, (name, force, moment) in enumerate(
                zip(JOINT_NAMES, *report.peak_reactions, strict=True)
            )
        ],
    )
    return [
        motors_table(report),
        *_open(report),
        joints,
        *closing_tables(report.assumptions(), report.parameters),
    ]
