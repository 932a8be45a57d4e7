"""Sliders in a browser: bodies go where Pinocchio puts them, loops stay closed."""

import json
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from chromium import BACKGROUND, differing
from mechanisms import four_bar

import pollard_pin
import thesis_pin
from pollard_pin.report.drawn.sliders import slider_page as tool_page
from thesis_pin.command.main import main
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.checking.poses import named_pose
from thesis_pin.loops.kinematics import residual
from thesis_pin.loops.loading import load
from thesis_pin.pages.live.joints import JointRig
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.live.page import PATH, LivePage
from thesis_pin.pages.serving import PageServer

pytestmark = pytest.mark.browser

URDF = Path(__file__).parents[2] / "urdf" / "pollard"
FILES = (str(URDF / "pollard.urdf"), str(URDF / "pollard.closures.yaml"))


@pytest.fixture(scope="module")
def robot():
    return load(*FILES)


@pytest.fixture(scope="module")
def live(robot):
    q = assembly(robot).q
    drawn = layers(robot, q)
    page = LivePage(JointRig(robot, q, drawn.size), drawn, "Pollard", "thesis-pin view …")
    with PageServer(page.html(served=True), 0, print, {PATH: page.answer}) as server:
        yield page, server.address


def share_drawn(picture):
    """Share of the stage, between legend and sliders, that is not background or floor."""
    return float((np.abs(picture[40:640, 340:920] - BACKGROUND).max(axis=-1) > 110).mean())


def opened(browser, address, width=1280, height=720):
    browser.open(address, width, height)
    browser.until("window.live && player.framesDrawn > 0")


def settled(browser, answers):
    browser.until(f"live.answers >= {answers} && !live.busy")


def test_a_key_on_a_slider_moves_the_body_as_pinocchio_says_and_keeps_the_loops_closed(
    browser, live, robot, artefacts, tmp_path
):
    page, address = live
    opened(browser, address)
    before = browser.still(artefacts / "sliders_1280.png")
    browser.run("player.toggle('robot')")
    assert differing(before, browser.still()) > 2000
    browser.run("player.toggle('robot')")
    browser.run("document.querySelector('#panel input[type=number]').focus()")
    browser.press("3")  # is typed there, and no key of the legend
    assert browser.run("player.groups.get('frames').object.visible") is False
    browser.run("document.getElementById('slider-0').focus()")
    for count in range(1, 4):
        browser.press("ArrowRight")
        settled(browser, count)
    q = np.array(browser.run("live.stand.state"))
    start = page.rig.start().q
    assert abs(q[0] - start[0]) > 0.05
    assert np.abs(residual(robot, q)).max() < 1e-9
    after = browser.still()
    assert differing(before, after) > 300
    name = next(one.item.name for one in page.layers.hung if one.item.group == "robot")
    for one in page.layers.hung:
        if one.item.group == "robot":
            name, joint, local = one.item.name, one.joint, one.item.local
    data = robot.model.createData()
    pin.forwardKinematics(robot.model, data, q)
    seen = browser.vertices(name)
    back = np.linalg.inv(data.oMi[joint].homogeneous @ local)
    own = seen @ back[:3, :3].T + back[:3, 3]
    number = [shape.item.name for shape in page.layers.hung].index(name)
    size = robot.visual_model.geometryObjects[number].geometry.computeLocalAABB
    size()
    box = robot.visual_model.geometryObjects[number].geometry.aabb_local
    np.testing.assert_allclose(own.min(axis=0), box.min_, atol=2e-4)
    np.testing.assert_allclose(own.max(axis=0), box.max_, atol=2e-4)
    # A frame's bars end on its axes.
    triad = next(one for one in page.layers.hung if one.item.group == "frames" and one.joint == 3)
    tips = browser.run(
        f"player.items[{page.layers.hung.index(triad)}].object.children[0].children.slice(0, 3)"
        ".map((bar) => bar.localToWorld(new MeshCat.THREE.Vector3("
        f"0, {triad.item.length}, 0)).toArray())"
    )
    frame = data.oMi[3].homogeneous @ triad.item.local
    for k, tip in enumerate(tips):
        wanted = frame[:3, 3] + triad.item.length * frame[:3, k]
        np.testing.assert_allclose(tip, wanted, atol=1e-5)
    # What the text fields hold is the pose, and reads back.
    (tmp_path / "pose.toml").write_text(browser.run("document.querySelector('textarea').value"))
    np.testing.assert_allclose(named_pose(robot, str(tmp_path / "pose.toml")), q, atol=1e-12)
    browser.run("[...document.querySelectorAll('#panel button')].at(0).click()")
    settled(browser, 4)
    np.testing.assert_allclose(browser.run("live.stand.state"), start, atol=1e-12)
    assert browser.complaints() == []
    assert {url.rsplit("/", 1)[-1] for url in browser.requests()} == {"", "pose"}


