"""What the verbs of several commands do alike: report, show, answer, print a URDF."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from thesis_pin.command.flags.figured import chosen, without
from thesis_pin.command.flags.options import refuse_beside
from thesis_pin.command.planning import load, planned
from thesis_pin.command.progress import Bar
from thesis_pin.command.registry import Robot, found
from thesis_pin.command.results import (
    Answer,
    deliver,
    give,
    put,
    put_folder,
    said,
)
from thesis_pin.command.running import ExitCode, free
from thesis_pin.command.showing.beside import (
    TWO,
    Beside,
    asked,
    hooks_of,
    reports,
    scene_of,
    second_of,
)
from thesis_pin.command.showing.film import check_film, shoot, shown_first
from thesis_pin.command.showing.served import served, write_shown
from thesis_pin.command.warned import warned
from thesis_pin.errors import BadInput

if TYPE_CHECKING:  # help has to be quick
    from thesis_pin.pages.live.page import LivePage
    from thesis_pin.pages.scene import Scene
    from thesis_pin.report.exchange.movement import Movement


def report(robot: Robot, arguments: argparse.Namespace, what: str) -> ExitCode:
    """Report on a motion that the robot's own options ask for; see :func:`deliver`."""
    known: Mapping[str, str] = _hook(robot, robot.figure_numbers) if arguments.figure else {}
    names = chosen(arguments, known)

    def keep(files: dict[str, bytes]) -> dict[str, bytes]:
        return without(files, known, names)

    def samples(_: float) -> int:
        count: int = arguments.samples
        return count

    if asked(arguments):
        return deliver(
            arguments, what, lambda bar: _paired(robot, arguments, samples, bar), keep=keep, **TWO
        )
    return deliver(
        arguments,
        what,
        lambda bar: planned(robot, arguments, samples, bar),
        figures=robot.name_of(robot.figures),
        page=robot.name_of(robot.page),
        table=robot.name_of(robot.table),
        keep=keep,
    )


def _paired(
    robot: Robot, arguments: argparse.Namespace, samples: Callable[[float], int], bar: Bar
) -> Beside:
    """The reports on both motions that the arguments ask for."""
    first = planned(robot, arguments, samples, bar)
    second = planned(robot, second_of(arguments, robot.motion_flag), samples, bar)
    files = getattr(arguments, robot.motion_flag), arguments.beside
    return reports(hooks_of(robot), first, second, arguments.align, files)


