"""What one sample's spike is in a path's report is to be seen in its figures and on its page."""

from dataclasses import replace

import pytest
from pictured import coarsely, figure_values, page_values, spiked

import pollard_pin
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.drawn import figures
from pollard_pin.report.drawn.page import trajectory_page


@pytest.mark.parametrize("sample", [3, 11, 36])
def test_one_sample_s_torque_is_drawn(monkeypatch, sample):
    path = appendix_b(duration=10.0)
    report = pollard_pin.trajectory_report(pollard_pin.load(), path, samples=41)
    torque = spiked(report.dynamics.torque, sample, -1234.0)
    report = replace(report, dynamics=replace(report.dynamics, torque=torque))
    coarsely(monkeypatch)
    assert -1234.0 in page_values(trajectory_page(report))
    assert -1234.0 in figure_values(monkeypatch, [figures], figures.figures, report)
