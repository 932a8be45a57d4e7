"""The least stall torque, by hand and by trying: what is said carries, a little less doesn't."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.sizing.judging import fits
from thesis_pin.sizing.loads import Loads
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.result import smallest, up

TIME = np.linspace(0, 2, 401)


def loads(torque, speed, acceleration=0.0, joints=("knee",)):
    shape = (len(TIME), len(joints))
    some = (np.broadcast_to(np.asarray(x, dtype=float), shape) for x in (torque, speed))
    bend = np.broadcast_to(np.asarray(acceleration, dtype=float), shape)
    return Loads("robot", "motion", tuple(joints), TIME, *some, bend)


def test_a_line_needs_the_torque_over_what_its_speed_leaves():
    # 0.6 N·m at 4 of 10 rad/s: 0.6 of the stall torque are left, so that it has to be 1 N·m.
    found = smallest(loads(-0.6, 4.0), Family.of(1, 10.0))
    assert found.once[0] == pytest.approx(1.0)
    # For long 0.6 / 0.5 = 1.2 N·m.
    assert found.long[0] == pytest.approx(1.2)
    assert found.yes


def test_a_box_needs_the_peak_and_nothing_beyond_its_speed():
    load = loads([[0.6, 0.6]], [[4.0, 11.0]], joints=("a", "b"))
    found = smallest(load, Family.of(2, 10.0, bound="box"), factor=1.5)
    assert found.once[0] == pytest.approx(0.9)
    assert np.isnan(found.once[1])
    assert not found.yes
    assert "no motor of this kind carries b" in " ".join(found.sentences())


def test_a_load_at_the_free_speed_is_beyond_every_torque():
    assert np.isnan(smallest(loads(0.1, 10.0), Family.of(1, 10.0)).once[0])


def test_a_speed_that_nothing_bounds_leaves_the_whole_torque():
    assert smallest(loads(0.6, 400.0), Family.of(1, np.inf)).once[0] == pytest.approx(0.6)


def test_a_joint_without_load_needs_no_torque_below_the_free_speed_and_has_none_above():
    load = loads([[0.0, 0.0, 0.0]], [[9.0, 11.0, 10.0]], joints=("a", "b", "c"))
    found = smallest(load, Family.of(3, 10.0))
    assert found.once[0] == 0.0
    assert np.isnan(found.once[1])
    assert found.once[2] == 0.0  # just as fast as it turns freely


def test_a_rotor_that_grows_with_the_torque_is_solved_for():
    # T = 0.6 + 0.01 T² · 8, the smaller root of 0.08 T² − T + 0.6 = 0.
    found = smallest(loads(0.6, 0.0, 8.0), Family.of(1, 10.0, 0.01, exponent=2.0, rating=1.0))
    by_hand = (1 - np.sqrt(1 - 4 * 0.08 * 0.6)) / (2 * 0.08)
    assert found.once[0] == pytest.approx(by_hand, rel=1e-3)
    assert found.once[0] >= by_hand * (1 - 1e-12)


def test_a_rotor_that_eats_what_its_motor_has_leaves_none():
    # T = 0.6 + 1.1 T has no positive root.
    found = smallest(loads(0.6, 0.0, 11.0), Family.of(1, 10.0, 0.1, exponent=1.0))
    assert np.isnan(found.once[0])


def test_a_power_is_met_between_two_gears_and_the_smaller_torque_is_found():
    # At 4 rad/s and 0.5 N·m of a line with 4 P = 10 W: 0.5 / T + 4 T / 10 = 1.
    found = smallest(loads(0.5, 4.0), Family.of(1, 1.0, power=2.5, rating=1.0))
    roots = np.roots([0.4, -1.0, 0.5])
    assert found.once[0] == pytest.approx(roots.min(), rel=1e-3)
    # Less power than torque times speed is met by no gear.
    assert np.isnan(smallest(loads(0.5, 4.0), Family.of(1, 1.0, power=1.9)).once[0])


def test_a_narrow_window_between_two_gears_is_found():
    # 4 P = 8.0001 W: the line touches the load at T = 1 N·m.
    found = smallest(loads(0.5, 4.0), Family.of(1, 1.0, power=2.00003, rating=1.0))
    assert found.once[0] == pytest.approx(1.0, rel=0.01)


def test_motors_of_a_group_are_alike_and_each_its_own_otherwise():
    load = loads([[0.2, 0.8]], [[1.0, 1.0]], joints=("a", "b"))
    family = Family.of(2, [5.0, 10.0])
    alike = smallest(load, family, {"both": (0, 1)})
    np.testing.assert_allclose(alike.once, max(0.2 / 0.8, 0.8 / 0.9))
    np.testing.assert_allclose(smallest(load, family).once, [0.2 / 0.8, 0.8 / 0.9])
    np.testing.assert_allclose(alike.use, [0.25 / (0.8 / 0.9), 1.0])


@settings(deadline=None)
@given(
    torque=st.lists(st.floats(-2, 2), min_size=5, max_size=5),
    speed=st.lists(st.floats(-8, 8), min_size=5, max_size=5),
    bend=st.lists(st.floats(-30, 30), min_size=5, max_size=5),
    rotor=st.floats(0, 0.01),
    exponent=st.sampled_from([0.0, 1.0, 5 / 3, 2.0]),
    factor=st.floats(1.0, 2.0),
)
def test_what_is_found_carries_by_the_judgement_of_lists_and_less_doesn_t(
    torque, speed, bend, rotor, exponent, factor
):
    assume(max(map(abs, torque)) > 0.1)
    time = np.linspace(0.0, 1.0, 5)
    # A rotor adds to what there is: where it takes from it, more than one window may do.
    bend = np.abs(bend) * np.sign(torque)
    columns = (np.array(x)[:, None] for x in (torque, speed, bend))
    load = Loads("r", "m", ("j",), time, *columns)
    family = Family.of(1, 10.0, rotor, exponent=exponent)
    values = smallest(load, family, factor=factor)
    for found, lasts in ((values.once[0], False), (values.long[0], True)):
        if np.isnan(found):
            continue
        for size, good in ((found * (1 + 1e-9), True), (found * 0.95, False)):
            judged = fits(load, [family.actuator(size)])
            answer = judged.lasts(factor) if lasts else judged.carries(factor)
            assert bool(answer[0, 0]) == good


def test_what_is_told_is_rounded_up_so_that_it_carries():
    assert up(1.75031) == "1.751"
    assert up(1.75) == "1.75"
    assert up(0.0) == "0"
    assert up(np.nan) == "none"
    assert all(float(up(x)) >= x for x in np.geomspace(1e-7, 1e4, 997))


def test_kinds_that_can_t_be_are_refused():
    for words in ({"power": 5.0, "bound": "box"}, {"rating": 1.5}, {"exponent": -1.0}):
        with pytest.raises(BadInput):
            Family.of(1, 10.0, **words)
    with pytest.raises(UnknownName):
        Family.of(1, 10.0, bound="curve")
    with pytest.raises(BadInput, match="speed"):
        Family.of(1, 0.0)
    with pytest.raises(BadInput, match="rotor"):
        Family.of(1, 1.0, -1.0)
    with pytest.raises(BadInput, match="other joints"):
        smallest(loads(0.1, 0.1), Family.of(2, 10.0))
