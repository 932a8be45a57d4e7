"""The gait report as a page one can mail."""

from __future__ import annotations

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.report.curves import plots
from scout_pin.report.document import GaitReport
from scout_pin.report.tables import joints_table
from scout_pin.report.verdict import digs, soles_collide
from scout_pin.report.view import gait_scene
from thesis_pin.pages.page import Page, Tile, closing_tables, html
from thesis_pin.pages.scene import thinned
from thesis_pin.report.tables import Table

MOST_SAMPLES = 1201
"""Of a plot."""


def gait_page(report: GaitReport) -> bytes:
    """A gait report as one self-contained HTML file.

    Args:
        report: The report; plots and animation show at most 1 201 of its samples.
    """
    seconds = report.joints.time[-1] - report.joints.time[0]
    return html(
        Page(
            title=f"{report.robot.specification.name.capitalize()}: gait {report.gait.name}",
            subtitle=f"{seconds:.4g} s, time unit {report.time_unit:g} s, "
            f"{len(report.joints.time)} samples. {report.gait.source}",
            good=report.within_limits,
            verdict=[
                *(f"Warning: {one}." for one in report.doubts()),
                *report.verdict(),
                *(f"Note: {note}." for note in report.gait.notes),
                *(f"Warning: {one}" for one in implausible(report.robot.specification)),
            ],
            tiles=_tiles(report),
            plots=plots(report, thinned(report.joints.time, MOST_SAMPLES)),
            tables=_tables(report),
            scene=gait_scene(report),
        )
    )


def _tiles(report: GaitReport) -> list[Tile]:
    use, fastest = report.servo_use.max(), report.fastest.line
    used = report.peak_friction_used
    return [
        Tile(
            "worst ZMP margin",
            f"{report.margin.min() * 1e3:z.1f} mm",
            bool(report.margin.min() > 0),
        ),
        Tile(
            "samples whose wrench the floor can give",
            f"{report.dynamics.admissible.mean():.1%}",
            bool(report.dynamics.admissible.all()),
        ),
        Tile("worst use of a servo's torque-speed line", f"{use:.0%}", bool(use <= 1)),
        Tile("peak torque", f"{report.actuators.peak_torque.max():.3f} N·m"),
        _clearance(report),
        Tile("soles apart, least", f"{report.sole_gap[0] * 1e3:.1f} mm", not soles_collide(report)),
        Tile("fastest time unit", "none" if fastest is None else f"{fastest:.4f} s"),
        Tile("work of all servos", f"{report.actuators.positive_work.sum() * 1e3:.0f} mJ"),
        Tile("friction used, most", "–" if used is None else f"{used:.0%}"),
    ]


def _clearance(report: GaitReport) -> Tile:
    """Mid-swing clearance; not good if a sole digs into the floor or scrapes."""
    if report.clearance is None:
        return Tile("mid-swing clearance", "no swing")
    good = not digs(report) and not any(swing.scrapes for swing in report.swings)
    return Tile("mid-swing clearance", f"{report.clearance * 1e3:z.1f} mm", good)


def _tables(report: GaitReport) -> list[Table]:
    return [
        joints_table(report),
        *_impacts(report),
        *closing_tables(report.assumptions(), report.parameters),
    ]


def _impacts(report: GaitReport) -> list[Table]:
    if not report.impacts:
        return []
    rows = [
        (
            impact.side,
            f"{impact.t * report.time_unit:.3f}",
            f"{-impact.foot_velocity[2] * 1e3:z.0f}",
            f"{impact.impulse[0, 2] * 1e3:z.1f}",
            f"{np.abs(impact.velocity_jump).max():.2f}",
            f"{impact.energy_lost * 1e3:z.2f}",
        )
        for impact in report.impacts
    ]
    columns = ("foot", "time s", "down mm/s", "impulse mN·s", "joints jump rad/s", "lost mJ")
    return [Table("Touchdowns", columns, rows)]
