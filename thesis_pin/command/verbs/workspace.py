"""The verb ``workspace`` of ``thesis-pin``; imported when it runs."""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray

from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.flags.numbers import quantity
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.results import put, write_results
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.verbs.any_robot import loaded
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.workspace.conditioning import LENGTH
from thesis_pin.loops.workspace.grid import ranges_of, unit_of, units_of
from thesis_pin.loops.workspace.mapped import evaluate_workspace
from thesis_pin.numeric.checks import shown
from thesis_pin.report.workspace import document as written
from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.tables.doubts import doubted
from thesis_pin.tables.table import Column

Array = NDArray[np.float64]


def workspace(arguments: argparse.Namespace) -> ExitCode:
    """Map where a robot can go, and how well its motors hold it there."""
    style = figure_style(arguments)
    files: dict[str, bytes] = {}
    page = b""
    with Bar("mapping the workspace") as bar:
        robot = loaded(arguments)
        with warned():
            along, at = _grid(arguments, robot)
            space = evaluate_workspace(
                robot,
                along,
                at=at,
                frame=arguments.frame,
                length=LENGTH if arguments.length is None else arguments.length,
                pose=assembly(robot, arguments.pose, precision=arguments.precision).q,
                precision=arguments.precision,
                progress=bar,
            )
        wanted = arguments.json or arguments.out
        content = json_bytes(written.document(space)) if wanted else b""
        if arguments.out:
            from thesis_pin.report.plotting.wanted import written_as
            from thesis_pin.report.workspace.figures import workspace_files

            table = csv_bytes(written.columns(space))
            files = {"workspace.json": content, "workspace.csv": table}
            with written_as(style):
                files |= workspace_files(space)
        if arguments.html:
            from thesis_pin.pages.reports.workspace import workspace_page

            page = workspace_page(space)
    write_results(arguments, files, content)
    if arguments.html:
        put(arguments.html, page)
    if free(arguments):
        print_parts(written.told(space))
    return ExitCode.DONE if space.reachable.any() else ExitCode.NO


def _grid(
    arguments: argparse.Namespace, robot: ClosedRobot
) -> tuple[dict[str, Array], dict[str, float]]:
    """The axes that the arguments name, and what stands still; the motors' ranges without any."""
    units = units_of(robot, arguments.frame)
    along: dict[str, Array] = {}
    plain: list[Column] = []  # what is written in metres or radians
    for name, *ends in arguments.along:
        own, factor = unit_of(name, units)
        start, end = (quantity("--along", text) * factor for text in ends)
        if not start < end:
            raise BadInput(
                f"--along {name} goes from {ends[0]} to {ends[1]}", allowed="ascending values"
            )
        if own in along:
            raise BadInput(f"--along is given twice for {shown(own)}")
        along[own] = np.linspace(start, end, arguments.points)
        if factor == 1.0:
            plain.append(Column(own, along[own], heading=own))
    at: dict[str, float] = {}
    for name, text in arguments.at:
        own, factor = unit_of(name, units)
        if own in at:
            raise BadInput(f"--at is given twice for {shown(own)}")
        at[own] = quantity("--at", text) * factor
        if factor == 1.0:
            plain.append(Column(own, np.array([at[own]]), heading=own))
    lengths, angles = ([one for one in plain if units[one.name] == u] for u in ("m", "rad"))
    doubted("--along, --at", lengths, angles)
    return along or ranges_of(robot, arguments.points), at
