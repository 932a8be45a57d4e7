"""Servo ticks from angles, by hand."""

import numpy as np
import pytest

from thesis_pin.errors import SpecificationError, TrajectoryError, UnknownName
from thesis_pin.report.exchange.ticks import read_servos, ticks, ticks_where_possible

TIME = np.array([0.0, 0.5, 1.0])
TURNS = np.radians([[0.0, 0.0], [45.0, -30.0], [90.0, 12.34]])

FILE = """
format = 1
[servos]
zero = 2048
ticks_per_turn = 4096
lowest = 0
highest = 4095
[joints.knee]
zero = 2000
direction = -1
"""


def test_the_usual_servo_turns_ninety_degrees_in_a_thousand_microseconds():
    found = ticks(("hip", "knee"), TIME, TURNS)
    assert found == {"hip_ticks": ["1500", "2000", "2500"], "knee_ticks": ["1500", "1167", "1637"]}


def test_a_file_says_how_each_servo_counts(tmp_path):
    (tmp_path / "servos.toml").write_text(FILE)
    servos = read_servos(tmp_path / "servos.toml", ("hip", "knee"))
    found = ticks(("hip", "knee"), TIME, TURNS, servos)
    assert found["hip_ticks"] == ["2048", "2560", "3072"]
    assert found["knee_ticks"] == ["2000", "2341", "1860"]  # 12.34° are 140.4 ticks backwards


def test_a_servo_that_cannot_turn_so_far_is_named_with_the_time():
    with pytest.raises(TrajectoryError, match=r"t = 1 s: hip needs 2511 ticks; allowed: 500 to"):
        ticks(("hip", "knee"), TIME, TURNS + np.radians([1.0, 0.0]))


def test_beside_a_report_the_cells_of_such_a_servo_are_empty():
    found = ticks_where_possible(("hip", "knee"), TURNS + np.radians([1.0, 0.0]))
    assert found["hip_ticks"] == ["1511", "2011", ""]


@pytest.mark.parametrize(
    ("change", "error", "says"),
    [
        (("knee", "nee"), UnknownName, "unknown joint 'nee'"),
        (("direction = -1", "direction = 2"), SpecificationError, "direction"),
        (("highest = 4095", "highest = -1"), SpecificationError, "must exceed lowest"),
        (("ticks_per_turn = 4096", "ticks_per_turn = 0"), SpecificationError, "ticks_per_turn"),
    ],
)
def test_a_bad_file_of_servos_is_refused(tmp_path, change, error, says):
    (tmp_path / "servos.toml").write_text(FILE.replace(*change))
    with pytest.raises(error, match=says):
        read_servos(tmp_path / "servos.toml", ("hip", "knee"))
