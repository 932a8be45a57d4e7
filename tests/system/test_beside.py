"""``--beside``: two motions, or two robots, in one report and one page."""

import json
import re
from pathlib import Path
from types import SimpleNamespace

import commands
import numpy as np
import pytest

import scout_pin

ROOT = Path(__file__).parents[2]
POLLARD = ("urdf/pollard/pollard.urdf", "urdf/pollard/pollard.closures.yaml")


@pytest.fixture
def run(capfd, monkeypatch):
    """A command called in this process, in the checkout."""
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("COLUMNS", "80")

    def call(command, *words):
        code, out, err = commands.run(command, list(map(str, words)), capfd)
        return SimpleNamespace(returncode=code, stdout=out, stderr=err)

    return call


def document(done):
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_gaits_json_has_both_reports(run):
    words = ("gait", "--samples", "41", "--json", "-")
    both = document(run("scout-pin", *words, "--beside", "examples/cruise.toml"))
    first = document(run("scout-pin", *words))
    second = document(run("scout-pin", *words, "--gait", "examples/cruise.toml"))
    beside = both.pop("beside")
    assert both == first
    assert beside == {"names": ["thesis", "walk"], "aligned": "from the start", "report": second}


def test_both_verdicts_are_told_side_by_side(run):
    done = run("scout-pin", "gait", "--samples", "41", "--beside", "examples/cruise.toml")
    assert done.returncode == 0, done.stderr
    assert re.search(r"within all limits +no +yes", done.stdout)
    assert "thesis ends after 4 s and stands still, walk goes on to 5.16 s" in " ".join(
        done.stdout.split()
    )


def test_a_second_robot_walks_beside_the_first_with_its_own_torques(run, tmp_path):
    text = (ROOT / "scout_pin" / "specifications" / "scout.toml").read_text()
    heavy, count = re.subn(
        r"(\nmass = )([\d.]+)", lambda found: f"{found[1]}{1.2 * float(found[2]):.6g}", text
    )
    assert count
    (tmp_path / "heavy.toml").write_text(heavy)
    words = ("gait", "--samples", "21", "--json", "-", "--gait", "examples/walk.toml")
    both = document(run("scout-pin", *words, "--beside-robot", tmp_path / "heavy.toml"))
    second = both["beside"]["report"]
    assert second["theta"] == both["theta"]
    assert np.abs(second["torque"]).max() > np.abs(both["torque"]).max()


def test_a_path_beside_appendix_b_and_a_motion_beside_a_motion(run, tmp_path):
    out = tmp_path / "out"
    words = ("trajectory", "--samples", "21", "--beside", "examples/spray_arch.toml")
    done = run("pollard-pin", *words, "--duration", "10", "--out", out, "--figure", "4.4")
    assert done.returncode == 0, done.stderr
    assert {file.name for file in out.glob("*.svg")} == {"actuators.svg", "beside_actuators.svg"}
    saved = json.loads((out / "report.json").read_text())
    assert saved["time"][-1] == 10
    assert saved["beside"]["report"]["time"][-1] == 5
    motion = "examples/pollard_motors.csv"
    done = run("thesis-pin", "torque", *POLLARD, motion, "--beside", motion, "--json", "-")
    both = document(done)
    assert both["beside"]["report"]["torque"] == both["torque"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("view", "--sliders", "--beside", "examples/walk.toml"), "--beside means nothing"),
        (("view", "--sliders", "--align", "phase"), "--align means nothing"),
        (("view", "--align", "phase"), "--align belongs to --beside"),
        (("gait", "--align", "time"), "--align belongs to --beside"),
        (("gait", "--beside", "examples/squat.toml", "--align", "phase"), "no phases in common"),
        (("gait", "--beside", "none.toml"), "none.toml"),
        (("gait", "--beside-robot", "none.toml"), "none.toml"),
    ],
)
def test_what_cannot_stand_beside_is_refused(run, words, said):
    done = run("scout-pin", *words)
    assert (done.returncode, done.stdout) == (2, "")
    assert said in done.stderr


