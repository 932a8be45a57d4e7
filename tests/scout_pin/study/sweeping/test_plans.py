"""Rows of planned walks, held against the planner itself."""

import tomllib

import pytest
from designed import row_of

import scout_pin
from scout_pin.study.plan.request import PlanRequest
from thesis_pin.errors import BadInput, UnknownName


def test_a_row_is_to_the_bit_what_the_planner_finds_for_the_design_that_is_written_out(tmp_path):
    study = scout_pin.plan_study(request={"speed": 0.03}, steps=2)
    _, cells, files = row_of(study, "servos.*.stall_torque=0.5", "plan.margin=0.008,0.006")
    (tmp_path / "best.toml").write_bytes(files["best.toml"])
    robot = scout_pin.load(tmp_path / "best.toml")
    plan = scout_pin.plan_gait(robot, PlanRequest(speed=0.03, margin=0.006), steps=2)
    assert plan.met
    assert cells["met"] is True
    assert cells["speed"] == plan.cycle.speed
    assert cells["margin"] == plan.walk.judged.margin
    assert cells["servo_use"] == plan.walk.judged.line
    assert cells["step_length"] == plan.cycle.pace.step_length
    assert cells["in_the_way"] is None
    text = files["best.toml"].decode()
    assert "margin = 0.006" in text.split("format = 1")[0]
    assert tomllib.loads(text)["servos"]["HS-5475HB"]["stall_torque"] == 0.5


def test_a_walk_that_cant_be_is_a_row_that_says_what_stands_in_the_way():
    _, cells, _ = row_of(
        scout_pin.plan_study(request={"speed": 0.03}, steps=2), "servos.*.stall_torque=0.05"
    )
    assert cells["met"] is False
    assert cells["in_the_way"]
    assert cells["speed"] is cells["margin"] is None


def test_what_the_objective_leaves_open_stays_open_where_it_varies():
    study = scout_pin.plan_study(steps=1)
    assert study.base["plan"]["line_reserve"] is None
    assert scout_pin.plan_study(request={"line_reserve": 0.2}).base["plan"]["line_reserve"] == 0.2


@pytest.mark.parametrize(
    ("request_", "error"),
    [({"nonsense": 1.0}, UnknownName), ({"speed": -1.0}, BadInput), ({"speed": "fast"}, BadInput)],
)
def test_a_walk_that_nobody_can_ask_for_is_refused(request_, error):
    with pytest.raises(error):
        scout_pin.plan_study(request=request_)
