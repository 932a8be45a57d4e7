"""Rows of timed paths, held against the solver called by hand."""

from pathlib import Path

import pytest
from designed import row_of

import pollard_pin
from thesis_pin.errors import UnknownName

ROOT = Path(__file__).parents[4]
ARCH = str(ROOT / "examples" / "spray_arch.toml")


def test_a_row_is_to_the_bit_what_the_solver_finds_for_the_design(tmp_path):
    study = pollard_pin.time_study(path=ARCH)
    texts = ("assumptions.joint_limits.effort=2,3", "limits.tool_speed=1.5")
    row, cells, files = row_of(study, *texts)
    (tmp_path / "best.toml").write_bytes(files["best.toml"])
    robot = pollard_pin.load(tmp_path / "best.toml")
    limits = pollard_pin.motor_limits(robot.specification, tool_speed=1.5)
    found = pollard_pin.time_path(robot, pollard_pin.load_path(ARCH), limits)
    assert row.status == "done"
    assert cells["duration"] == found.duration
    assert cells["within_limits"] is found.within_limits is True
    assert cells["torque_use"] == found.largest_torque_share
    # The law leaves a thousandth of every limit (docs/timing.md).
    assert cells["tool_speed"] == pytest.approx(1.5 * 0.999, rel=1e-6)
    assert "tool_speed = 1.5" in files["best.toml"].decode().split("format = 1")[0]


def test_stronger_motors_are_never_slower():
    study = pollard_pin.time_study(path=ARCH)
    times = [
        row_of(study, f"assumptions.joint_limits.effort={effort}")[1]["duration"]
        for effort in (1.5, 3, 6)
    ]
    assert times[0] > times[1] > times[2]


def test_a_speed_that_no_corner_allows_is_a_row_with_its_reason():
    study = pollard_pin.time_study(path=ARCH, law="constant-speed")
    row, _, _ = row_of(study, "assumptions.joint_limits.effort=5")
    assert row.status == "impossible"
    assert "corner" in row.reason


def test_a_law_that_there_isnt_is_refused():
    with pytest.raises(UnknownName):
        pollard_pin.time_study(law="slowest")
