"""The gait report as a page one can mail."""

from __future__ import annotations

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.report.document import GaitReport
from scout_pin.report.drawn.curves import plots
from scout_pin.report.drawn.view import gait_scene
from scout_pin.report.judged.limits import headline
from scout_pin.report.tables import joints_table
from scout_pin.report.uncertainty.document import open_table
from thesis_pin.pages.page import Page, Tile, closing_tables, html
from thesis_pin.report.tables import Table
from thesis_pin.report.uncertainty.document import columns_table
from thesis_pin.smoothing.intervals import Interval


def gait_page(report: GaitReport) -> bytes:
    """A gait report as one self-contained HTML file.

    Args:
        report: The report; its animation shows at most 1 201 of its samples, plots every peak.
    """
    return html(page_of(report))


def page_of(report: GaitReport) -> Page:
    """The same before it becomes HTML."""
    seconds = report.joints.time[-1] - report.joints.time[0]
    return Page(
        title=f"{report.robot.specification.name.capitalize()}: gait {report.gait.name}",
        subtitle=f"{seconds:.4g} s, time unit {report.time_unit:g} s, "
        f"{len(report.joints.time)} samples. {report.gait.source}",
        good=report.within_limits,
        verdict=[
            *(f"Warning: {one}." for one in (*report.foreign, *report.doubts())),
            *report.verdict(),
            *(f"Note: {note}." for note in report.gait.notes),
            *(f"Warning: {one}" for one in implausible(report.robot.specification)),
        ],
        tiles=tiles(report),
        plots=plots(report),
        tables=_tables(report),
        scene=gait_scene(report),
    )


def tiles(report: GaitReport) -> list[Tile]:
    """The report's key numbers."""
    use = report.servo_use.max()
    used, held = report.peak_friction_used, report.headlines
    margin = None if held is None else held.margin
    peaks = report.actuators.peak_torque
    most = None if held is None else held.peak_torque[int(peaks.argmax())]
    return [
        Tile(
            "worst ZMP margin",
            f"{report.margin.min() * 1e3:z.1f} mm" + _bounds(margin, 1e3, 1),
            _side(margin, float(report.margin.min()), 0.0),
        ),
        Tile(
            "samples whose wrench the floor can give",
            f"{report.dynamics.admissible.mean():.1%}",
            bool(report.dynamics.admissible.all()),
        ),
        Tile("worst use of a servo's torque-speed line", f"{use:.0%}", report.servos_carry),
        Tile("peak torque", f"{peaks.max():.3f} N·m" + _bounds(most, 1.0, 3)),
        _clearance(report),
        Tile("soles apart, least", f"{report.sole_gap[0] * 1e3:.1f} mm", not report.soles_collide),
        _time_units(report),
        Tile("work of all servos", f"{report.actuators.positive_work.sum() * 1e3:.0f} mJ"),
        Tile("friction used, most", "–" if used is None else f"{used:.0%}"),
    ]


def _bounds(held: Interval | None, factor: float, digits: int) -> str:
    """An interval behind its number; nothing if there is none."""
    if held is None:
        return ""
    return f" ({held.low * factor:z.{digits}f} to {held.high * factor:z.{digits}f})"


def _side(held: Interval | None, value: float, limit: float) -> bool | None:
    """Whether a number is above its limit; None if the samples can't say."""
    if held is None:
        return value > limit
    return {1: True, -1: False}.get(held.side(limit))


def _time_units(report: GaitReport) -> Tile:
    """The interval of time units at which it walks and is carried, nearest the given one."""
    found = headline(report.time_units, report.time_unit)
    if found is None:
        return Tile("time units at which it walks and is carried", "none", False)
    inside = found.shortest <= report.time_unit <= found.longest
    value = f"{found.shortest:.4g} to {found.longest:.4g} s"
    return Tile("time units at which it walks and is carried", value, inside)


def _clearance(report: GaitReport) -> Tile:
    """Mid-swing clearance; not good if a sole digs into the floor or scrapes."""
    if report.clearance is None:
        return Tile("mid-swing clearance", "no swing")
    good = not report.digs and not any(swing.scrapes for swing in report.swings)
    return Tile("mid-swing clearance", f"{report.clearance * 1e3:z.1f} mm", good)


def _tables(report: GaitReport) -> list[Table]:
    return [
        joints_table(report),
        *_open(report),
        *_impacts(report),
        *closing_tables(report.assumptions(), report.parameters),
    ]


def _open(report: GaitReport) -> list[Table]:
    """What samples of finite resolution leave open, and what they resolve."""
    held, variants = report.headlines, report.gait.variants
    if held is None or variants is None:
        return []
    return [open_table(held), columns_table(variants.columns, variants.rate / report.time_unit)]


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