def view(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Show a motion in the browser, or sliders that move the robot, or write it as a page."""
    if arguments.sliders:
        refuse_beside(arguments, "sliders", ("beside", "beside-robot", "align"))
        from thesis_pin.command.showing.sliders import show_sliders

        def page() -> LivePage:
            made: LivePage = _hook(robot, robot.sliders)(arguments, load(robot, arguments))
            return made

        return show_sliders(arguments, robot.command, page)

    def make(bar: Bar) -> Scene:
        from thesis_pin.pages.scene import frames

        if asked(arguments):
            return scene_of(_paired(robot, arguments, frames, bar))
        scene: Scene | None = None
        if robot.still:
            scene = _hook(robot, robot.still)(arguments, load(robot, arguments))
        if scene is None:
            scene = _hook(robot, robot.scene)(planned(robot, arguments, frames, bar))
        return scene

    return show_scene(arguments, robot.command, make)


def show_scene(
    arguments: argparse.Namespace, command: str, make: Callable[[Bar], Scene]
) -> ExitCode:
    """Show a scene in the browser, or write it as a page.

    Args:
        arguments: With what :func:`thesis_pin.command.flags.options.add_view` adds.
        command: Which command asks, for the schema's name.
        make: Makes the scene.
    """
    for written in ("html", "film", "picture"):
        refuse_beside(arguments, written, ("port", "hold", "no-browser", "meshcat"))
    check_film(arguments)
    if isinstance(arguments.meshcat, str):  # a server that runs already
        refuse_beside(arguments, "meshcat", ("port", "hold"))
    if arguments.meshcat is not None and arguments.look != "3d":
        raise BadInput("--look means nothing beside --meshcat", remedy="Leave one of them out")
    with Bar("working out the motion") as bar, warned():
        scene = shown_first(make(bar), arguments)
    shown = {
        "schema": f"{command}/view",
        "version": 1,
        "title": scene.title,
        "duration": float(scene.time[-1] - scene.time[0]),
        "samples": len(scene.time),
        "page": arguments.html,
        "film": arguments.film,
        "picture": arguments.picture,
        "meshcat": None,
    }
    if arguments.meshcat is not None:
        from thesis_pin.command.showing.meshcat import show_in_meshcat

        return show_in_meshcat(arguments, scene, shown)
    from thesis_pin.pages import player, serving

    if arguments.html:
        player.write_html(scene, arguments.html, speed=arguments.speed, look=arguments.look)
        said(arguments.html)
    shoot(scene, arguments)
    if arguments.html or arguments.film or arguments.picture:
        write_shown(arguments, shown, None)
        return ExitCode.DONE
    serving.show(scene, speed=arguments.speed, look=arguments.look, **served(arguments, shown))
    return ExitCode.DONE


def convert(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Write a motion in another form."""
    with Bar("working out the motion"):
        from thesis_pin.report.exchange.movement import content, form_of
        from thesis_pin.report.exchange.ticks import USUAL, read_servos
        from thesis_pin.report.writers import json_bytes
        from thesis_pin.tables.writing import WrittenUnits

        form = form_of(arguments.to, arguments.form)
        units = WrittenUnits() if arguments.units is None else WrittenUnits.parse(arguments.units)
        if arguments.servos is not None and form != "ticks":
            raise BadInput("--servos belongs to ticks", remedy="Add --as ticks")
        if arguments.units is not None and form == "joint-trajectory":
            raise BadInput("a joint trajectory is in SI", remedy="Leave --units out")
        loaded: Any = load(robot, arguments)
        with warned():
            motion: Movement = _hook(robot, robot.moves)(arguments, loaded)
        servos = USUAL
        if arguments.servos is not None:
            servos = read_servos(arguments.servos, motion.joints)
        tabs = arguments.to.lower().endswith(".tsv")
        made = content(motion, form, units, servos, tabs=tabs)
    put(arguments.to, made)
    if arguments.json:
        document = {
            "schema": f"{robot.command}/convert",
            "version": 1,
            "robot": loaded.specification.name,
            "file": arguments.to,
            "form": form,
            "samples": 0 if form == "toml" and motion.curves else len(motion.time),
            "duration": float(motion.time[-1] - motion.time[0]),
            "joints": list(motion.joints),
        }
        put(arguments.json, json_bytes(document))
    return ExitCode.DONE


def ik(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Inverse kinematics of one pose."""
    return give(arguments, lambda: _hook(robot, robot.solves)(arguments, load(robot, arguments)))


def info(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Say what a specification describes."""
    from thesis_pin.report.info import told

    def answer() -> Answer:
        loaded: Any = load(robot, arguments)
        document = _hook(robot, robot.info)(loaded)
        if arguments.html:
            pages.append(_hook(robot, robot.info_page)(loaded))
        return Answer(lambda: document, lambda: told(document))

    pages: list[bytes] = []
    code = give(arguments, answer)
    for page in pages:
        put(arguments.html, page)
    return code


def urdf(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """Print a URDF, or write every generated file into ``--out``."""
    with Bar("generating the files"):
        from thesis_pin.model.loading import check_urdf
        from thesis_pin.report.writers import json_bytes

        specification = _hook(robot, robot.specification)(arguments.specification)
        text: str = _hook(robot, robot.urdf)(specification, arguments.inertia)
        check_urdf(text, where=specification.name)
        made = _hook(robot, robot.files)(specification)
        files = {name: content.encode() for name, content in made.items()}
    document = {
        "schema": f"{robot.command}/urdf",
        "version": 1,
        "robot": specification.name,
        "inertia": arguments.inertia,
        "folder": str(arguments.out) if arguments.out else None,
        "files": [{"name": name, "bytes": len(content)} for name, content in files.items()],
    }
    if arguments.out:
        put_folder(arguments.out, files)
    if arguments.json:
        put(arguments.json, json_bytes(document))
    if not arguments.out and free(arguments):
        put("-", text.encode())
    return ExitCode.DONE


def audit(robot: Robot, arguments: argparse.Namespace) -> ExitCode:
    """A verdict on each printed equation of the thesis."""
    from thesis_pin.command.verbs.audit import run_verb

    refuse_beside(arguments, "equation", ("every",))
    return run_verb(arguments, _hook(robot, robot.thesis))


def _hook(robot: Robot, name: str) -> Any:
    """One of the robot's functions, imported when it is needed."""
    return found(robot.name_of(name))
