"""Gaits in ``examples/`` that ``scout-pin plan`` made: what was asked of them holds."""

import runpy
import shlex

import pytest
from commands import ROOT

import scout_pin
from scout_pin.motion.files import load_gait

PLANS = runpy.run_path(str(ROOT / "docs" / "plans.py"))["PLANS"]


@pytest.mark.parametrize("name", PLANS)
def test_a_planned_example_keeps_what_its_command_asks(name):
    text = (ROOT / "examples" / f"{name}.toml").read_text(encoding="utf-8")
    made = text.splitlines()[0].removeprefix("# Made by: scout-pin plan ")
    assert sorted(shlex.split(made)) == sorted(shlex.split(PLANS[name]))
    words = dict(zip(*[iter(shlex.split(PLANS[name].replace("=", " ")))] * 2, strict=True))
    robot = scout_pin.load(ROOT / words["--specification"] if "--specification" in words else None)
    report = scout_pin.gait_report(
        robot, load_gait(ROOT / "examples" / f"{name}.toml"), samples=801
    )
    assert report.within_limits
    assert report.ends.kind == "rests"
    margin = float(words.get("--margin", 10)) * 1e-3
    assert report.margin.min() >= 0.8 * margin
    reserve = float(words.get("--torque-reserve", 10)) / 100
    shares = report.actuators.peak_torque / robot.stall_torque
    assert shares.max() <= (1 - reserve) * 1.01
    assert report.servo_use.max() <= 0.9 * 1.01
