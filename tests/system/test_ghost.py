"""A second motion of the robot on its page, in a real browser."""

import numpy as np
import pytest
from chromium import differing

import pollard_pin
from pollard_pin.report.drawn.view import path_scene
from thesis_pin.pages import player
from thesis_pin.pages.ghost import with_ghost

pytestmark = pytest.mark.browser

AWAY = 0.05
"""How far the ghost's tool is from the robot's at the end [m]."""


@pytest.fixture(scope="module")
def ghost_file(folder):
    robot = pollard_pin.load()
    report = pollard_pin.trajectory_report(
        robot, pollard_pin.appendix_b(robot.specification), samples=241
    )
    drawn = path_scene(report)
    pose = report.motion.pose.copy()
    pose[:, 0] += AWAY * np.linspace(0, 1, len(pose))
    q = robot.inverse_kinematics(pose).angles
    page = player.html(with_ghost(drawn, robot.model, robot.visual_model, q))
    assert len(page) < 3e6
    (folder / "ghost.html").write_bytes(page)
    return folder / "ghost.html"


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (390, 844)])
def test_a_ghost_is_drawn_beside_its_robot_and_its_key_hides_it(
    browser, ghost_file, artefacts, width, height
):
    browser.open(ghost_file.as_uri(), width, height)
    browser.until("window.player && player.framesDrawn > 0")
    browser.run("player.pause(); player.time = player.duration")
    there = browser.still(artefacts / f"ghost_{width}.png")
    browser.press("g")
    gone = browser.still()
    assert differing(there, gone) > 400
    browser.press("g")
    assert differing(there, browser.still()) < 20
    assert browser.complaints() == []
    assert browser.requests() == [ghost_file.as_uri()]


def test_the_legend_says_what_a_ghost_is_and_which_key_hides_it(browser, ghost_file):
    browser.watch(ghost_file)
    last = "document.querySelector('.legend li:last-child')"
    assert browser.run(f"{last}.textContent") == "planned motion g"
    browser.run(f"{last}.querySelector('input').click()")
    assert browser.run("player.groups.get('ghost').object.visible") is False


def test_a_ghost_that_coincides_with_its_robot_gives_way_to_it(browser, ghost_file):
    """Two surfaces in one place would flicker between their colours."""
    browser.watch(ghost_file)
    browser.run("player.time = 0")
    both = browser.still()
    browser.run("player.toggle('ghost')")
    assert differing(both, browser.still()) < 200


def test_a_simulation_s_page_has_its_plan_as_a_ghost(browser, folder, artefacts):
    pytest.importorskip("mujoco", reason="MuJoCo isn't installed")
    from pollard_pin.study.simulate.page import simulation_page

    robot = pollard_pin.load()
    report = pollard_pin.trajectory_report(
        robot, pollard_pin.appendix_b(robot.specification), samples=241
    )
    file = folder / "simulation.html"
    file.write_bytes(simulation_page(pollard_pin.simulate_path(report)))
    browser.open(file.as_uri(), 390, 844, mobile=True)
    browser.until("window.player && player.framesDrawn > 0")
    browser.run("player.pause(); player.time = player.duration")
    browser.run("document.querySelector('canvas').focus({ preventScroll: false })")
    there = browser.still(artefacts / "simulation_390.png")
    browser.press("g")
    assert browser.run("player.groups.get('ghost').object.visible") is False
    assert differing(there, browser.still()) > 100
    assert browser.complaints() == []
    assert browser.requests() == [file.as_uri()]
