"""Slips, tips and turns are called so, with amounts worked out by hand."""

import numpy as np
import pinocchio as pin
import pytest
from standing_robots import ROBOTS, standing

from thesis_pin.contacts.balance.causes import cause
from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.loops.closures import ClosedRobot

BLOCK = """<robot name="block"><link name="body"><inertial><origin xyz="0 0 0.5"/>
<mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="lid"><inertial><origin xyz="0 0 0"/><mass value="1e-3"/>
<inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="body"/><child link="lid"/>
<origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint></robot>"""
CORNERS = ((0.1, 0.1), (-0.1, 0.1), (-0.1, -0.1), (0.1, -0.1))
WEIGHT = 10.001 * 9.81


def block(friction=0.6, corners=CORNERS):
    robot = ClosedRobot(BLOCK, root_joint=pin.JointModelFreeFlyer())
    return robot, [Foot.of("body", corners, friction=friction)]


def pushed(robot, feet, forward=0.0, up=0.0, yaw=0.0):
    """The block accelerated by the floor."""
    a = np.zeros(robot.model.nv)
    a[[0, 2, 5]] = forward, up, yaw
    return foot_dynamics(robot, feet, robot.q0, np.zeros(robot.model.nv), a)


def test_a_block_pushed_low_slips_and_needs_the_friction_of_its_acceleration():
    robot, feet = block(friction=0.05)
    found = pushed(robot, feet, forward=0.1 * 9.81)
    assert not found.admissible[0]
    why = cause(found, 0)
    assert why.slips
    assert (why.tip, why.push, why.pull, why.outside) == (0.0, 0.0, 0.0, 0.0)
    assert why.friction * 0.05 == pytest.approx(0.1, rel=6e-3)  # 32 edges: within 0.5 %
    assert pushed(robot, feet, forward=0.049 * 0.92 * 9.81).admissible[0]


@pytest.mark.parametrize("share", [0.25, 0.5])
def test_a_block_pushed_high_tips_by_the_moment_beyond_its_edge(share):
    robot, feet = block()
    found = pushed(robot, feet, forward=share * 9.81)
    why = cause(found, 0)
    beyond = 0.5 * share - 0.1  # the centre of mass is 0.5 m high, the edge 0.1 m away
    assert found.margin[0] == pytest.approx(-beyond, rel=1e-3)
    assert why.outside == pytest.approx(beyond, rel=1e-3)
    assert why.friction is None
    assert not why.slips
    assert why.tip == pytest.approx(beyond * WEIGHT, rel=1e-3)
    assert 0 < found.violation[0] <= why.tip  # a force and a moment together are less


def test_a_block_on_a_slope_slips_at_the_angle_of_friction_and_tips_at_that_of_its_edge():
    robot, feet = block(friction=1.0)
    for degrees, stands in ((10.0, True), (11.0, True), (11.6, False)):  # tan 11.31° = 0.1 / 0.5
        floor = Floor(0.0, np.radians(degrees))
        found = foot_dynamics(robot, feet, stand(robot, feet, robot.q0, floor).q, floor=floor)
        assert found.admissible[0] == stands
        assert (found.margin[0] > 0) == stands
    robot, feet = block(friction=np.tan(np.radians(9.0)))
    for degrees, stands in ((8.0, True), (9.3, False)):
        floor = Floor(0.0, np.radians(degrees))
        found = foot_dynamics(robot, feet, stand(robot, feet, robot.q0, floor).q, floor=floor)
        assert found.admissible[0] == stands
    assert cause(found, 0).slips


def test_a_falling_block_would_have_to_be_held_down_by_the_missing_force():
    robot, feet = block()
    found = pushed(robot, feet, up=-9.81 - 1.0)
    why = cause(found, 0)
    assert not found.admissible[0]
    assert why.pull == pytest.approx(10.001, rel=1e-9)
    assert np.isneginf(found.margin[0])


def test_a_point_can_t_turn_a_robot_whatever_its_friction():
    robot, _ = block()
    point = [Foot.of("body", friction=50.0)]
    found = pushed(robot, point, yaw=2.0)
    why = cause(found, 0)
    assert why.turn == pytest.approx(2.0, rel=1e-3)
    assert why.friction is None
    assert why.tip < 1e-9


def test_a_robot_in_flight_without_a_foot_misses_its_whole_weight():
    robot, feet = block()
    found = foot_dynamics(robot, feet, robot.q0, support=np.array([False]))
    assert found.violation[0] == pytest.approx(WEIGHT * found.length, rel=1e-9)
    assert cause(found, 0).pull == 0.0
    assert not found.wrench.any()


def test_bolt_on_its_two_points_tips_about_their_line():
    robot, feet, pose = standing("bolt")
    found = foot_dynamics(robot, feet, stand(robot, feet, pose).q)
    why = cause(found, 0)
    weight = pin.computeTotalMass(robot.model) * 9.81
    assert why.outside == pytest.approx(-found.margin[0])
    assert why.tip == pytest.approx(why.outside * weight, rel=1e-6)


@pytest.mark.parametrize("name", ROBOTS)
def test_on_steep_floors_every_robot_slips_at_the_tangent_or_tips_as_its_margin_says(name):
    robot, feet, pose = standing(name)
    weight = pin.computeTotalMass(robot.model) * 9.81
    rng = np.random.default_rng(21)
    slipped = 0
    for degrees in (10.0, 33.0, 40.0):
        floor = Floor(0.0, np.radians(degrees), rng.uniform(-np.pi, np.pi))
        found = foot_dynamics(robot, feet, stand(robot, feet, pose, floor).q, floor=floor)
        tips = found.margin[0] < 0
        slides = np.tan(np.radians(degrees)) > 0.6
        assert found.admissible[0] <= (not tips and not slides)
        if found.admissible[0]:
            continue
        why = cause(found, 0, border=1e-3 * weight)
        if tips and why.outside > 2e-3:
            assert why.friction is None
            # The moment about the polygon's border, of the force across it.
            press = found.required[0, :3] @ floor.normal
            assert why.tip == pytest.approx(why.outside * press, rel=2e-2)
        elif not tips:
            slipped += 1
            assert why.friction * 0.6 == pytest.approx(np.tan(np.radians(degrees)), rel=1e-2)
    assert slipped or name in ("bolt", "talos", "g1")
