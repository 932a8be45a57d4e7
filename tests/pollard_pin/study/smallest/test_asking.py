"""The smallest motors for a path: reports and fastest laws with such motors say the same."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATORS, Specification
from pollard_pin.study.size import loads_of
from pollard_pin.study.smallest.along import heat_along, loads_along
from pollard_pin.study.smallest.asking import _shape, smallest_motors, time_with_motors
from pollard_pin.study.smallest.free import AnyLaw
from pollard_pin.study.smallest.motors import groups, motor_family
from pollard_pin.study.smallest.searching import smallest_in
from pollard_pin.study.timing.limits import motor_limits
from pollard_pin.study.timing.timed import time_path
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.smallest.result import smallest
from thesis_pin.timing.fastest import fastest

EXAMPLES = Path(__file__).parents[4] / "examples"


def robot_with(torque=10.0, speed=20.0, **motors):
    data = Specification.read().model_dump()
    data["assumptions"]["joint_limits"] |= {"effort": torque, "velocity": speed}
    data["motors"] = motors
    return pollard_pin.load(Specification.model_validate(data))


def curve_b(duration=20.0):
    return pollard_pin.appendix_b(duration=duration, timing="rest-to-rest")


def arch(file="spray_arch.toml"):
    return pollard_pin.load_path(EXAMPLES / file)


@pytest.fixture(scope="module")
def crests():
    """Appendix B's curve, whose crests have a radius of a tenth of a millimetre."""
    report = pollard_pin.trajectory_report(pollard_pin.load(), curve_b(10.0), samples=801)
    path, family = AnyLaw(report), motor_family(report.robot)
    given = smallest(loads_of(report), family, groups("group"))
    return path, smallest_in(path, family, _shape(given), 10.0, lambda: None)


@pytest.fixture(scope="module")
def report():
    return pollard_pin.trajectory_report(pollard_pin.load(), arch(), samples=801)


@pytest.fixture(scope="module")
def answer(report):
    return smallest_motors(report, within=1.5, curve=True)


@pytest.fixture(scope="module")
def found(report):
    path, family = AnyLaw(report), motor_family(report.robot)
    given = smallest(loads_of(report), family, groups("group"))
    return path, family, smallest_in(path, family, _shape(given), 1.5, lambda: None)


def test_equal_base_motors_for_appendix_b_in_ten_seconds_and_the_report_of_their_law(crests):
    path, best = crests
    # A fine grid of a prototype found 1.75; a coarse one 1.82, and 3.5-fold between its points.
    assert best.torque[0] == pytest.approx(1.751, rel=4e-3)
    np.testing.assert_allclose(best.torque[:3], best.torque[0])
    assert best.solved.keeps
    timed = path.course.track.chain.timed(best.law, "found", {})
    assert timed.duration == pytest.approx(10.0, abs=1e-3)
    own = pollard_pin.trajectory_report(robot_with(tuple(best.torque)), timed, samples=8001)
    assert 0.97 <= own.motor_use.torque.max() <= 1.01
    less = path.limits_of(0.95 * best.torque, np.full(6, 20.0), np.zeros(6), line=False)
    assert path.fastest(less, best.grid) > 10.2


def test_as_it_is_timed_the_report_of_such_motors_is_at_its_limit(answer):
    given = answer.cases[0]
    assert given.law == "given"
    for share, within in ((1.001, True), (0.95, False)):
        robot = robot_with(tuple(np.maximum(given.once * share, 1e-6).tolist()))
        own = pollard_pin.trajectory_report(robot, arch(), samples=801)
        assert own.motor_use.within == within


def test_the_report_of_the_law_found_uses_no_more_than_its_motors_have(answer, found):
    path, _, best = found
    robot = robot_with(tuple(np.maximum(answer.cases[1].once, 1e-6).tolist()))
    timed = path.course.track.chain.timed(best.law, "found", {})
    own = pollard_pin.trajectory_report(robot, timed, samples=20001)
    assert timed.duration == pytest.approx(1.5, abs=1e-6)
    assert 0.99 <= own.motor_use.torque[:3].max() <= 1.01
    assert best.solved.keeps


