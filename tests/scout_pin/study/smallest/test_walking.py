"""The smallest servos for a walking speed: plans with them and without."""

import json

import pytest

import scout_pin
from scout_pin.study.plan.planning import plan_gait
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.smallest import walking
from scout_pin.study.smallest.servos import motor_family
from scout_pin.study.smallest.walking import servos_for_walk
from thesis_pin.errors import BadInput
from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue

REQUEST = PlanRequest(speed=0.05, step_length=0.03)
WEAK = Actuator("weak", 0.05, 5.0, mass=0.01)
GOOD = Actuator("good", 0.6, 5.0, mass=0.05, reflected=1e-4)
LARGE = Actuator("large", 3.0, 5.0, mass=0.2)


@pytest.fixture(scope="module")
def robot():
    return scout_pin.load()


class NoPlan:
    """What a plan that isn't met says; looking for one in vain takes half a minute."""

    interrupted, met, walk = False, False, None

    def failures(self):
        return ["all other limits could be kept but for one"]


def planned(robot, request):
    return NoPlan() if robot.stall_torque.max() < 0.1 else plan_gait(robot, request)


@pytest.fixture(scope="module")
def found(robot):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(walking, "plan_gait", planned)
        return servos_for_walk(robot, REQUEST, Catalogue((LARGE, GOOD, WEAK)))


def test_the_smallest_of_a_list_that_walks_is_found_and_larger_ones_aren_t_tried(found):
    assert [one.servo.name for one in found.tried] == ["weak", "good"]
    assert found.smallest.servo is GOOD
    assert "good at every joint is the smallest with which a walk of 50 mm/s" in found.verdict()[0]
    assert "Servos larger than the smallest that walks weren't tried." in found.notes()


def test_the_walk_is_judged_with_the_servo_s_own_line_and_rotor(found):
    report = found.smallest.plan.walk.report
    assert report.within_limits
    assert (report.robot.stall_torque == 0.6).all()
    assert (report.robot.no_load_speed == 5.0).all()
    assert report.robot.specification.armature() == pytest.approx(1e-4)


def test_documents_say_what_was_tried(found):
    document = json.loads(json_bytes(found.document("scout-pin")))
    assert document["schema"] == "scout-pin/walking-servos"
    assert [one["met"] for one in document["tried"]] == [False, True]
    assert document["tried"][0]["failures"]
    assert document["smallest"]["name"] == "good"
    assert csv_bytes(found.columns()).decode().splitlines()[1].startswith('"weak",0.05')


def test_torques_are_bisected_until_the_least_is_known(robot, monkeypatch):
    tried = []

    class Planned:
        interrupted = False

        def __init__(self, robot, request):
            self.met = robot.stall_torque.max() >= 0.3
            tried.append(float(robot.stall_torque.max()))

    monkeypatch.setattr(walking, "plan_gait", Planned)
    found = servos_for_walk(robot, REQUEST)
    assert found.smallest.servo.stall_torque == pytest.approx(0.3, rel=0.011)
    assert found.smallest.servo.stall_torque >= 0.3
    assert tried[0] == 0.432
    assert len(tried) <= walking.MOST_TRIED
    tried.clear()
    twice = servos_for_walk(robot, REQUEST, factor=2.0)
    assert twice.smallest.servo.stall_torque == pytest.approx(0.6, rel=0.011)


def test_a_walk_that_no_servo_of_a_list_does_is_no(robot, monkeypatch):
    monkeypatch.setattr(walking, "plan_gait", planned)
    found = servos_for_walk(robot, REQUEST, Catalogue((WEAK,)))
    assert not found.yes
    assert found.verdict() == [
        "With none of the servos tried a walk of 50 mm/s was found.",
        "With the last of them: all other limits could be kept but for one.",
    ]


def test_a_list_beside_a_kind_is_refused(robot):
    with pytest.raises(BadInput, match="a list and a kind"):
        servos_for_walk(robot, REQUEST, Catalogue((GOOD,)), family=motor_family(robot))
