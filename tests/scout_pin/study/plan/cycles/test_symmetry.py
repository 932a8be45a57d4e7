"""Bipeds that are their own mirror image, and others."""

import pytest

import scout_pin
from scout_pin.study.plan.cycles.feet import Steps
from scout_pin.study.plan.cycles.splines import Cyclic
from scout_pin.study.plan.cycles.starts import Build, standing_branches, starts
from scout_pin.study.plan.cycles.symmetry import mirrored
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Sampler


def alike(robot):
    request = PlanRequest()
    steps, build = Steps.of(robot, request), Build.of(robot)
    sampler = Sampler(robot, standing_branches(robot, build, steps, request))
    return mirrored(sampler, steps, next(starts(build, steps, Cyclic(1), 0.03)), 0.03)


def changed(change):
    data = scout_pin.Specification.read().model_dump()
    change(data)
    return scout_pin.load(scout_pin.Specification.model_validate(data))


def heavier(data):
    data["legs"]["right"]["links"][3]["mass"] *= 1.1


def weaker(data):
    data["servos"]["weak"] = data["servos"]["HS-5475HB"] | {"stall_torque": 0.3}
    data["legs"]["left"]["servo"] = "weak"


def aside(data):
    data["torso"]["com"] = (0.005, *data["torso"]["com"][1:])


def test_the_thesis_s_robot_is_and_one_with_unequal_legs_is_not(scout, lopsided):
    assert alike(scout)
    assert not alike(lopsided)


@pytest.mark.parametrize("change", [heavier, weaker, aside])
def test_a_difference_of_one_leg_or_of_the_torso_is_seen(change):
    assert not alike(changed(change))
