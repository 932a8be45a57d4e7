"""How fast a gait may be run: at each end found, a limit is just met."""

import dataclasses

import numpy as np
import pytest

import scout_pin
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.dynamics.scaling import DoubleSupport
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Phase
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.judged.limits import (
    SPEEDS,
    Limit,
    TimeUnits,
    fastest_time_unit,
    headline,
)
from scout_pin.report.judged.speeds import Speeds
from scout_pin.report.judged.trial import Trial
from scout_pin.specification import Specification
from thesis_pin.errors import NoSupportForce
from thesis_pin.numeric.interpolation import linear, polynomial
from thesis_pin.tolerances import TOLERANCES

from ...conftest import EXAMPLES


def robot_with_friction(viscous, coulomb):
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
    found = fastest_time_unit(Speeds(rubbing, motion, joints, dynamics), gait.time_unit)
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
        found.append(fastest_time_unit(Speeds(rubbing, motion, joints, dynamics), unit))
    for name in ("speed", "torque", "line"):
        assert getattr(found[0], name) == pytest.approx(getattr(found[1], name), rel=1e-4)


def test_a_gait_too_heavy_to_stand_in_has_no_unit():
    robot = robot_with_friction(0.0, 0.42)  # nearly the stall torque by friction alone
    gait = load_gait()
    motion = gait.sample(gait.sample_times(41))
    joints = joint_trajectory(robot, motion)
    speeds = Speeds(robot, motion, joints, inverse_dynamics(robot, motion, joints))
    found = fastest_time_unit(speeds, gait.time_unit)
    assert found.torque is None
    assert found.line is None


def with_servos(stall, no_load):
    data = Specification.read().model_dump()
    for servo in data["servos"].values():
        servo |= {"stall_torque": stall, "no_load_speed": no_load}
    return scout_pin.load(Specification.model_validate(data))


def on_two_feet(unit, **torso):
    """Both feet stand from t = −1 to 1; polynomials in t move the torso."""
    gait = load_gait(EXAMPLES / "squat.toml")
    curves = {
        body: [polynomial(-1, 1, [float(curve(0.0))]) for curve in six]
        for body, six in gait.curves.items()
    }
    for name, coefficients in torso.items():
        curves["torso"]["xyz".index(name)] = polynomial(-1, 1, coefficients)
    phases = (Phase(start=-1, end=1, support="double"),)
    made = {body: tuple(six) for body, six in curves.items()}
    return dataclasses.replace(gait, curves=made, phases=phases, time_unit=unit)


# Forward and back again, pushed by inertia: slowed, the centre of mass is outside the soles.
LEANING = {"unit": 0.2, "y": [0.02, 0.0, 0.11], "z": [0.19]}
# A fall that spares servos which can't hold the posture.
FALLING = {"unit": 0.1, "y": [0.0385], "z": [-0.01, 0.0, 0.22]}


def keeps_its_limits(robot, gait, unit):
    """The whole report at another unit."""
    try:
        return scout_pin.gait_report(robot, gait, samples=61, time_unit=unit).within_limits
    except NoSupportForce:  # falling faster than gravity
        return False


@pytest.mark.parametrize("friction", ROBOTS)
@pytest.mark.parametrize("unit", [1, 0.3, 4])
@pytest.mark.parametrize("name", ["thesis", "walk", "squat", "lopsided_walk"])
def test_just_inside_each_end_the_report_says_yes_and_just_outside_no(
    lopsided, name, unit, friction
):
    """Every gait and specification that is shipped, at several given units."""
    if name == "lopsided_walk":
        if friction != "no friction":
            pytest.skip("that robot has friction of its own")
        robot = lopsided
    else:
        robot = robot_with_friction(*ROBOTS[friction])
    gait = load_gait(name if name == "thesis" else EXAMPLES / f"{name}.toml")
    check_ends(robot, gait, unit * gait.time_unit)


