"""Any robot as a page of sliders, and the page served on this machine."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from thesis_pin.errors import ThesisPinError
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.checking.poses import named_pose, neutral
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.live.joints import JointRig, why_open
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.live.page import PATH, LivePage
from thesis_pin.pages.serving import show_page

if TYPE_CHECKING:  # whoever moves sliders in our own page needs no meshcat
    from thesis_pin.pages.meshcat.display import SceneViewer

_LOG = logging.getLogger(__name__)


def slider_page(
    robot: ClosedRobot,
    pose: str | None = None,
    *,
    precision: float | None = None,
    command: str = "thesis_pin.show_sliders(page)",
) -> LivePage:
    """Any robot with a slider for each joint; its loops stay closed.

    Args:
        robot: The robot.
        pose: Where it stands at first, or where its loops are closed from; see
            :func:`thesis_pin.loops.checking.poses.named_pose`. None is the neutral pose.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        command: What shows the page with sliders that move, for pages whose don't.

    Returns:
        The page; ``html()`` is one for a file. Where the loops don't close, or nobody can tell
        how, its ``notes`` say so, and joints move one by one.

    Raises:
        UnknownName, BadInput: There is no such pose.
    """
    instance("robot", robot, ClosedRobot, "thesis_pin.load()")
    q, why = neutral(robot) if pose is None else named_pose(robot, pose), ""
    if robot.equations:
        try:
            found = assembly(robot, pose, precision=precision)
            q, why = found.q, why_open(found)
        except ThesisPinError as error:
            why = f"the loops aren't kept closed: {error}"
    drawn = layers(robot, q)
    rig = JointRig(robot, q, drawn.size, open_because=why, precision=precision)
    notes = [*robot.description.warnings, *([why] if why else [])]
    if not rig.sliders:
        notes.append("no joint of it moves; a root that flies freely would (--free-flyer)")
    return LivePage(rig, drawn, robot.model.name, command, notes=notes)


def show_sliders(
    page: LivePage,
    *,
    port: int | None = None,
    browser: bool = True,
    hold: float | None = None,
    say: Callable[[str], None] = _LOG.warning,
    ready: Callable[[str], None] | None = None,
    meshcat: SceneViewer | None = None,
) -> None:
    """Serve a page of sliders on 127.0.0.1 until interrupted (Ctrl-C) or ``hold`` has passed.

    Args:
        page: The page.
        port: See :func:`thesis_pin.pages.serving.show`.
        browser: The same.
        hold: The same.
        say: The same.
        ready: The same.
        meshcat: Where the robot is shown instead of our own picture, as
            ``thesis_pin.pages.meshcat.display.show(page.scene())``: the page has meshcat's own
            beside its sliders, and every other page of that server follows them too.

    Raises:
        BadInput: The port is taken or not allowed.
    """
    instance("page", page, LivePage, "slider_page()")
    url = "" if meshcat is None else meshcat.url
    if url:
        say(f"the robot stands in meshcat at {url}")

    def answer(body: bytes) -> bytes | None:
        return page.answer(body, None if meshcat is None else meshcat.move)

    show_page(
        page.html(served=True, meshcat=url),
        page.title,
        port=port,
        browser=browser,
        hold=hold,
        say=say,
        ready=ready,
        answers={PATH: answer},
        also=[urlsplit(url).port or 80] if url else (),
    )