def test_with_five_per_cent_less_the_fastest_law_takes_too_long(answer):
    once = answer.cases[1].once
    robot = pollard_pin.load()
    for share, late in ((1.01, False), (0.95, True)):
        torque = np.where(np.arange(6) < 3, share * once[0], 10.0)
        limits = motor_limits(robot.specification, torque=torque)
        assert (time_path(robot, arch(), limits).duration > 1.5) == late


def test_each_motor_of_its_own_keeps_the_time_too(report):
    case = smallest_motors(report, per="joint", law="free", within=1.5).cases[0]
    robot = pollard_pin.load()
    limits = motor_limits(robot.specification, torque=np.maximum(case.once, 1e-3) * 1.01)
    assert time_path(robot, arch(), limits).duration <= 1.5


def test_loads_along_a_law_are_the_report_s(found, report):
    path, _, best = found
    loads = loads_along(path, best, loads_of(report))
    timed = path.course.track.chain.timed(best.law, "found", {})
    dense = pollard_pin.trajectory_report(path.report.robot, timed, samples=20001)
    some = np.linspace(50, len(loads.time) - 50, 40).astype(int)
    bend = dense.joints.a[:, ACTUATORS]
    pairs = (loads.speed, dense.speed), (loads.torque, dense.torque), (loads.acceleration, bend)
    for values, own in pairs:
        columns = [np.interp(loads.time[some], dense.joints.time, one) for one in own.T]
        # Torque jumps where acceleration switches: most instants are apart from that.
        off = np.abs(np.stack(columns, axis=1) - values[some]).max(axis=1) / np.abs(own).max()
        assert np.quantile(off, 0.8) < 1e-3


def test_the_heat_of_a_law_is_the_root_mean_square_of_its_loads(found, report):
    path, family, best = found
    loads = loads_along(path, best, loads_of(report))
    np.testing.assert_allclose(
        heat_along(path, best, family)[:3], loads.rms(loads.torque)[:3], rtol=5e-3
    )


def test_the_law_of_least_heat_is_cooler_than_that_of_least_torque(answer):
    torque, heat = answer.cases[1], answer.cases[2]
    assert heat.law == "least-heat"
    assert heat.long[0] < torque.long[0]
    assert heat.once[0] > torque.once[0]
    assert heat.duration == pytest.approx(1.5)


def test_no_law_of_a_row_of_them_heats_the_base_less_than_that_of_least_heat(answer, found):
    """Fastest under 1 to 10 times the least torque, then slowed to the time that there is."""
    path, family, best = found
    limits = path.limits(best.torque, family)
    heats = []
    for more in np.geomspace(1.0, 10.0, 30):
        law = fastest(best.grid, replace(limits, effort=more * limits.effort))
        slow = replace(best, law=law.slower(min(law.duration / 1.5, 1.0)))
        heats.append(heat_along(path, slow, family)[:3].max())
    loads = answer.cases[2].loads
    assert loads.rms(loads.torque)[:3].max() == pytest.approx(min(heats), rel=0.015)
    assert heats[0] > 1.025 * min(heats)


def test_the_curve_is_that_of_fastest_laws_and_of_reports_run_faster(answer, report):
    curve, robot = answer.curve, pollard_pin.load()
    shape = np.array([1, 1, 1, 0.1, 0.1, 0.1])
    for k in (2, 11):
        limit = curve.actuators[k].stall_torque
        fast = time_path(robot, arch(), motor_limits(robot.specification, torque=limit * shape))
        assert curve.fastest[k] == pytest.approx(fast.duration, rel=0.02)
        scaled = _scaled_use(report, float(curve.times["scaled"][k]), limit)
        assert scaled == pytest.approx(1.0, rel=1e-6)
    assert (np.diff(curve.fastest) < 0).all()