@pytest.mark.parametrize(
    ("gait", "servos"),
    [
        (LEANING, (0.432, 4.55)),
        (LEANING | {"y": [0.02, 0.0, 0.105]}, (0.432, 4.55)),
        (FALLING, (0.115, 60.0)),
        (FALLING, (0.12, 60.0)),
        (FALLING, (0.2, 4.55)),
    ],
)
def test_a_gait_that_walks_only_in_motion_has_both_ends(gait, servos):
    robot, gait = with_servos(*servos), on_two_feet(**gait)
    check_ends(robot, gait, gait.time_unit, everywhere=True)


def check_ends(robot, gait, unit, everywhere=False):
    report = scout_pin.gait_report(robot, gait, samples=61, time_unit=unit)
    found = report.time_units
    low, high = (unit / speed for speed in reversed(SPEEDS))
    for one in found:
        assert low * (1 - 1e-12) <= one.shortest < one.longest <= high * (1 + 1e-12)
        assert keeps_its_limits(robot, gait, one.shortest * 1.001)
        assert keeps_its_limits(robot, gait, one.longest * 0.999)
        assert keeps_its_limits(robot, gait, np.sqrt(one.shortest * one.longest))
        if one.below.cause != "range":
            assert not keeps_its_limits(robot, gait, one.shortest * 0.999)
        if one.above.cause != "range":
            assert not keeps_its_limits(robot, gait, one.longest * 1.001)
    if everywhere or not found:
        for tried in np.geomspace(low * 1.0001, high * 0.9999, 25 if everywhere else 5):
            inside = any(one.shortest <= tried <= one.longest for one in found)
            assert keeps_its_limits(robot, gait, tried) == inside
    assert report.within_limits == any(one.shortest <= unit <= one.longest for one in found)


def test_a_gait_that_tips_when_slowed_says_so_and_one_that_gravity_overloads_isnt_contradicted():
    leaning = scout_pin.gait_report(with_servos(0.432, 4.55), on_two_feet(**LEANING), samples=61)
    (found,) = leaning.time_units
    assert (found.below.cause, found.above.cause) == ("servo", "zmp")
    text = " ".join(leaning.verdict())
    assert "It walks, and the servos carry it, at time units from 0.1896 s" in text
    assert "the ZMP leaves the support polygon at t = -1" in text
    falling = scout_pin.gait_report(with_servos(0.12, 60.0), on_two_feet(**FALLING), samples=61)
    assert falling.servos_carry
    assert falling.fastest.line is None  # standing still is too much
    text = " ".join(falling.verdict())
    assert "gravity alone" not in text
    assert "to 0.1885 s (the servo of left_knee_pitch at t = -1)" in text
    (document,) = falling.summary()["time_units"]
    assert document["longest"] == falling.time_units[0].longest
    assert document["above"]["joint"] == "left_knee_pitch"


def test_the_headline_is_the_interval_with_the_given_unit_or_else_the_nearest():
    gait = on_two_feet(**LEANING)
    at = {
        unit: scout_pin.gait_report(with_servos(0.432, 4.55), gait, samples=61, time_unit=unit)
        for unit in (0.25, 0.5, 3.0)
    }
    for report in at.values():
        found = headline(report.time_units, report.time_unit)
        if report.time_unit == 3.0:  # a fifth of it is already too slow
            assert found is None
            assert "At no time unit from 0.6 to 15 s would it" in " ".join(report.verdict())
        else:
            assert found.longest == pytest.approx(0.3122, abs=1e-4)
    assert "It walks, and the servos carry it, at" in " ".join(at[0.25].verdict())
    assert "It would do both at time units from 0.1896 s" in " ".join(at[0.5].verdict())


@pytest.mark.parametrize(
    ("unit", "nearest"), [(0.05, 0), (0.19, 0), (0.25, 0), (0.9, 1), (1.5, 1), (5.0, 2), (90.0, 2)]
)
def test_of_several_intervals_the_headline_is_the_nearest_by_ratio(unit, nearest):
    """Between 0.3 and 2 that is by their middle on a logarithmic scale, 0.77."""
    end = Limit("range")
    units = [TimeUnits(*ends, end, end) for ends in ((0.2, 0.3), (2.0, 3.0), (6.0, 8.0))]
    assert headline(units, unit) is units[nearest]
    assert headline([], unit) is None


