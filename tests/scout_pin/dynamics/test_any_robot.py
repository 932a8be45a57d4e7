"""Scout by the general way, as any robot with feet, against its own closed form."""

import numpy as np
import pinocchio as pin
import pytest
from commands import ROOT

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import joint_friction
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.loops.closures import ClosedRobot

EXAMPLES = ROOT / "examples"


def as_any_robot(robot):
    """The same robot from its URDF, without friction in its joints, and its feet."""
    general = ClosedRobot(robot.urdf, root_joint=pin.JointModelFreeFlyer())
    for what in ("damping", "upperDryFrictionLimit"):
        setattr(general.model, what, np.zeros(general.model.nv))
    frames = [robot.model.frames[robot.sole_frames[side]].name for side in ("left", "right")]
    feet = [
        Foot.of(frame, contact.outline, friction=contact.friction)
        for frame, contact in zip(frames, robot.contacts, strict=True)
    ]
    return general, feet


@pytest.mark.parametrize(
    ("specification", "gait"),
    [(None, "squat.toml"), (None, "walk.toml"), ("lopsided.toml", "lopsided_walk.toml")],
)
def test_both_ways_give_the_same_torques_forces_and_verdicts(specification, gait):
    robot = scout_pin.load(None if specification is None else EXAMPLES / specification)
    plan = scout_pin.load_gait(EXAMPLES / gait)
    motion = plan.sample(plan.sample_times(101))
    joints = joint_trajectory(robot, motion)
    own = scout_pin.inverse_dynamics(robot, motion, joints)
    general, feet = as_any_robot(robot)
    assert list(general.model.names) == list(robot.model.names)
    q, v, a = free_flyer_state(motion.torso, joints)
    found = foot_dynamics(general, feet, q, v, a, support=motion.support)
    friction = joint_friction(robot, joints.v, joints.resting)
    assert np.allclose(found.torque + friction, own.torque, rtol=0, atol=1e-10)
    assert np.allclose(found.wrench, own.wrench, rtol=0, atol=1e-10)
    assert (found.admissible == own.admissible).all()
    single = motion.support.sum(axis=1) == 1
    assert np.allclose(
        found.contact_margin[single], own.contact_margin[single], rtol=0, atol=1e-10, equal_nan=True
    )
    assert np.allclose(found.friction_used, own.friction_used, rtol=0, atol=1e-8, equal_nan=True)


def test_where_the_gait_tips_both_ways_say_so_and_by_how_much():
    robot = scout_pin.load()
    plan = scout_pin.load_gait("thesis")
    motion = plan.sample(plan.sample_times(101))
    joints = joint_trajectory(robot, motion)
    own = scout_pin.inverse_dynamics(robot, motion, joints)
    general, feet = as_any_robot(robot)
    found = foot_dynamics(
        general, feet, *free_flyer_state(motion.torso, joints), support=motion.support
    )
    assert (found.admissible == own.admissible).all()
    assert not own.admissible.all()
    for sample in np.flatnonzero(~own.admissible & (motion.support.sum(axis=1) == 1)):
        size, _ = own.least_violation(sample)
        assert found.violation[sample] == pytest.approx(size, rel=1e-9)
