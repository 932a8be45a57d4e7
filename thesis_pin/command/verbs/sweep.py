"""What ``sweep`` does for any robot that has a study."""

from __future__ import annotations

import argparse
import time
from typing import cast

from thesis_pin.command.flags.drawn_as import figure_style
from thesis_pin.command.output import print_parts
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import Robot, found
from thesis_pin.command.results import put, put_folder
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.text import say
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput
from thesis_pin.report.tables import Table
from thesis_pin.sweep.chosen.wishes import misses
from thesis_pin.sweep.designs.keys import dotted, leaves, matching, value_at
from thesis_pin.sweep.designs.making import Designs, joined, listed
from thesis_pin.sweep.running.runner import Interrupted, chunks, sweep_designs, usual_jobs
from thesis_pin.sweep.shown.choice import Choice, shown
from thesis_pin.sweep.study import Row, Study, judged, make_designs

_NAMED = 12
"""Designs that a dry run lists."""
_TIMED, _PATIENCE = 5, 3.0
"""Designs that say in it how long all take, and seconds after which no further one is tried."""


def run(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Judge every design that the arguments ask for, or list keys, or say what it would take."""
    _refuse(arguments)
    style = figure_style(arguments)
    with warned():
        study = cast(Study, found(robot.name_of(robot.study))(arguments))  # type: ignore[operator]
    if arguments.keys is not None:
        print_parts([_keys(study, arguments.keys)])
        return ExitCode.DONE
    designs = designs_of(study, arguments)
    Choice.check(study, designs, arguments.pareto, arguments.wish)
    jobs = arguments.jobs or usual_jobs()
    if arguments.dry_run:
        print_parts(_dry(study, designs, jobs))
        return ExitCode.DONE
    with Bar("judging designs", left=True) as bar:
        who = arguments.scheduler or f"{jobs} process{'es' * (jobs != 1)}"
        say(f"judging {len(designs):,} design{'s' * (len(designs) != 1)} by {who}")
        try:
            done = sweep_designs(
                study,
                designs,
                jobs=jobs,
                scheduler=arguments.scheduler,
                out=arguments.out,
                resume=arguments.resume,
                progress=bar,
            )
        except Interrupted as end:
            kept = "they stand in --out, and --resume goes on" if end.kept else "none is kept"
            say(f"{end.done:,} of {end.total:,} designs were done; {kept}")
            raise
    choice = Choice.of(done, arguments.pareto, arguments.wish)
    files, content, page = {}, b"", b""
    with Bar("drawing designs"):
        from thesis_pin.report.plotting.wanted import written_as
        from thesis_pin.report.writers import json_bytes
        from thesis_pin.sweep.shown.document import data_files, document
        from thesis_pin.sweep.shown.tables import summary

        if arguments.json:
            content = json_bytes(document(choice, robot.command))
        if arguments.out:
            from thesis_pin.sweep.shown.drawn import figures

            files = data_files(choice, robot.command)
            with written_as(style):
                files |= figures(choice)
        if arguments.html:
            from thesis_pin.sweep.shown.page import sweep_page

            page = sweep_page(choice)
    if files:
        put_folder(arguments.out, files)
    if content:
        put(arguments.json, content)
    if page:
        put(arguments.html, page)
    for mistake in done.mistakes():
        say(f"warning: a design failed by a mistake of ours or with its process: {mistake}")
    if free(arguments):
        print_parts(summary(choice))
    if choice.best is None:
        return ExitCode.NO
    short = not done.feasible.any() or misses(done, choice.terms, choice.best)
    return ExitCode.NO if arguments.strict and short else ExitCode.DONE


def _refuse(arguments: argparse.Namespace) -> None:
    """Refuse flags that mean nothing beside each other.

    Raises:
        BadInput: There are such.
    """
    for flag, needs in (("random", "draw"), ("resume", "out")):
        if getattr(arguments, flag) and getattr(arguments, needs) is None:
            raise BadInput(f"--{flag} means nothing without --{needs}", remedy=f"Add --{needs}")
    if arguments.seed and arguments.draw is None:
        raise BadInput("--seed means nothing without --draw", remedy="Add --draw")
    if arguments.pair and arguments.draw is not None:
        raise BadInput("--pair means nothing beside --draw", remedy="Leave one of them out")
    if arguments.jobs is not None and arguments.scheduler is not None:
        raise BadInput(
            "--jobs means nothing beside --scheduler, whose workers are its own",
            remedy="Leave one of them out",
        )
    if arguments.vary is None and arguments.keys is None:
        for flag in ("pair", "draw"):
            if getattr(arguments, flag):
                raise BadInput(f"--{flag} means nothing without --vary", remedy="Add --vary")


def designs_of(study: Study, arguments: argparse.Namespace) -> Designs:
    """The designs that the arguments ask for.

    Raises:
        UnknownName: There is no such key.
        BadInput: Nothing varies, or values can't be read.
    """
    made = None
    if arguments.vary:
        made = make_designs(
            study,
            arguments.vary,
            pair=arguments.pair,
            draw=arguments.draw,
            seed=arguments.seed,
            how="random" if arguments.random else "latin",
        )
    if arguments.designs is not None:
        table = _table(study, arguments.designs)
        made = table if made is None else joined(table, made)
    if made is None:
        raise BadInput(
            "nothing varies",
            remedy="Say what: --vary KEY=VALUES or --designs FILE; --keys '*' lists the keys",
        )
    return made


def _table(study: Study, file: str) -> Designs:
    """Designs from a table, however it is written."""
    from thesis_pin.tables.dialect import NUMBER
    from thesis_pin.tables.reading import read_table

    table = read_table("table of designs", file)
    comma = table.dialect.decimal == ","

    def word(cell: str) -> str:
        bare = cell.removesuffix("%")
        return cell.replace(",", ".") if comma and NUMBER.fullmatch(bare) else cell

    table.refuse_repeats()
    columns = {
        heading: [word(row[k]) for row in table.rows] for k, heading in enumerate(table.header)
    }
    return listed(study.base, columns, file)


def _keys(study: Study, pattern: str) -> Table:
    """Keys that can vary, with what they are."""
    keys = list(leaves(study.base)) if pattern == "*" else matching(study.base, pattern)
    rows = [(dotted(key), shown(value_at(study.base, key))) for key in keys]
    return Table("Keys", ("key", "is"), rows)


def _dry(study: Study, designs: Designs, jobs: int) -> list[Table | str]:
    """Which designs there are, and how long it takes, from judging some of them."""
    tasks = chunks(designs)
    first, times = _tried(study, designs)
    rows = [[str(k), *map(shown, values)] for k, values in enumerate(designs.values[:_NAMED])]
    what = f", the first {_NAMED}" if len(designs) > _NAMED else ""
    each = sum(times) / len(times)
    whole = each * len(designs) / jobs
    said = [
        f"{len(designs):,} design{'s' * (len(designs) != 1)} in {len(tasks):,} "
        f"chunk{'s' * (len(tasks) != 1)} of {len(tasks[0].designs)}; one takes {each * 1e3:.3g} ms "
        f"here (mean of {len(times)}), all about {_duration(whole)} with {jobs} free "
        f"processor{'s' * (jobs != 1)}.",
        f"The first one: {first.status}{f', {first.reason}' if first.reason else ''}.",
    ]
    heads = ["design", *(one.label for one in designs.parameters)]
    return [*said, Table(f"Designs{what}", heads, rows)]


def _tried(study: Study, designs: Designs) -> tuple[Row, list[float]]:
    """The first design's row, and seconds of designs from all over: those that fail take less."""
    row = judged(study, designs.data(study.base, 0), 0, designs.values[0])  # imports what it needs
    times: list[float] = []
    for k in sorted({n * (len(designs) - 1) // (_TIMED - 1) for n in range(_TIMED)}):
        began = time.perf_counter()
        judged(study, designs.data(study.base, k), k, designs.values[k])
        times.append(time.perf_counter() - began)
        if sum(times) > _PATIENCE:
            break
    return row, times


def _duration(seconds: float) -> str:
    for unit, size in (("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds:.3g} s"
