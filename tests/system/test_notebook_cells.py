"""Scenes in a notebook's cell: they play in a frame of their own, and leave the notebook alone."""

import re
import time
from pathlib import Path

import numpy as np
import pytest

from thesis_pin.pages.notebook import MOST, UNTRUSTED
from thesis_pin.pages.player import write_html
from thesis_pin.pages.scene import Arrow, Ball, Group, Readout, Scene, Shape

EVIL = "</script><script>parent.stolen = 1</script>'\"><b>"


def swing(title, samples=31):
    """A ball on a swing, called as someone may who means no good."""
    time = np.linspace(0.0, 3.0, samples)
    position = np.stack([np.sin(time), np.cos(time), time], axis=1)
    ball = Ball("ball", "balls", position, 0.1, ("#0072B2",))
    height = Readout("height", position[:, 2], "m")
    return Scene(title, EVIL, time, (Group("balls", EVIL),), (ball,), (height,))


def test_a_large_scene_keeps_its_ends_and_says_what_it_left_out():
    large = swing("long", MOST)  # three numbers a sample
    cell = large._repr_html_()
    assert f"One of 3 samples is shown, of {MOST} in all." in cell
    few = large.every(3)
    assert few.time[[0, -1]].tolist() == [0.0, 3.0]
    np.testing.assert_array_equal(few.items[0].position[1], large.items[0].position[3])
    assert "is shown, of" not in swing("short")._repr_html_()


def test_nothing_of_a_scene_ends_its_frame():
    cell = swing(EVIL)._repr_html_()
    assert cell.count("<iframe") == cell.count("</iframe>") == 1
    assert "<script" not in cell
    assert "<b>" not in cell


def test_a_notebook_that_takes_frames_out_says_how_to_see_the_scene():
    """Notebooks from elsewhere aren't trusted: the tag goes, the text in it stays."""
    cell = swing("short")._repr_html_()
    assert re.sub("<[^>]*>", "", cell) == UNTRUSTED


@pytest.fixture(scope="module")
def notebook(running_browser, tmp_path_factory):
    """A dark page with two scenes among text that hears keys, as a notebook does."""
    page = tmp_path_factory.mktemp("notebook") / "cells.html"
    cells = "<p>between</p>".join(swing(title)._repr_html_() for title in ("one", "two"))
    page.write_text(
        "<!doctype html><meta charset='utf-8'><script>window.heard = [];"
        "document.addEventListener('keydown', (event) => heard.push(event.key));</script>"
        f"<body style='background:#111;color:#ddd'><p>before</p>{cells}<p>after</p></body>",
        encoding="utf-8",
    )
    running_browser.open(page.as_uri(), height=1200)
    running_browser.page.wait_for_load_state("load")  # frames come with it
    yield running_browser
    running_browser.leave()


def in_frame(notebook, number, script):
    """Value of an expression in a cell's frame."""
    return notebook.page.frames[1 + number].evaluate(script)


def becomes(notebook, number, script):
    deadline = time.monotonic() + 60
    while not in_frame(notebook, number, f"Boolean({script})"):
        assert time.monotonic() < deadline, notebook.complaints()
        time.sleep(0.1)


def drawn(notebook, number):
    becomes(notebook, number, "window.player && player.framesDrawn > 0")


def stopped(notebook, number):
    """A scene at its start, whether or not its frame heard in time that motion is unwanted."""
    drawn(notebook, number)
    in_frame(notebook, number, "player.pause()")
    in_frame(notebook, number, "player.time = 0")


@pytest.mark.browser
def test_two_scenes_play_beside_each_other_and_steal_nothing(notebook, tmp_path):
    for k in (0, 1):
        stopped(notebook, k)
    assert notebook.run("document.activeElement === document.body")
    notebook.press(" ")
    assert notebook.run("heard") == [" "]
    assert not in_frame(notebook, 0, "player.playing")
    in_frame(notebook, 0, "player.time = 1.5")
    assert in_frame(notebook, 0, "player.time") == pytest.approx(1.5)
    assert in_frame(notebook, 1, "player.time") == 0.0
    assert notebook.run("window.stolen") is None
    assert in_frame(notebook, 1, "document.querySelector('summary').textContent") == "two"
    assert notebook.requests() == [notebook.page.url]
    assert notebook.complaints() == []
    picture = notebook.still(Path(tmp_path, "cells.png"))
    assert picture.shape[0] == 1200


@pytest.mark.browser
def test_a_key_in_a_frame_stays_there(notebook):
    stopped(notebook, 1)
    notebook.run("heard.length = 0")
    notebook.page.frames[2].locator("canvas").focus()
    notebook.press(" ")
    assert in_frame(notebook, 1, "player.playing")
    assert notebook.run("heard") == []
    in_frame(notebook, 1, "player.pause()")


SEEN = """(() => {
  const { stage } = player, { min, max } = stage.box;
  return Math.max(...[min, max].flatMap((corner) => {
    const seen = corner.clone().project(stage.camera);
    return [Math.abs(seen.x), Math.abs(seen.y)];
  }));
})()"""
"""How far from the middle of the picture a scene's corners are seen; 1 is the picture's edge."""

AWAY = "player.stage.camera.position.distanceTo(player.stage.controls.target)"


@pytest.mark.browser
def test_a_frame_that_grows_shows_the_whole_scene_until_a_hand_turns_it(notebook):
    notebook.run(
        "{ const sliver = document.querySelector('iframe').cloneNode(); sliver.id = 'sliver';"
        "sliver.style.width = '2px'; document.body.prepend(sliver); }"
    )
    sliver = len(notebook.page.frames) - 2
    drawn(notebook, sliver)
    notebook.run("sliver.style.width = '254px'")
    becomes(notebook, sliver, "player.stage.camera.aspect > 0.5")
    assert 0.3 < in_frame(notebook, sliver, SEEN) < 1.0

    in_frame(notebook, sliver, "player.stage.controls.dispatchEvent({ type: 'start' })")
    in_frame(notebook, sliver, "player.stage.camera.position.multiplyScalar(9)")
    away = in_frame(notebook, sliver, AWAY)
    notebook.run("sliver.style.width = '100%'")
    becomes(notebook, sliver, "player.stage.camera.aspect > 1")
    assert in_frame(notebook, sliver, AWAY) == pytest.approx(away)
    notebook.run("sliver.remove()")


@pytest.mark.browser
def test_bars_among_bodies_are_in_sight_and_what_is_elsewhere_is_not_looked_for(
    running_browser, tmp_path
):
    time = np.array([0.0, 1.0])
    place = np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (2, 1))
    box = Shape("box", "robot", {"type": "box", "size": [0.1, 0.1, 0.1]}, place, np.eye(4))
    rest = np.zeros((2, 3))
    bar, far = (np.tile([0.0, 0.0, height], (2, 1)) for height in (2.0, 50.0))
    items = (
        box,
        Arrow("bar", "robot", rest, bar, 1.0, 0.01, "#0072B2", head=False),
        Arrow("force", "forces", rest, far, 1.0, 0.01, "#D55E00"),
    )
    scene = Scene("bars", "", time, (Group("robot", "robot"), Group("forces", "forces")), items)
    page = tmp_path / "bars.html"
    write_html(scene, page)
    running_browser.open(page.as_uri())
    running_browser.until("window.player && player.framesDrawn > 0")
    assert running_browser.run("player.stage.box.max.z") == pytest.approx(2.0, abs=0.05)
    running_browser.leave()
