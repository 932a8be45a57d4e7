"""What rounded samples leave open: the truth inside, and no verdict where they carry none."""

import json
from functools import cache

import numpy as np
import pytest

import scout_pin
from scout_pin.cli import main
from scout_pin.motion.files import load_gait
from scout_pin.report.document import gait_report
from scout_pin.report.drawn.curves import stability_margin, torques
from scout_pin.report.drawn.page import gait_page
from thesis_pin.report.writers import json_bytes

from ..conftest import EXAMPLES
from ..motion.resolution.test_reading import log


@cache
def truth():
    return gait_report(scout_pin.load(), load_gait(EXAMPLES / "walk.toml"), samples=2001)


def brisk(path, digits, scale):
    """The walk, its torso's sway made larger: the margin shrinks to almost nothing."""
    log(path, 370.0, 12)
    lines = [line.split(",") for line in path.read_text().splitlines()]
    k = lines[0].index("torso_x")
    for line in lines[1:]:
        line[k] = f"{float(line[k]) * scale:.12f}"
        line[2:] = [f"{float(cell):.{digits}f}" for cell in line[2:]]
    path.write_text("\n".join(map(",".join, lines)) + "\n")
    return path


@pytest.mark.parametrize(
    ("rate", "digits"), [(50, 4), (60, 5), (200, 4), (200, 5), (500, 5), (1000, 4)]
)
def test_the_true_numbers_lie_in_their_intervals(scout, tmp_path, rate, digits):
    report = gait_report(scout, load_gait(log(tmp_path / "log.csv", rate, digits, shift=0.4)))
    held, true = report.headlines, truth()
    assert held.margin.low <= true.margin.min() <= held.margin.high
    for one, peak in zip(held.peak_torque, true.actuators.peak_torque, strict=True):
        assert one.low <= peak <= one.high
    for one, use in zip(held.servo_use, true.servo_use, strict=True):
        assert one.low <= use <= one.high
    assert held.margin.half_width < 1.5e-3
    assert report.can_walk
    assert report.servos_carry


def test_noise_within_many_digits_is_found(scout, tmp_path):
    path = log(tmp_path / "log.csv", 200.0, 9)
    lines, random = path.read_text().splitlines(), np.random.default_rng(1)
    made = [lines[0]]
    for line in lines[1:]:
        t, support, *cells = line.split(",")
        noisy = np.array(cells, float) + 2e-5 * random.standard_normal(18)
        made.append(",".join([t, support, *(f"{value:.9f}" for value in noisy)]))
    path.write_text("\n".join(made) + "\n")
    report = gait_report(scout, load_gait(path))
    held = report.headlines
    assert held.margin.low <= truth().margin.min() <= held.margin.high
    found = {one.name: one.noise for one in report.gait.variants.columns}
    assert found["torso_x"] == pytest.approx(2e-5, rel=0.2)


def test_where_the_samples_cannot_say_there_is_no_verdict_but_a_reason(scout, tmp_path):
    path = brisk(tmp_path / "log.csv", 3, 0.38)
    report = gait_report(scout, load_gait(path))
    held = report.headlines
    assert held.margin.low < 0 < held.margin.high
    assert report.can_walk is None
    assert report.within_limits is None
    assert "can't carry a verdict: the margin is" in report.reason
    assert "torso_x, written to 1 mm at 370 Hz, makes" in report.reason
    assert report.verdict()[0] == report.reason
    assert not any("can walk this gait" in said for said in report.verdict())
    summary = report.document()["summary"]
    assert summary["verdict"] is None
    assert summary["can_walk"] is None
    assert summary["reason"] == report.reason


def test_the_resolution_that_is_asked_for_settles_it(scout, tmp_path):
    coarse = gait_report(scout, load_gait(brisk(tmp_path / "a.csv", 3, 0.38)))
    needed = coarse.reason.split("of it; ")[1].split(" or better")[0]
    digits = {"0.1 mm": 4, "0.01 mm": 5, "1 µm": 6, "0.1 µm": 7, "10 nm": 8, "1 nm": 9}[needed]
    fine = gait_report(scout, load_gait(brisk(tmp_path / "b.csv", digits, 0.38)))
    assert fine.can_walk is not None


