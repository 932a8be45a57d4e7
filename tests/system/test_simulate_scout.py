"""The verb ``scout-pin simulate``: answers, exit codes, files, its page, refusals."""

import json
import sys

import numpy as np
import pytest
from commands import ROOT, run

from scout_pin.study.servo import ServoGains

SQUAT = ["--gait", str(ROOT / "examples" / "squat.toml"), "--time-step", "0.002"]


@pytest.fixture
def simulate(capfd):
    def call(*words):
        return run("scout-pin simulate", ["simulate", *words], capfd)

    return call


@pytest.fixture
def mujoco():
    return pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")


@pytest.mark.parametrize("verb", ["simulate", "plan"])
def test_help_says_the_gains_that_servos_have_where_none_are_given(capfd, verb):
    _, out, _ = run(f"scout-pin {verb}", [verb, "--help"], capfd)
    said = " ".join(out.split())
    assert f"a position servo gives way (default: {ServoGains().stiffness:g})" in said
    assert f"how it is damped (default: {ServoGains().damping:g})" in said


@pytest.mark.usefixtures("mujoco")
def test_what_does_as_planned_passes_and_is_told(simulate):
    code, out, err = simulate(*SQUAT)
    said = " ".join(out.split())
    assert (code, err) == (0, "")
    assert "PASS: the simulated robot does what its plan says. It stays in its place" in said
    assert "It begins at rest: it stands for 0.5 s in its first pose" in said
    assert "steps of 2 ms, servos of 20 N·m/rad" in said


@pytest.mark.usefixtures("mujoco")
def test_what_tips_exits_with_1_and_says_when_and_how_far(simulate, tmp_path):
    code, out, _ = simulate("--time-step", "0.002", "--json", str(tmp_path / "answer.json"))
    said = " ".join(out.split())
    assert code == 1
    assert "FAIL: the simulated robot doesn't do what its plan says." in said
    assert "It tips: from t = 0.4" in said
    assert "foot bears" in said
    document = json.loads((tmp_path / "answer.json").read_bytes())
    assert (document["schema"], document["version"]) == ("scout-pin/simulation", 1)
    assert document["summary"]["passed"] is False
    assert document["draws"][0]["criteria"]["upright"]["met"] is False
    assert np.degrees(document["draws"][0]["tilt"]) > 10


@pytest.mark.usefixtures("mujoco")
def test_flags_reach_the_engine(simulate, tmp_path):
    words = ["--servo-zero-error", "0.2", "--mass-error", "0.01", "--draws", "2", "--seed", "5"]
    words += ["--friction", "0.4", "--floor-tilt", "1", "-2", "--no-sag-compensation"]
    words += ["--servo-stiffness", "30", "--servo-damping", "0.1", "--armature", "0.001"]
    code, out, err = simulate(*SQUAT, *words, "--jobs", "1", "--json", "-")
    assert (code in (0, 1), err) == (True, "")
    found = json.loads(out)["parameters"]
    assert found["servo_zero_error"] == pytest.approx(np.radians(0.2))
    assert found["floor_tilt"] == pytest.approx([np.radians(1), np.radians(-2)])
    assert [found[key] for key in ("mass_error", "draws", "seed", "friction")] == [0.01, 2, 5, 0.4]
    assert [found[key] for key in ("servo_stiffness", "servo_damping")] == [30, 0.1]
    assert [found[key] for key in ("armature", "sag_compensation")] == [0.001, False]
    assert len(json.loads(out)["draws"]) == 2


@pytest.mark.usefixtures("mujoco")
def test_files_hold_the_world_and_the_motion_beside_the_plan(simulate, tmp_path, mujoco):
    code, _, err = simulate(*SQUAT, "--out", str(tmp_path / "made"))
    assert (code, err.count("wrote")) == (0, 1)
    world = mujoco.MjModel.from_xml_path(str(tmp_path / "made" / "world.xml"))
    assert (world.nq, world.nu) == (19, 12)
    table = np.genfromtxt(tmp_path / "made" / "samples.csv", delimiter=",", names=True)
    assert table["time_s"][0] == -0.5
    np.testing.assert_allclose(table["torso_z_m"], table["planned_torso_z_m"], atol=1e-3)


@pytest.mark.browser
@pytest.mark.usefixtures("mujoco")
def test_the_page_shows_the_robot_and_its_plan_as_a_ghost(simulate, browser, tmp_path):
    simulate("--time-step", "0.002", "--html", str(tmp_path / "page.html"))
    browser.watch(tmp_path / "page.html")
    browser.run("player.time = 0.9")
    browser.still()
    robot, ghost = (browser.vertices(f"{head}torso_0") for head in ("", "ghost of "))
    assert np.linalg.norm(robot.mean(axis=0) - ghost.mean(axis=0)) > 5e-3
    assert browser.requests()[1:] == []
    assert browser.complaints() == []


def test_without_mujoco_one_error_says_how_to_get_it(simulate, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    code, out, err = simulate(*SQUAT)
    assert (code, out) == (2, "")
    assert "pip install 'thesis-pin[simulate]'" in err
    assert len(err.splitlines()) == 1
