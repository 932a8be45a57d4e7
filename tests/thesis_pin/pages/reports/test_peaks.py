"""What one sample's spike is in a report on any robot is to be seen in figures and on pages."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pictured import coarsely, figure_values, page_values, spiked
from standing_robots import standing

from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.joints import singles
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import JointMotion
from thesis_pin.pages.reports.balance import balance_page
from thesis_pin.pages.reports.torque import torque_page
from thesis_pin.report.balance import figures as feet
from thesis_pin.report.balance.making import balance_report
from thesis_pin.report.torque import figures as motors
from thesis_pin.report.torque.document import torque_report

DATA = Path(__file__).parents[2] / "loops" / "data"
TIME = np.linspace(0.0, 1.0, 41)


@pytest.mark.parametrize("sample", [3, 11, 36])
def test_one_sample_s_torque_is_drawn(monkeypatch, sample):
    robot = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml")
    start, t = float(singles(robot.model)["motor"].position(assembly(robot).q)), TIME[:, None]
    swing = (start + 0.1 * np.sin(t), 0.1 * np.cos(t), -0.1 * np.sin(t))
    report = torque_report(robot, JointMotion("swing", TIME, ("motor",), *swing))
    torque = spiked(report.dynamics.torque, sample, -1234.0)
    report = replace(report, dynamics=replace(report.dynamics, torque=torque))
    coarsely(monkeypatch)
    assert -1234.0 in page_values(torque_page(report))
    assert -1234.0 in figure_values(monkeypatch, [motors], motors.figures, report)


@pytest.mark.parametrize("sample", [3, 11, 36])
def test_one_sample_s_force_on_a_foot_is_drawn(monkeypatch, sample):
    robot, soles, pose = standing("talos")
    joints = [name for name, one in singles(robot.model).items() if name in robot.actuators]
    q = np.array([float(singles(robot.model)[name].position(pose)) for name in joints])
    still = np.zeros((len(TIME), len(joints)))
    motion = JointMotion("still", TIME, tuple(joints), still + q, still, still)
    report = balance_report(robot, motion, pose=pose, feet=soles)
    wrench = report.found.wrench.copy()
    wrench[sample, 0, 2] = -1234.0
    report = replace(report, found=replace(report.found, wrench=wrench))
    coarsely(monkeypatch)
    assert -1234.0 in page_values(balance_page(report))
    drawn = figure_values(monkeypatch, [feet, motors], feet.figures, report)
    assert np.nanmin(drawn) == pytest.approx(-1234.0, abs=1e-6)