def test_exact_gaits_have_no_intervals(scout):
    report = gait_report(scout, load_gait(EXAMPLES / "walk.toml"))
    assert report.headlines is None
    assert report.document()["uncertainty"] is None
    assert report.reason is None


def test_coulomb_friction_counts_only_where_a_rate_is_known(lopsided, tmp_path):
    source = EXAMPLES / "lopsided_walk.toml"
    true = gait_report(lopsided, load_gait(source)).actuators.peak_torque.max()
    report = gait_report(lopsided, load_gait(log(tmp_path / "log.csv", 100.0, 5, source=source)))
    peaks = report.actuators.peak_torque
    coulomb = lopsided.specification.assumptions.joint_friction.coulomb
    assert peaks.max() == pytest.approx(true, abs=0.2 * coulomb)
    held = report.headlines.peak_torque[int(peaks.argmax())]
    assert held.high >= true + 0.9 * coulomb


def test_ringing_where_a_joint_comes_to_rest_counts_no_friction_but_leaves_it_open(
    lopsided, tmp_path
):
    """Coarse rows, fine digits: the curves' own error is far above what the digits tell."""
    source = EXAMPLES / "lopsided_walk.toml"
    true = gait_report(lopsided, load_gait(source)).actuators.peak_torque.max()
    file = log(tmp_path / "log.csv", 25.0, 7, source=source, shift=0.0182 * 25)
    report = gait_report(lopsided, load_gait(file))
    peaks = report.actuators.peak_torque
    held = report.headlines.peak_torque[int(peaks.argmax())]
    assert peaks.max() == pytest.approx(true, abs=1e-3)
    assert held.low <= true <= held.high


def test_intervals_in_json_say_what_they_were_made_from(scout, tmp_path):
    report = gait_report(scout, load_gait(log(tmp_path / "log.csv", 60.0, 4)))
    found = json.loads(json_bytes(report.document()))["uncertainty"]
    assert found["worst_margin"]["low"] < found["worst_margin"]["value"]
    assert len(found["peak_torque"]) == len(found["servo_use"]) == 12
    assert found["draws"] == 16
    assert found["rate"] == pytest.approx(60.0)
    (column,) = [one for one in found["columns"] if one["name"] == "torso_x"]
    assert column["resolution"] == pytest.approx(1e-4)
    assert found["margin_low"][3] <= found["margin_high"][3]


def test_plots_and_page_show_what_is_open(scout, tmp_path):
    report = gait_report(scout, load_gait(log(tmp_path / "log.csv", 60.0, 4)), samples=101)
    (area,) = stability_margin(report).areas
    assert area.corners[:, 1].min() == pytest.approx(report.headlines.margin_band[0].min() * 1e3)
    assert len(torques(report, "left").areas) == 6
    page = gait_page(report).decode()
    assert "left open by the samples" in page or "leaves open" in page


def test_the_command_prints_and_writes_the_report_and_exits_with_2(tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = brisk(tmp_path / "log.csv", 3, 0.38)
    code = main(["gait", "--gait", str(path), "--json", "report.json", "--html", "page.html"])
    out, err = capfd.readouterr()
    assert code == 2
    assert "can't carry a verdict" in " ".join(out.split())
    assert "left_knee_pitch" in out
    assert "can't carry a verdict" in err
    summary = json.loads((tmp_path / "report.json").read_text())["summary"]
    assert summary["verdict"] is None
    assert 'class="verdict open"' in (tmp_path / "page.html").read_text()
    assert main(["gait", "--gait", str(path), "--smooth", "none"]) == 2
    assert "log.csv:" in capfd.readouterr().err  # a spline through rounding falls too fast
    assert main(["gait", "--gait", str(path), "--smooth", "much"]) == 2


def test_writing_smoothed_samples_down_is_warned_of(tmp_path, capfd):
    path = str(log(tmp_path / "log.csv", 60.0, 4))
    target = str(tmp_path / "copy.csv")
    assert main(["convert", "--gait", path, "--to", target]) == 0
    assert "smoothed within their resolution" in capfd.readouterr().err
    assert main(["convert", "--gait", path, "--to", target, "--smooth", "none"]) == 0
    assert "warning" not in capfd.readouterr().err