def test_json_says_which_times_belong_together(run):
    words = ("gait", "--samples", "41", "--beside", "examples/cruise.toml", "--align", "phase")
    beside = document(
        run("scout-pin", *words, "--gait", "examples/quasi_static.toml", "--json", "-")
    )
    told = beside["beside"]
    assert told["aligned"] == "by phase"
    step = told["phases"][1]
    assert step["name"] == "left foot stands"
    np.testing.assert_allclose(step["first"], [2.0, 3.438], atol=1e-3)
    np.testing.assert_allclose(step["second"], [0.4, 0.76], atol=1e-3)
    done = run("scout-pin", *words)
    assert done.returncode == 0, done.stderr
    assert "Both are in the same phase" in done.stdout
    words = ("trajectory", "--samples", "21", "--beside", "examples/spray_arch.toml")
    told = document(run("pollard-pin", *words, "--align", "phase", "--json", "-"))["beside"]
    assert told["phases"][-1]["name"] == "to 100 % of the way"
    assert told["phases"][-1]["second"][1] == pytest.approx(5.0)


@pytest.mark.browser
def test_by_phase_the_second_robot_steps_with_the_first(run, browser, folder, artefacts):
    file = folder / "aligned.html"
    words = ("gait", "--samples", "301", "--gait", "examples/quasi_static.toml", "--html", file)
    done = run("scout-pin", *words, "--beside", "examples/cruise.toml", "--align", "phase")
    assert done.returncode == 0, done.stderr
    cruise = scout_pin.gait_report(
        scout_pin.load(), scout_pin.load_gait(ROOT / "examples" / "cruise.toml"), samples=2001
    )
    for width in (1280, 390):
        browser.open(file.as_uri(), width, 844)
        browser.until("window.ready && player.framesDrawn > 0")
        # The middle of the first single support: of 2 to 3.438 s, and of 0.4 to 0.76 s.
        browser.run("player.pause(); player.time = 2.719")
        browser.still(artefacts / f"aligned_{width}.png")
        assert browser.complaints() == []
        assert browser.run("document.documentElement.scrollWidth") <= width
    assert browser.run("player.duration") == pytest.approx(13.438, abs=1e-3)
    place = cruise.motion.right_foot.position[np.argmin(np.abs(cruise.joints.time - 0.58))]
    sole = browser.run("player.items.find((i) => i.name.startsWith('ghost of right_sole')).name")
    corners = browser.vertices(sole)
    assert abs(corners[:, 2].min() - place[2]) < 2e-3
    assert (corners.min(axis=0)[:2] < place[:2]).all()
    assert (corners.max(axis=0)[:2] > place[:2]).all()


@pytest.mark.browser
def test_the_page_has_both_curves_and_the_second_robot_where_it_is(run, browser, folder, artefacts):
    file = folder / "beside.html"
    words = ("gait", "--samples", "101", "--beside", "examples/cruise.toml", "--html", file)
    done = run("scout-pin", *words)
    assert done.returncode == 0, done.stderr
    robot = scout_pin.load()
    cruise = scout_pin.gait_report(robot, scout_pin.load_gait(ROOT / "examples" / "cruise.toml"))
    for width in (1280, 390):
        browser.open(file.as_uri(), width, 844)
        browser.until("window.ready && player.framesDrawn > 0")
        assert browser.complaints() == []
        assert browser.requests() == [file.as_uri()]
        assert browser.cut_numbers() == []
        assert browser.run("document.documentElement.scrollWidth") <= width
        browser.run("player.pause(); player.time = player.duration")
        browser.still(artefacts / f"beside_{width}.png")
    assert browser.run("player.duration") == pytest.approx(cruise.joints.time[-1], abs=1e-6)
    ghost = browser.run("player.items.find((i) => i.name.startsWith('ghost of left_sole')).name")
    place = cruise.motion.left_foot.position[-1, :2]
    corners = browser.vertices(ghost)[:, :2]
    assert (corners.min(axis=0) < place).all()
    assert (corners.max(axis=0) > place).all()
    assert file.stat().st_size < 3e6
