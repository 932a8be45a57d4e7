"""A balance report of any robot as a page one can mail: view, plots, tables."""

from __future__ import annotations

import numpy as np

from thesis_pin.display.counted import counted
from thesis_pin.pages.page import Page, Tile, html, parameters_table, software
from thesis_pin.pages.reports.balance_scene import scene
from thesis_pin.pages.reports.torque import motors_tables, peak_tiles, without_folder
from thesis_pin.report.balance.curves import plots
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.balance.tables import HELD_FEET, HELD_MOTORS, feet_table
from thesis_pin.report.tables import Table


def balance_page(report: BalanceReport) -> bytes:
    """A balance report as one self-contained HTML file.

    Args:
        report: The report; plots show every peak of its curves.
    """
    time, held = report.time, report.held
    span = "held" if held else f"{time[-1] - time[0]:.4g} s, {len(time)} samples"
    return html(
        Page(
            title=f"{report.robot.model.name}: {report.motors.motion.name}",
            subtitle=f"{span}, {counted(len(report.names), 'foot', 'feet')}, "
            f"{counted(len(report.motors.names), 'motor')}",
            good=report.within_limits,
            verdict=[
                *report.doubts(),
                *report.verdict(),
                *without_folder(report.robot, report.warnings()),
            ],
            tiles=_tiles(report),
            plots=plots(report),
            tables=_tables(report),
            scene=scene(report),
        )
    )


def _tiles(report: BalanceReport) -> list[Tile]:
    found, least = report.found, report.least_margin.value
    tiles = [Tile("the floor can give it", f"{report.given.mean():.0%}", report.supplied)]
    if np.isfinite(least) and report.level:
        # Outside by less than counts neither keeps the limit nor breaks it; what slips keeps it.
        good = True if least >= 0 else False if report.supplied is False else None
        good = None if report.supplied is None else good
        tiles.append(Tile("least margin", f"{least * 1e3:.3g} mm", good))
    if report.slides:
        fastest = max(one.speed for one in report.slides)
        sure = any(one.certain for one in report.slides)
        word = "feet slide at up to" if sure else "feet may slide, at up to"
        tiles.append(Tile(word, f"{fastest:.3g} m/s", False if sure else None))
    most = max(report.peak_friction)
    tiles.append(Tile("friction in use", f"{most:.0%}", most <= 1))
    tiles.append(Tile("largest force on a foot", f"{found.normal_force.max():.4g} N"))
    tiles += peak_tiles(report.motors)
    if use := float(report.motors.effort_use.max(initial=0.0)):
        tiles.append(Tile("of a motor's limit in use, at most", f"{use:.0%}", use <= 1))
    return tiles


def _tables(report: BalanceReport) -> list[Table]:
    # A floor that was found below the feet has their rounding.
    height = {"floor_height": round(report.found.floor.height, 6) + 0.0}
    closing = (parameters_table(report.parameters | height), software())
    feet, (motors, *more) = feet_table(report), motors_tables(report.motors)
    if report.held:  # rates and work are none, and the least is the most
        feet, motors = (
            feet.only(feet.title, (0, 1, *HELD_FEET[1:])),
            motors.only(motors.title, HELD_MOTORS),
        )
    return [feet, motors, *more, *closing]