def _scaled_use(report, duration, limit):
    """Torques of the same joints' motion run faster, by inverse dynamics."""
    speed = report.path.duration / duration
    joints = report.joints
    found = inverse_dynamics_at(report.robot, joints.q, speed * joints.v, speed**2 * joints.a)
    return np.abs(found.torque[:, :3]).max() / limit


def test_servos_with_a_line_are_scaled_as_inverse_dynamics_says(report):
    motor = Actuator("servo", 2.0, 6.0, reflected=0.01)
    found = time_with_motors(report, Catalogue((motor,)), within=20.0)
    speed = report.path.duration / float(found.curve.times["scaled"][0])
    joints, robot = report.joints, robot_with(rotor_inertia=0.01)
    own = inverse_dynamics_at(robot, joints.q, speed * joints.v, speed**2 * joints.a)
    use = np.abs(own.torque) / 2.0 + speed * np.abs(report.speed) / 6.0
    assert use.max() == pytest.approx(1.0, rel=1e-6)


def test_a_list_is_timed_by_fastest_laws_and_the_smallest_in_time_is_named(report):
    motors = (
        Actuator("weak", 0.5, 8.0, mass=0.1),
        Actuator("slow", 0.9, 8.0, mass=0.2, reflected=0.01),
        Actuator("good", 2.0, 9.0, mass=0.3, reflected=0.01),
        Actuator("large", 9.0, 9.0, mass=0.9, reflected=0.02),
    )
    found = time_with_motors(report, Catalogue(motors), within=1.2)
    assert found.curve.smallest.name == "good"
    assert np.isnan(found.curve.fastest[0])
    robot = pollard_pin.load()
    limits = motor_limits(robot.specification, torque=2.0, speed=9.0, line=True, rotor=0.01)
    own = time_path(robot, arch(), limits)
    assert found.curve.fastest[2] == pytest.approx(own.duration, rel=0.02)
    assert found.verdict()[0].startswith("good is the smallest of 4 (by mass)")


def test_rotors_that_grow_and_lines_are_kept_by_the_law_found(report):
    family = motor_family(report.robot, armature=2e-3, exponent=2.0, speed=12.0, bound="line")
    case = smallest_motors(report, family, law="free", factor=1.2, within=2.0).cases[0]
    torque = case.once
    limits = motor_limits(
        report.robot.specification,
        torque=np.maximum(torque, 1e-2) * 1.01 / 1.2,
        speed=12.0,
        rotor=2e-3 * torque**2,
        line=True,
    )
    assert time_path(report.robot, arch(), limits).duration <= 2.0


def test_a_power_has_motors_in_a_window_of_gears(report):
    family = motor_family(report.robot, power=4.0)
    case = smallest_motors(report, family, law="free", within=2.0).cases[0]
    speed = 16.0 / np.maximum(case.once, 1e-9)
    limits = motor_limits(
        report.robot.specification,
        torque=np.maximum(case.once, 1e-3) * 1.01,
        speed=np.minimum(speed, 1e3),
        line=True,
    )
    assert time_path(report.robot, arch(), limits).duration <= 2.0 * 1.01
    with pytest.raises(BadInput, match="however strong"):
        smallest_motors(report, motor_family(report.robot, power=1e-3), law="free", within=2.0)


def test_motors_that_are_too_slow_for_the_time_are_refused(report):
    slow = motor_family(report.robot, speed=0.05)
    with pytest.raises(BadInput, match="do the path in that time, however strong"):
        smallest_motors(report, slow, law="free")
    with pytest.raises(BadInput, match="within"):
        smallest_motors(report, law="free", within=0.0)


def test_names_of_groups_hold_all_motors_once():
    for per in ("robot", "group", "joint"):
        assert sorted(k for one in groups(per).values() for k in one) == list(range(6))
    assert list(groups("joint")) == list(ACTUATOR_NAMES)
    with pytest.raises(UnknownName):
        groups("pair")


def test_motors_that_can_t_hold_the_robot_are_never_in_time(report):
    path, family = AnyLaw(report), motor_family(report.robot)
    assert path.fastest(path.limits(np.full(6, 0.5), family), path.course.grid) == np.inf
