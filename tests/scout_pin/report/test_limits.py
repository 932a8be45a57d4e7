"""How fast a gait may be run: at the unit found, the limit is just met."""

import numpy as np
import pytest

import scout_pin
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.limits import fastest_time_unit
from scout_pin.specification import Specification

from ..conftest import EXAMPLES


def robot_with_friction(viscous, coulomb, stall=None):
    data = Specification.read().model_dump()
    data["assumptions"]["joint_friction"] |= {"viscous": viscous, "coulomb": coulomb}
    return scout_pin.load(Specification.model_validate(data))


ROBOTS = {
    "no friction": (0.0, 0.0),
    "viscous": (0.03, 0.0),
    "coulomb": (0.0, 0.05),
    "both": (0.03, 0.02),
}


def use(robot, gait, t, unit):
    """Largest share of speed, torque and torque-speed line, worked out at that unit."""
    motion = gait.sample(t, unit)
    joints = joint_trajectory(robot, motion)
    torque = np.abs(inverse_dynamics(robot, motion, joints).torque) / robot.stall_torque
    speed = np.abs(joints.v) / robot.no_load_speed
    return speed.max(), torque.max(), (torque + speed).max()


@pytest.fixture(params=ROBOTS)
def rubbing(request):
    return robot_with_friction(*ROBOTS[request.param])


@pytest.mark.parametrize("name", ["thesis", EXAMPLES / "walk.toml"])
def test_at_the_fastest_unit_a_limit_is_just_met(rubbing, name):
    """The inverse dynamics run again at the unit found, friction and all."""
    gait = load_gait(name)
    t = gait.sample_times(101)
    motion = gait.sample(t, gait.time_unit)
    joints = joint_trajectory(rubbing, motion)
    dynamics = inverse_dynamics(rubbing, motion, joints)
    found = fastest_time_unit(rubbing, gait, motion, joints, dynamics, gait.time_unit)
    assert use(rubbing, gait, t, found.speed)[0] == pytest.approx(1.0, rel=1e-9)
    for which, unit in ((1, found.torque), (2, found.line)):
        if unit is None:  # even standing still is too much
            assert use(rubbing, gait, t, 1e4)[which] > 1.0
        else:
            assert use(rubbing, gait, t, unit)[which] == pytest.approx(1.0, rel=2e-4)
            assert use(rubbing, gait, t, 1.01 * unit)[which] < 1.0


def test_the_fastest_unit_doesnt_depend_on_the_unit_asked_at(rubbing):
    gait = load_gait()
    t, found = gait.sample_times(101), []
    for unit in (0.05, 0.2):
        motion = gait.sample(t, unit)
        joints = joint_trajectory(rubbing, motion)
        dynamics = inverse_dynamics(rubbing, motion, joints)
        found.append(fastest_time_unit(rubbing, gait, motion, joints, dynamics, unit))
    for name in ("speed", "torque", "line"):
        assert getattr(found[0], name) == pytest.approx(getattr(found[1], name), rel=1e-4)


def test_a_gait_too_heavy_to_stand_in_has_no_unit():
    robot = robot_with_friction(0.0, 0.42)  # nearly the stall torque by friction alone
    gait = load_gait()
    motion = gait.sample(gait.sample_times(41))
    joints = joint_trajectory(robot, motion)
    found = fastest_time_unit(
        robot, gait, motion, joints, inverse_dynamics(robot, motion, joints), gait.time_unit
    )
    assert found.torque is None
    assert found.line is None
