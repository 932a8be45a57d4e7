"""Gaits simulated once for several tests."""

import pytest

from scout_pin.motion.files import load_gait
from scout_pin.report.document import gait_report
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.draws import simulate_gait

from ...conftest import EXAMPLES

STEP = 1e-3
"""The engine's longest usual step: results differ from shorter ones by micrometres."""


@pytest.fixture(scope="session")
def report_of(scout, lopsided):
    def make(name, time_unit=None):
        gait = load_gait(name if name == "thesis" else EXAMPLES / f"{name}.toml")
        robot = lopsided if name.startswith("lopsided") else scout
        return gait_report(robot, gait, samples=101, time_unit=time_unit)

    return make


@pytest.fixture(scope="session")
def walked(report_of):
    pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")
    return simulate_gait(report_of("walk"), Conditions(time_step=STEP))


@pytest.fixture(scope="session")
def thesis_walked(report_of):
    pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")
    return simulate_gait(report_of("thesis"), Conditions(time_step=STEP))
