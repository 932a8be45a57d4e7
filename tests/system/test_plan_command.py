"""``scout-pin plan``: what it writes, and what it leaves as it was."""

import json
import shlex
from dataclasses import replace

import numpy as np
import pytest
from commands import run

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.specification import Specification
from scout_pin.study.plan import planning
from scout_pin.study.plan.results.result import Plan
from scout_pin.verbs import planned
from thesis_pin.errors import CannotWrite
from thesis_pin.model.made_for import MadeFor

PLAN = "scout-pin plan"
WORDS = ["plan", "--steps", "1", "--margin", "8"]


@pytest.fixture(scope="module")
def plan():
    request = scout_pin.PlanRequest(margin=0.008)
    return scout_pin.plan_gait(scout_pin.load(), request, steps=1)


def instead(monkeypatch, plan):
    """Let the command find a plan, whatever it asks for; returns what it asked."""
    asked = []

    def found(robot, request, *, steps, samples, progress):
        asked.append((request, steps, samples))
        return plan

    monkeypatch.setattr(planning, "plan_gait", found)
    return asked


def test_what_is_written_is_judged_well_by_the_other_commands(tmp_path, capfd):
    out = tmp_path / "walk"
    words = [*WORDS, "--out", str(out), "--json", str(tmp_path / "plan.json")]
    code, said, err = run(PLAN, [*words, "--html", str(tmp_path / "walk.html")], capfd)
    assert code == 0, err
    assert "Scout walks 30 mm a step" in said
    names = {"walk.toml", "cycle.toml", "joints.csv", "commands.csv", "plan.json", "report.json"}
    assert names <= {path.name for path in out.iterdir()}
    assert (out / "plan.json").read_bytes() == (tmp_path / "plan.json").read_bytes()
    page = (tmp_path / "walk.html").read_bytes()
    assert b"</html>" in page
    assert len(page) < 3e6
    for name in ("walk.toml", "cycle.toml"):
        judge = ["gait", "--gait", str(out / name), "--samples", "801", "--strict"]
        assert run("scout-pin gait", judge, capfd)[0] == 0
        assert load_gait(out / name).made_for == MadeFor.of(Specification.read())
    head = (out / "walk.toml").read_text(encoding="utf-8").splitlines()[0]
    assert head == "# Made by: scout-pin plan --margin 8 --steps 1"


def test_every_option_reaches_the_request(plan, monkeypatch, capfd):
    asked = instead(monkeypatch, plan)
    words = (
        "--step-length 25 --side -20 --turn -10 --step-time 0.7 --foot-spacing 70 --lift 12 "
        "--margin 4 "
        "--torque-reserve 15 --speed-reserve 5 --line-reserve 20 --pitch 9 --roll 10 --yaw 11 "
        "--knee 12 --height 190 230 --friction 0.4 --no-servo-line --objective least-torque "
        "--branch=backward --steps 7 --samples 900"
    )
    code, _, err = run(PLAN, ["plan", *shlex.split(words)], capfd)
    assert code == 0, err
    request, steps, samples = asked[0]
    assert (steps, samples) == (7, 900)
    found = request.document()
    want = {
        "step_length": 0.025,
        "side": -0.02,
        "turn": np.radians(-10),
        "step_time": 0.7,
        "speed": None,
        "foot_spacing": 0.07,
        "lift": 0.012,
        "margin": 0.004,
        "torque_reserve": 0.15,
        "speed_reserve": 0.05,
        "line_reserve": 0.2,
        "servo_line": False,
        "pitch": np.radians(9),
        "roll": np.radians(10),
        "yaw": np.radians(11),
        "height": [0.19, 0.23],
        "friction": 0.4,
        "knee": np.radians(12),
        "branch": "backward",
        "objective": "least_torque",
    }
    assert set(found) == set(want)
    for name, value in want.items():
        if isinstance(value, float | list) and not isinstance(value, bool):
            np.testing.assert_allclose(found[name], value, rtol=1e-12)
        else:
            assert found[name] == value, name


def test_the_command_in_the_head_asks_for_the_same(plan, monkeypatch, tmp_path, capfd):
    asked = instead(monkeypatch, plan)
    words = "--side -20.5 --turn 10 --margin 4.1234567 --height 190 230.0000003"
    words += " --fastest --branch=+++ --steps 7"
    for number in (1, 2):
        out = tmp_path / str(number)
        code, _, err = run(PLAN, ["plan", *shlex.split(words), "--out", str(out)], capfd)
        assert code == 0, err
        head = (out / "cycle.toml").read_text(encoding="utf-8").splitlines()[0]
        words = head.removeprefix("# Made by: scout-pin plan ")
    assert asked[0] == asked[1]


def test_a_request_that_cannot_be_met_exits_with_1_and_leaves_the_folder_as_it_was(
    plan, monkeypatch, tmp_path, capfd
):
    instead(monkeypatch, Plan(plan.cycle, 1))
    out = tmp_path / "walk"
    out.mkdir()
    (out / "mine.txt").write_text("mine")
    page, answer = tmp_path / "walk.html", tmp_path / "plan.json"
    words = [*WORDS, "--out", str(out), "--html", str(page), "--json", str(answer)]
    code, said, err = run(PLAN, words, capfd)
    assert (code, err) == (1, f"wrote {answer}\n")
    assert "can't walk as asked" in said
    assert [path.name for path in out.iterdir()] == ["mine.txt"]
    assert not page.exists()
    assert json.loads(answer.read_bytes())["met"] is False


def test_an_interrupted_plan_that_is_good_is_written_and_said(plan, monkeypatch, tmp_path, capfd):
    instead(monkeypatch, replace(plan, cycle=replace(plan.cycle, interrupted=True)))
    code, said, err = run(PLAN, [*WORDS, "--out", str(tmp_path / "walk")], capfd)
    assert code == 130
    assert "scout-pin: interrupted; this is the best so far" in err
    assert "the best so far" in said
    gait = load_gait(tmp_path / "walk" / "walk.toml")
    assert gait.phases == plan.walk.gait.phases


def test_where_figures_cannot_be_drawn_the_data_are_written_all_the_same(
    plan, monkeypatch, tmp_path, capfd
):
    from scout_pin.report.drawn import figures

    instead(monkeypatch, plan)

    def broken(report):
        raise ImportError("broken")

    monkeypatch.setattr(figures, "figures", broken)
    code, _, err = run(PLAN, [*WORDS, "--out", str(tmp_path / "walk")], capfd)
    assert code == 70
    assert "broken" in err
    assert (tmp_path / "walk" / "walk.toml").exists()


def test_the_verdict_is_told_where_nothing_can_be_written(plan, monkeypatch, tmp_path, capfd):
    instead(monkeypatch, plan)

    def full(folder, made):
        raise CannotWrite(f"{folder}: no space left on device")

    monkeypatch.setattr(planned, "put_folder", full)
    code, said, err = run(PLAN, [*WORDS, "--out", str(tmp_path / "walk")], capfd)
    assert code == 3
    assert "no space left" in err
    assert "Scout walks 30 mm a step" in said


def test_feet_out_of_reach_are_told_by_flags(capfd):
    code, _, err = run(PLAN, ["plan", "--foot-spacing", "900"], capfd)
    assert code == 2
    assert "--foot-spacing, --height: the feet can't stand 900 mm apart" in " ".join(err.split())
    assert "another --foot-spacing or --height" in " ".join(err.split())
    assert "foot_spacing" not in err