def test_layers_are_switched_on_and_what_cannot_be_reached_is_said(browser, live, artefacts):
    page, address = live
    opened(browser, address, 390, 844)
    assert browser.run("document.documentElement.scrollWidth") <= 390
    browser.still(artefacts / "sliders_390.png")
    browser.run("player.toggle('robot')")  # its collision shapes are its bodies
    plain = browser.still()
    for group in ("frames", "masses", "inertias", "collision"):
        browser.run(f"player.toggle('{group}')")
        assert differing(plain, browser.still()) > 20, group
        browser.run(f"player.toggle('{group}')")
    number = next(k for k, one in enumerate(page.rig.sliders) if one.group == "motors")
    browser.run(f"live.ask({{slider: {number}, value: {page.rig.sliders[number].high}}})")
    settled(browser, 1)
    words = browser.run("document.querySelector('#panel .status').textContent")
    reached = browser.run(f"live.stand.values[{number}]")
    if reached < page.rig.sliders[number].high - 1e-9:
        assert "stays at" in words
    assert browser.complaints() == []


@pytest.mark.parametrize("size", [0.01, 100.0])
def test_bars_of_any_size_fill_the_picture(browser, tmp_path, size):
    tree, _ = four_bar(size=size)
    page = thesis_pin.slider_page(tree.robot())
    (tmp_path / "bars.html").write_bytes(page.html())
    opened(browser, (tmp_path / "bars.html").as_uri())
    assert share_drawn(browser.still()) > 0.005
    assert browser.complaints() == []


def test_a_page_in_a_file_works_offline_and_says_what_moves_it(browser, tmp_path):
    file, answer = tmp_path / "pose.html", tmp_path / "answer.json"
    assert main(["view", *FILES, "--html", str(file), "--json", str(answer)]) == 0
    assert len(json.loads(answer.read_text())["sliders"]) == 12
    opened(browser, file.as_uri())
    text = browser.run("document.getElementById('panel').innerText")
    assert f"thesis-pin view {FILES[0]} {FILES[1]}" in text
    assert browser.run("document.querySelectorAll('input[type=range]:not([hidden])').length") <= 1
    policy = browser.run("document.querySelector('meta[http-equiv]').content")
    assert "connect-src 'none'" in policy
    assert browser.complaints() == []
    assert browser.requests() == [file.as_uri()]


@pytest.mark.parametrize(
    "words",
    [
        ["--frame", "tool_tip"],
        ["--euler", "ZYX"],
        ["--external", "tool_tip=0,0,1"],
        ["--smooth", "none"],
        ["--speed", "2"],
        ["--port", "0"],
        ["--pose", "nowhere"],
    ],
)
def test_flags_of_a_motion_are_refused_without_one_and_nothing_is_written(words, tmp_path, capfd):
    file = tmp_path / "pose.html"
    assert main(["view", *FILES, "--html", str(file), *words]) == 2
    assert capfd.readouterr().err.count("error: ") == 1
    assert not file.exists()


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (390, 844)])
def test_pollards_tool_changes_its_branch_and_says_what_it_cannot_reach(
    browser, artefacts, width, height
):
    page = tool_page(pollard_pin.load())
    with PageServer(page.html(served=True), 0, print, {PATH: page.answer}) as server:
        opened(browser, server.address, width, height)
        before = browser.still(artefacts / f"tool_sliders_{width}.png")
        browser.page.select_option("#choice", label="+++-+++")
        settled(browser, 1)
        assert browser.run("live.stand.choice") == page.rig.choices.index("+++-+++")
        assert differing(before, browser.still()) > 300
        q = np.array(browser.run("live.stand.state"))
        browser.page.fill("#panel input[type=number]", "899")
        browser.press("Tab")
        settled(browser, 2)
        words = browser.run("document.querySelector('#panel .status').textContent")
        assert words.startswith("x of the spray tip stays where it is: unreachable: ")
        np.testing.assert_array_equal(browser.run("live.stand.state"), q)
        assert browser.run("document.querySelector('#panel input[type=number]').value") == "450"
    # The command has ended: the page says so and keeps its pose.
    browser.run("live.ask({slider: 1, value: 0.01})")
    settled(browser, 3)
    assert "has ended" in browser.run("document.querySelector('#panel .status').textContent")


def test_a_long_path_in_the_command_stays_inside_the_panel(browser, robot, tmp_path):
    q = assembly(robot).q
    drawn = layers(robot, q)
    command = f"thesis-pin view /{'a_folder_with_a_long_name/' * 4}arm.urdf"
    file = tmp_path / "pose.html"
    file.write_bytes(LivePage(JointRig(robot, q, drawn.size), drawn, "Pollard", command).html())
    for width in (1280, 390):
        opened(browser, file.as_uri(), width, 844)
        assert command in browser.run("document.querySelector('#panel code').textContent")
        wide, room = browser.run("[panel.scrollWidth, panel.clientWidth]")
        assert wide <= room
