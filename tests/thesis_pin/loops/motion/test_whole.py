"""All joints from some: loops stay closed, rates are derivatives, whoever drives."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import SingularPose
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.joints import singles
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import JointMotion
from thesis_pin.loops.motion.whole import whole_motion

DATA = Path(__file__).parents[1] / "data"
TIME = np.linspace(0, 1, 401)


def robot(name):
    return load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")


def swing(*joints, start=0.0, size=0.3, speed=2.0):
    """Joints that swing from a place, each a little later than the one before."""
    phase = speed * TIME[:, None] + 0.3 * np.arange(len(joints))
    position = np.asarray(start) + size * (1 - np.cos(phase))
    rate, acceleration = size * speed * np.sin(phase), size * speed**2 * np.cos(phase)
    return JointMotion("swing", TIME, joints, position, rate, acceleration)


def driven(name, *joints):
    one = robot(name)
    pose = assembly(one).q
    known = singles(one.model)
    start = [float(known[joint].position(pose)) for joint in joints]
    return one, whole_motion(one, swing(*joints, start=start), pose)


def openings(one, q):
    """Distance of each loop's frames, by Pinocchio."""
    data = one.model.createData()
    for row in q:
        pin.framesForwardKinematics(one.model, data, row)
        for loop in one.loops:
            a, b = (data.oMf[k].translation for k in loop.ids)
            yield np.linalg.norm(a - b)


@pytest.mark.parametrize(
    ("name", "joints"), [("four_bar", ["motor"]), ("five_bar", ["motor_left", "motor_right"])]
)
def test_loops_stay_closed_and_rates_and_accelerations_are_derivatives(name, joints):
    one, found = driven(name, *joints)
    motion = found.joints
    assert found.driving == tuple(joints)
    assert max(openings(one, motion.q)) < 1e-9
    step = TIME[1] - TIME[0]
    v = (motion.q[2:] - motion.q[:-2]) / (2 * step)
    a = (motion.v[2:] - motion.v[:-2]) / (2 * step)
    np.testing.assert_allclose(motion.v[1:-1], v, atol=2e-4 * np.abs(v).max())
    np.testing.assert_allclose(motion.a[1:-1], a, atol=2e-4 * np.abs(a).max())


def told_by_pivot(start):
    """The four-bar's crank swings from a place, and the rocker is told to do as it does."""
    one = robot("four_bar")
    bent = {"motor": (start,), "pin_a": (1.0,), "pivot": (1.0,)}
    posed = replace(one.supplement, poses={"bent": bent})
    pose = assembly(type(one)(replace(one.description, supplement=posed)), "bent").q
    by_motor = whole_motion(one, swing("motor", start=[start]), pose).joints
    place = singles(one.model)["pivot"].v
    told = [x[:, [place]] for x in (by_motor.q, by_motor.v, by_motor.a)]
    return one, by_motor.q[0], by_motor, JointMotion("pivot", TIME, ("pivot",), *told)


def test_a_motion_told_by_a_passive_joint_is_the_one_its_motor_makes():
    one, pose, by_motor, told = told_by_pivot(1.0)
    found = whole_motion(one, told, pose)
    assert found.driving == ("pivot",)
    np.testing.assert_allclose(found.joints.q, by_motor.q, atol=1e-7)
    np.testing.assert_allclose(found.joints.v, by_motor.v, atol=1e-6)


def test_a_rocker_that_turns_back_does_not_say_where_its_crank_goes():
    # Crank and coupler in line: the crank may go on or turn back, the rocker does the same.
    for start in np.arange(-1.2, -0.6, 0.1):
        one, pose, by_motor, told = told_by_pivot(float(start))
        stretched = np.diff(np.sign(by_motor.q[:, 1])).any()
        try:
            found = whole_motion(one, told, pose).joints
        except SingularPose:
            assert stretched
        else:
            np.testing.assert_allclose(found.q, by_motor.q, atol=1e-6)


def test_a_motor_without_a_column_stays_at_the_pose_and_is_named():
    one, found = driven("five_bar", "motor_left")
    assert found.still == ("motor_right",)
    place = singles(one.model)["motor_right"]
    assert np.ptp(found.joints.q[:, place.q]) == 0
    assert max(openings(one, found.joints.q)) < 1e-9


def test_the_pose_chooses_the_assembly_however_far_the_first_sample_is():
    one = robot("four_bar")
    ends = []
    for sign in (1, -1):
        pose = {"motor": (1.0,), "pin_a": (float(sign),), "pivot": (float(sign),)}
        posed = replace(one.supplement, poses={"start": pose})
        described = replace(one.description, supplement=posed)
        closed = assembly(type(one)(described), "start").q
        far = swing("motor", start=[float(closed[0]) - 1.0])
        ends.append(whole_motion(one, far, closed).joints.q[0])
    assert ends[0][0] == pytest.approx(ends[1][0] + ends[0][0] - ends[1][0])
    assert np.sign(ends[0][2]) != np.sign(ends[1][2])


def test_joints_that_do_not_determine_the_others_are_refused():
    with pytest.raises(SingularPose):
        driven("five_bar", "elbow_left")
