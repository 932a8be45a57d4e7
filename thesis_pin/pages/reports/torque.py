"""A torque report of any robot as a page one can mail: view, plots, tables."""

from __future__ import annotations

import os
from collections.abc import Iterable

from thesis_pin.display.counted import counted
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.pages.page import Page, Tile, html, parameters_table, software
from thesis_pin.pages.reports.torque_scene import scene
from thesis_pin.report.tables import Table
from thesis_pin.report.torque.curves import plots
from thesis_pin.report.torque.document import TorqueReport
from thesis_pin.report.torque.tables import loops_table, motors_table
from thesis_pin.report.torque.uncertainty import open_table
from thesis_pin.report.torque.verdict import carried
from thesis_pin.report.uncertainty.document import columns_table


def torque_page(report: TorqueReport) -> bytes:
    """A torque report as one self-contained HTML file.

    Args:
        report: The report; plots show every peak of its curves.
    """
    return html(page_of(report))


def page_of(report: TorqueReport) -> Page:
    """The same before it becomes HTML."""
    time = report.joints.time
    return Page(
        title=f"{report.robot.model.name}: {report.motion.name}",
        subtitle=f"{time[-1] - time[0]:.4g} s, {len(time)} samples, "
        f"{counted(len(report.names), 'motor')}",
        good=report.within_limits,
        verdict=[
            *report.doubts(),
            *report.verdict(),
            *(f"{note}." for note in report.notes()),
            *without_folder(report.robot, report.warnings()),
        ],
        tiles=tiles(report),
        plots=plots(report),
        tables=[*motors_tables(report), parameters_table(report.parameters), software()],
        scene=scene(report),
    )


def peak_tiles(report: TorqueReport) -> list[Tile]:
    """The largest torque of a motor that turns, and the largest force of one that slides."""
    peak = report.actuators.peak_torque
    return [
        Tile(f"peak {word}", f"{peak[chosen].max():.4g} {unit}")
        for word, unit, chosen in (
            ("torque", "N·m", report.turning),
            ("force", "N", ~report.turning),
        )
        if chosen.any()
    ]


def without_folder(robot: ClosedRobot, sentences: Iterable[str]) -> list[str]:
    """Sentences that name the description's file, not where it lies on this machine."""
    file = robot.description.where
    return [one.replace(file, os.path.basename(file)) for one in sentences]


def tiles(report: TorqueReport) -> list[Tile]:
    """The report's key numbers."""
    a = report.actuators
    tiles = [
        *peak_tiles(report),
        Tile("peak power of a motor", f"{a.peak_power.max(initial=0.0):.4g} W"),
        Tile("work given by the motors", f"{a.positive_work.sum():.4g} J"),
    ]
    if report.robot.loops:
        tiles.append(Tile("peak loop force", f"{report.loop_force_size.max():.4g} N"))
    return [*tiles, Tile("unexplained load", f"{report.unexplained.max():.1e}", carried(report))]


def motors_tables(report: TorqueReport) -> list[Table]:
    """What the motors and the loops bear, and between which values; for pages."""
    loops = [loops_table(report)] if report.robot.loops else []
    held, variants, opened = report.headlines, report.motion.variants, list[Table]()
    if held is not None and variants is not None:
        opened = [
            open_table(held, report.names),
            columns_table(variants.columns, variants.rate),
        ]
    return [motors_table(report), *opened, *loops]
