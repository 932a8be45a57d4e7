"""The smallest servos for a gait: the gait's own report says the same of a robot that has them."""

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.files import load_gait
from scout_pin.specification import Specification
from scout_pin.study.smallest.asking import smallest_motors, time_with_motors
from scout_pin.study.smallest.servos import groups, motor_family
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sizing.catalogue import read_catalogue

from ...conftest import EXAMPLES


def report_with(torque, *, gait="cruise", unit=None, samples=401, **servo):
    data = Specification.read().model_dump()
    data["servos"]["HS-5475HB"] |= {"stall_torque": torque, **servo}
    robot = scout_pin.load(Specification.model_validate(data))
    gait = load_gait(gait if gait == "thesis" else EXAMPLES / f"{gait}.toml")
    return scout_pin.gait_report(robot, gait, samples=samples, time_unit=unit)


@pytest.fixture(scope="module")
def report():
    return report_with(0.432)


@pytest.fixture(scope="module")
def answer(report):
    return smallest_motors(report, curve=True)


def test_as_it_is_timed_the_report_uses_the_whole_line_and_is_passed_with_less(answer):
    torque = float(answer.cases[0].once.max())
    for share, most in ((1.0, 1.01), (0.95, 1.06)):
        use = report_with(torque * share, samples=4001).servo_use.max()
        assert use <= most
        assert (use > 1.01) == (share < 1)


def test_left_free_it_walks_within_limits_and_at_no_unit_of_time_with_less(answer):
    free = answer.cases[1]
    unit = free.duration / (load_gait(EXAMPLES / "cruise.toml").end)
    torque = float(free.once.max())
    own = report_with(torque * 1.001, unit=unit)
    assert own.within_limits
    assert own.servo_use.max() == pytest.approx(1.0, abs=0.005)
    less = report_with(torque * 0.95)
    assert less.time_units == []
    assert report_with(torque * 1.05).time_units != []


def test_the_curve_is_what_reports_with_such_servos_say(answer):
    curve = answer.curve
    span = load_gait(EXAMPLES / "cruise.toml").end
    for k in (3, 8, len(curve.actuators) - 1):
        own = report_with(curve.actuators[k].stall_torque)
        units = own.time_units
        assert curve.times["fastest"][k] == pytest.approx(units[0].shortest * span, rel=1e-6)
        assert curve.times["slowest"][k] == pytest.approx(units[-1].longest * span, rel=1e-6)


def test_servos_are_larger_where_the_gait_has_to_be_in_time(report, answer):
    span = load_gait(EXAMPLES / "cruise.toml").end
    free = float(answer.cases[1].once.max())
    soon = smallest_motors(report, law="free", within=4.5).cases[0]
    assert soon.duration <= 4.5 * (1 + 1e-9)
    torque = float(soon.once.max())
    assert torque > 1.02 * free
    assert report_with(torque * 1.001).time_units[0].shortest * span <= 4.5 * 1.001
    assert report_with(torque * 0.95).time_units[0].shortest * span > 4.5


def test_a_rotor_that_grows_is_the_one_the_report_has(report):
    family = motor_family(report.robot, armature=4e-3, exponent=2.0)
    case = smallest_motors(report, family, law="given").cases[0]
    torque = float(case.once.max())
    rotor = 4e-3 * torque**2
    own = report_with(torque, rotor_inertia=rotor)
    # In double support the feet share otherwise for another rotor: near, and not the same.
    assert own.servo_use.max() == pytest.approx(1.0, abs=0.05)
    free = smallest_motors(report, family, law="free").cases[0]
    size = float(free.once.max())
    assert report_with(size * 1.01, rotor_inertia=4e-3 * (size * 1.01) ** 2).time_units != []
    assert report_with(size * 0.95, rotor_inertia=4e-3 * (size * 0.95) ** 2).time_units == []


def test_a_gait_that_never_balances_sizes_servos_alone_and_says_so():
    thesis = report_with(0.432, gait="thesis", samples=201)
    answer = smallest_motors(thesis)
    assert "doesn't keep its balance" in answer.verdict()[-1]
    free = answer.cases[1]
    assert free.duration == pytest.approx(5 * 4.0)  # the slowest that is looked at
    assert float(free.once.max()) == pytest.approx(0.39, abs=0.005)


def test_a_factor_is_asked_for_in_both_timings(report):
    one, two = smallest_motors(report), smallest_motors(report, factor=1.5)
    given = [float(answer.cases[0].once.max()) for answer in (one, two)]
    free = [float(answer.cases[1].once.max()) for answer in (one, two)]
    assert given[1] / given[0] == pytest.approx(1.5)
    assert free[1] / free[0] == pytest.approx(1.5, rel=2e-3)


def test_groups_are_all_pairs_or_single_joints(report):
    given = smallest_motors(report, per="group", law="given").cases[0]
    np.testing.assert_allclose(given.once[:6], given.once[6:])
    each = smallest_motors(report, per="joint", law="given").cases[0]
    np.testing.assert_allclose(np.maximum(each.once[:6], each.once[6:]), given.once[:6])
    assert float(each.once.max()) == pytest.approx(
        float(smallest_motors(report, law="given").cases[0].once[0])
    )
    assert sorted(k for group in groups("group").values() for k in group) == list(range(12))
    with pytest.raises(UnknownName):
        groups("leg")


def test_a_list_is_timed_as_reports_with_its_servos_are(report):
    catalogue = read_catalogue(EXAMPLES / "servos.csv")
    found = time_with_motors(report, catalogue, within=6.0)
    one = next(k for k, servo in enumerate(catalogue.actuators) if servo.name == "strong")
    servo = catalogue.actuators[one]
    own = report_with(
        servo.stall_torque,
        no_load_speed=servo.no_load_speed,
        rotor_inertia=servo.armature,
    )
    span = load_gait(EXAMPLES / "cruise.toml").end
    assert found.curve.fastest[one] == pytest.approx(own.time_units[0].shortest * span, rel=1e-6)
    assert found.curve.smallest.name == "HS-5475HB at 6 V"
    assert not found.curve.able[0]


def test_a_speed_that_no_torque_gives_is_refused(report):
    slow = motor_family(report.robot, speed=1e-4)
    with pytest.raises(BadInput, match="carries the gait at any unit of time"):
        smallest_motors(report, slow)