@pytest.mark.parametrize(("cycle", "cause"), [(True, "gap"), (False, "rate jump")])
def test_a_rate_that_jumps_by_little_sets_a_unit_from_which_it_is_none(scout, cycle, cause):
    """The torso's rate changes by 2e-4 m/s at the unit given: twice what counts as a jump."""
    gait = load_gait(EXAMPLES / "squat.toml")
    size, length = 2 * TOLERANCES.rate_jump * gait.time_unit, gait.end - gait.start
    middle = (gait.start + gait.end) / 2
    place = float(gait.curves["torso"][1](gait.start))
    if cycle:  # down and up again on a parabola: the rate at the end isn't that at the start
        bend = size / (2 * length)
        curve = polynomial(gait.start, gait.end, [bend, -bend * length, place])
    else:
        curve = linear([gait.start, middle, gait.end], [place, place + size * length / 4, place])
    torso = list(gait.curves["torso"])
    torso[1] = curve
    bent = dataclasses.replace(gait, curves=gait.curves | {"torso": tuple(torso)}, cycle=cycle)
    (found,) = scout_pin.gait_report(scout, bent, samples=61).time_units
    assert found.below.cause == cause
    assert found.shortest == pytest.approx(2 * gait.time_unit, rel=1e-3)
    check_ends(scout, bent, gait.time_unit)


@pytest.mark.parametrize("unit", [0.3, 0.7, 1.0, 1.6])
def test_of_legs_and_times_that_mirror_each_other_the_left_and_the_first_are_named(scout, unit):
    """A squat goes down and up alike; rounding named any of four servos and times."""
    gait = load_gait(EXAMPLES / "squat.toml")
    for samples in (61, 401):
        found = scout_pin.gait_report(
            scout, gait, samples=samples, time_unit=unit * gait.time_unit
        ).time_units
        limits = {one.below for one in found} | {one.above for one in found}
        (servo,) = {limit for limit in limits if limit.cause == "servo"}
        assert servo.joint == "left_knee_pitch"
        assert servo.t < (gait.start + gait.end) / 2


def test_what_happens_at_any_speed_leaves_no_interval(scout):
    report = scout_pin.gait_report(scout, load_gait(EXAMPLES / "walk.toml"), samples=41)
    lowered = report.motion.left_foot.position - (0.0, 0.0, 1e-3)
    foot = dataclasses.replace(report.motion.left_foot, position=lowered)
    dug = dataclasses.replace(report, motion=dataclasses.replace(report.motion, left_foot=foot))
    assert report.time_units
    assert dug.time_units == []


@pytest.mark.parametrize("s", [0.5, 1.0, 2.5])
def test_double_support_uses_its_servos_at_any_speed_as_inverse_dynamics_says(rubbing, s):
    gait = load_gait(EXAMPLES / "walk.toml")
    t, unit = gait.sample_times(101), 0.2
    motion = gait.sample(t, unit)
    joints = joint_trajectory(rubbing, motion)
    some = np.flatnonzero(motion.support.all(axis=1))
    double = DoubleSupport.of(rubbing, motion, joints, some)
    every = np.arange(len(some))
    speed = np.abs(joints.part(some).v) / rubbing.no_load_speed
    trial = Trial(double, speed, rubbing.stall_torque, "servo", stands=True)
    _, found, joint = trial.uses(s, every)
    faster = gait.sample(t, unit / s)
    moving = joint_trajectory(rubbing, faster)
    torque = np.abs(inverse_dynamics(rubbing, faster, moving).torque) / rubbing.stall_torque
    wanted = (torque + np.abs(moving.v) / rubbing.no_load_speed)[some]
    np.testing.assert_allclose(found, wanted.max(axis=1), rtol=1e-6)
    np.testing.assert_allclose(wanted[every, joint], wanted.max(axis=1), rtol=1e-6)
