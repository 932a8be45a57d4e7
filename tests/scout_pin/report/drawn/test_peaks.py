"""What one sample's spike is in a gait report is to be seen in its figures and on its page."""

from dataclasses import replace

import pytest
from pictured import coarsely, figure_values, page_values, spiked

import scout_pin
from scout_pin.report.drawn import figures
from scout_pin.report.drawn.page import gait_page


@pytest.mark.parametrize("sample", [3, 11, 36])
def test_one_sample_s_torque_is_drawn(monkeypatch, sample):
    report = scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(), samples=41)
    torque = spiked(report.dynamics.torque, sample, -1234.0)
    report = replace(report, dynamics=replace(report.dynamics, torque=torque))
    coarsely(monkeypatch)
    assert -1234.0 in page_values(gait_page(report))
    assert -1234.0 in figure_values(monkeypatch, [figures], figures.figures, report)
