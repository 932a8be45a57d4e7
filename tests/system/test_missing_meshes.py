"""Meshes that aren't there: said where the robot moves, on standard error and in the page."""

import re
from pathlib import Path

import numpy as np
import pytest
from commands import run

from thesis_pin.errors import ModelWarning
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import read_motion
from thesis_pin.pages.reports.torque_scene import scene
from thesis_pin.report.torque.document import torque_report

DATA = Path(__file__).parents[1] / "thesis_pin" / "loops" / "data"
GONE = '<visual><geometry><mesh filename="package://gone/thing.stl"/></geometry></visual>'
BOX = '<visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>'


@pytest.fixture
def files(tmp_path):
    """A four-bar linkage whose links have shapes of the kinds that are named, and a motion."""

    def of(*shapes):
        text = (DATA / "four_bar.urdf").read_text(encoding="utf-8")
        for shape in shapes:
            text = re.sub(r"(<link name=\"\w+\">)(?!<visual)", rf"\1{shape}", text, count=1)
        (tmp_path / "bar.urdf").write_text(text, encoding="utf-8")
        (tmp_path / "bar.yaml").write_bytes((DATA / "four_bar.yaml").read_bytes())
        start = load(tmp_path / "bar.urdf", tmp_path / "bar.yaml").q0[0]
        t = np.linspace(0, 1, 21)
        rows = [f"{a},{start + 0.1 * np.sin(a)}" for a in t.tolist()]
        (tmp_path / "swing.csv").write_text("\n".join(["t,motor", *rows, ""]))
        return [str(tmp_path / name) for name in ("bar.urdf", "bar.yaml", "swing.csv")]

    return of


@pytest.mark.parametrize(
    ("shapes", "bars", "bodies"),
    [
        ((GONE,), True, 0),
        ((GONE, BOX), True, 1),  # one of four joints has a shape: that alone shows no robot
        ((GONE, BOX, BOX), False, 2),
        ((BOX,), False, 1),
    ],
)
def test_what_is_there_is_drawn_and_what_is_not_is_said(shapes, bars, bodies, files):
    urdf, closures, motion = files(*shapes)
    robot = load(urdf, closures)
    report = torque_report(robot, read_motion(robot, motion))
    if GONE in shapes:
        with pytest.warns(ModelWarning, match="thing.stl"):
            drawn = scene(report)
        assert "thing.stl" in drawn.notes[0]
        assert urdf not in drawn.notes[0]
    else:
        drawn = scene(report)
        assert drawn.notes == ()
    names = [item.name for item in drawn.items]
    assert any(name.startswith("bar ") for name in names) is bars
    assert sum(name.startswith("body") for name in names) == bodies
    assert any("Bars are drawn" in note for note in drawn.notes) is bars


@pytest.mark.parametrize("verb", ["view", "torque"])
@pytest.mark.browser
def test_the_command_and_its_page_say_it(verb, files, tmp_path, capfd, browser, artefacts):
    page = tmp_path / "page.html"
    code, _, err = run(f"thesis-pin {verb}", [verb, *files(GONE), "--html", str(page)], capfd)
    assert code == 0, err
    assert err.count("thing.stl") == 1
    for width in (1280, 390):
        browser.open(page.as_uri(), width, 844)
        browser.until("window.player && player.framesDrawn > 0")
        note = browser.run("document.querySelector('.player .note').innerText")
        assert "thing.stl" in note
        assert str(tmp_path) not in note
        assert browser.run("document.documentElement.scrollWidth") <= width
        browser.still(artefacts / f"missing_{verb}_{width}.png")
    if verb == "torque":  # on paper too, where there is no player
        browser.run("dispatchEvent(new Event('beforeprint'))")
        assert "thing.stl" in browser.run("document.getElementById('moments').textContent")
    assert browser.complaints() == []


def test_a_motion_of_a_robot_with_missing_meshes_stands_beside(files, tmp_path, capfd):
    words = files(GONE, BOX)
    page = tmp_path / "page.html"
    more = ["--beside", words[-1], "--html", str(page)]
    code, _, err = run("thesis-pin torque", ["torque", *words, *more], capfd)
    assert code == 0, err
    assert page.stat().st_size > 1e6
