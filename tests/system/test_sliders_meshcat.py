"""Sliders beside meshcat's page: its robot goes where Pinocchio puts it, its loops stay closed."""

import json
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from pollard_pin.report.drawn.sliders import slider_page as tool_page
from thesis_pin.command.main import main
from thesis_pin.loops.kinematics import residual
from thesis_pin.loops.loading import load
from thesis_pin.pages.live.making import show_sliders, slider_page
from thesis_pin.pages.meshcat.display import show
from thesis_pin.pages.meshcat.drawing import word

pytestmark = pytest.mark.browser

URDF = Path(__file__).parents[2] / "urdf" / "pollard"
FILES = (str(URDF / "pollard.urdf"), str(URDF / "pollard.closures.yaml"))

MATRIX = """(() => {
  try {
    const object = %s.object;
    object.updateMatrix();
    return object.matrix.toArray();
  } catch {
    return [];
  }
})()"""


def node(scene, item):
    """meshcat's node of an item, in JavaScript."""
    path = ("meshcat", word(scene.title), word(item.group), word(item.name))
    return "viewer.scene_tree" + "".join(f".children[{json.dumps(one)}]" for one in path)


def framed(page, url):
    """meshcat's page within ours, once the browser has it."""
    for _ in range(100):
        if found := [one for one in page.frames if one.url == url]:
            return found[0]
        page.wait_for_timeout(100)
    raise AssertionError([one.url for one in page.frames])


def near(frame, matrix, wanted, tolerance=1e-6):
    """Wait until a node of meshcat's is where it ought to be: it is told through a socket."""
    for _ in range(100):
        seen = frame.evaluate(matrix)
        if seen and np.abs(np.array(seen) - wanted).max() < tolerance:
            return
        frame.page.wait_for_timeout(100)
    np.testing.assert_allclose(seen, wanted, atol=tolerance)


@pytest.fixture
def opened(browser):
    """Opens a page of sliders with meshcat beside, and gives its answers' counter and frame."""

    def on(page, then, width=1280, height=720):
        with show(page.scene(), port=0) as viewer:

            def ready(address):
                browser.open(address, width, height)
                browser.until("window.live && live.answers > 0 && !live.busy")
                then(framed(browser.page, viewer.url))

            show_sliders(
                page, port=0, browser=False, hold=0.0, say=str, ready=ready, meshcat=viewer
            )

    return on


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (390, 844)])
def test_a_slider_moves_meshcats_robot_as_pinocchio_says_and_keeps_its_loops_closed(
    browser, opened, artefacts, width, height
):
    robot = load(*FILES)
    page = slider_page(robot)

    def then(frame):
        motor = next(k for k, one in enumerate(page.rig.sliders) if one.group == "motors")
        before = browser.still()
        browser.run(f"document.getElementById('slider-{motor}').focus()")
        for count in range(2, 5):
            browser.press("ArrowRight")
            browser.until(f"live.answers >= {count} && !live.busy")
        q = np.array(browser.run("live.stand.state"))
        assert np.abs(q - page.rig.start().q).max() > 0.05
        assert np.abs(residual(robot, q)).max() < 1e-9
        data = robot.model.createData()
        pin.forwardKinematics(robot.model, data, q)
        scene = page.scene()
        for one in page.layers.hung:
            if one.item.group in ("robot", "frames"):
                wanted = data.oMi[one.joint].homogeneous.T.ravel()  # three.js has columns
                near(frame, MATRIX % node(scene, one.item), wanted)
        browser.page.wait_for_timeout(500)
        after = browser.still(artefacts / f"sliders_meshcat_{width}.png")
        assert (np.abs(before - after).max(axis=-1) > 24).sum() > 300
        assert browser.run("document.documentElement.scrollWidth") <= width
        assert browser.complaints() == []

    opened(page, then, width, height)


def test_a_page_that_comes_later_stands_where_its_sliders_do(browser, opened):
    page = tool_page(pollard_pin.load())
    model = page.rig.robot.model
    joint = 2
    shape = next(one.item for one in page.layers.hung if one.joint == joint)
    matrix = MATRIX % node(page.scene(), shape)
    data = model.createData()

    def where(q):
        pin.forwardKinematics(model, data, np.asarray(q))
        return data.oMi[joint].homogeneous.T.ravel()

    def then(frame):
        first = where(page.rig.start().q)
        near(frame, matrix, first)
        browser.run("live.ask({slider: 0, value: live.stand.values[0] + 0.02})")
        browser.until("live.answers > 1 && !live.busy")
        names = {"np": np}
        exec(browser.run("live.stand.q"), names)  # its state is the tool's pose
        moved = where(names["q"])
        assert np.abs(moved - first).max() > 1e-3
        near(frame, matrix, moved)
        address = browser.page.url
        browser.page.goto(address)
        browser.until("window.live && live.answers > 0 && !live.busy")
        again = framed(browser.page, frame.url)
        near(again, matrix, first)
        # What can't be reached leaves meshcat's robot where it is, too.
        browser.run("live.ask({slider: 0, value: 0.899})")
        browser.until("live.answers > 1 && !live.busy")
        assert "stays" in browser.run("document.querySelector('#panel .status').textContent")
        browser.page.wait_for_timeout(200)
        near(again, matrix, first)

    opened(page, then)


@pytest.mark.parametrize("more", [["--html", "x.html"], ["--picture", "x.png"], ["--speed", "2"]])
def test_what_meshcat_cannot_be_beside_is_refused(more, capfd):
    assert main(["view", *FILES, "--meshcat", *more]) == 2
    assert capfd.readouterr().err.count("error: ") == 1


def test_the_command_tells_both_addresses_and_ends_both_servers(tmp_path, capfd):
    told = tmp_path / "shown.json"
    words = ["--meshcat", "--port", "0", "--no-browser", "--hold", "0.2", "--json", str(told)]
    assert main(["view", *FILES, *words]) == 0
    document = json.loads(told.read_text())
    assert document["address"].startswith("http://127.0.0.1:")
    assert document["meshcat"].startswith("tcp://127.0.0.1:")
    assert len(document["sliders"]) == 12
    err = capfd.readouterr().err
    assert "the robot stands in meshcat at http://127.0.0.1:" in err
    assert f"at {document['address']} (Ctrl-C ends)" in err


def test_a_meshcat_server_that_goes_is_said_in_the_page():
    page = slider_page(load(*FILES))
    viewer = show(page.scene(), port=0)
    viewer.close()
    start = json.loads(page.answer(b"{}"))
    question = {"state": start["state"], "slider": 0, "value": start["values"][0] + 0.1}
    found = json.loads(page.answer(json.dumps(question).encode(), viewer.move))
    assert "meshcat server" in found["error"]
