"""Requests for a walk."""

import json

import pytest

from scout_pin.study.plan.request import STEP_LENGTH, STEP_TIME, PlanRequest
from thesis_pin.errors import BadInput


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"step_length": 0.0}, "step_length"),
        ({"step_length": float("nan")}, "step_length"),
        ({"step_time": -1.0}, "step_time"),
        ({"side": 5e-5}, "side"),
        ({"side": -11.0}, "side"),
        ({"turn": 0.001}, "turn"),
        ({"turn": 4.0}, "turn"),
        ({"speed": "fast"}, "speed"),
        ({"foot_spacing": 0.0}, "foot_spacing"),
        ({"lift": 0.0}, "lift"),
        ({"margin": -0.001}, "margin"),
        ({"torque_reserve": 1.0}, "torque_reserve"),
        ({"speed_reserve": -0.1}, "speed_reserve"),
        ({"servo_line": "yes"}, "servo_line"),
        ({"pitch": 0.0}, "pitch"),
        ({"roll": 15.0}, "roll"),
        ({"yaw": True}, "yaw"),
        ({"height": 0.2}, "height"),
        ({"height": (0.2, 0.1)}, "least below the greatest"),
        ({"friction": 0.0}, "friction"),
        ({"knee": 0.0}, "knee"),
        ({"branch": "sideways"}, "branch"),
        ({"objective": "best"}, "objective"),
        ({"step_length": 0.03, "step_time": 0.8, "speed": 0.1}, "two of them"),
        ({"objective": "fastest", "speed": 0.1}, "fastest"),
        ({"objective": "fastest", "step_time": 1.0}, "fastest"),
    ],
)
def test_what_cannot_be_meant_is_refused_by_name(values, words):
    with pytest.raises(BadInput, match=words) as caught:
        PlanRequest(**values)
    assert caught.value.allowed


def test_length_time_and_speed_follow_from_each_other():
    default = PlanRequest()
    assert (default.first_length, default.free_length) == (STEP_LENGTH, False)
    assert default.walking_speed == pytest.approx(STEP_LENGTH / STEP_TIME)
    fast = PlanRequest(speed=0.1)
    assert fast.free_length
    assert fast.walking_speed == 0.1
    timed = PlanRequest(speed=0.1, step_time=0.5)
    assert timed.first_length == pytest.approx(0.05)
    assert not timed.free_length
    assert PlanRequest(objective="fastest").free_length
    assert not PlanRequest(objective="fastest", step_length=0.04).free_length


def test_side_steps_and_turns_are_in_place_unless_told_how_far_ahead():
    for asked in ({"side": -0.02}, {"turn": 0.1}):
        assert PlanRequest(**asked).first_length == 0.0
        assert PlanRequest(step_length=0.02, **asked).first_length == 0.02
        assert PlanRequest(objective="fastest", **asked).first_length == STEP_LENGTH
        ahead = PlanRequest(speed=0.1, **asked)
        assert (ahead.first_length, ahead.free_length) == (STEP_LENGTH, True)


def test_a_request_is_json_and_comes_back():
    request = PlanRequest(height=[0.2, 0.23], speed=0.1)
    text = json.dumps(request.document())
    assert PlanRequest(**json.loads(text)) == request
    assert request.changed(speed=0.2).speed == 0.2


def test_a_tenth_of_the_torque_speed_line_is_left_and_nothing_of_the_fastest():
    assert PlanRequest().line_reserve == 0.1
    fastest = PlanRequest(objective="fastest")
    assert fastest.line_reserve == 0.05
    # What it is doesn't change with the objective of a later step of the search.
    assert fastest.changed(objective="limits").line_reserve == 0.05
    assert PlanRequest(objective="fastest", line_reserve=0.2).line_reserve == 0.2
    with pytest.raises(BadInput, match="line_reserve"):
        PlanRequest(line_reserve=1.0)
