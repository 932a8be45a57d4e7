"""Which servo carries which joint, by hand."""

import csv
import io
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.errors import BadInput
from thesis_pin.report.tables import Table
from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.document import size
from thesis_pin.sizing.judging import by_size, fits
from thesis_pin.sizing.loads import Loads, resolution_notes
from thesis_pin.sizing.tables import MOST, summary
from thesis_pin.smoothing.intervals import Interval

TIME = np.linspace(0, 2, 2001)


def loads(torque, speed, acceleration=0.0, armature=0.0, joints=("knee",)):
    shape = (len(TIME), len(joints))
    values = (np.broadcast_to(np.asarray(x, dtype=float), shape) for x in (torque, speed))
    more = np.broadcast_to(np.asarray(acceleration, dtype=float), shape)
    own = np.full(len(joints), armature)
    return Loads.of("robot", "motion", joints, TIME, *values, more, own)


def one(**values):
    return Actuator(**({"name": "A", "stall_torque": 2.0, "no_load_speed": 10.0} | values))


def test_the_factor_is_what_the_line_leaves_at_the_speed_over_what_is_needed():
    # At 4 rad/s a line of 2 N·m and 10 rad/s leaves 1.2 N·m; 0.5 N·m are needed.
    found = fits(loads(-0.5, 4.0), [one()])
    assert found.factor[0, 0] == pytest.approx(2.4)
    assert found.use[0, 0] == pytest.approx(0.5 / 2 + 4 / 10)


def test_the_worst_instant_is_the_one_of_torque_and_speed_together():
    phase = 2 * np.pi * TIME / 2
    torque, speed = np.cos(phase)[:, None], 6 * np.sin(phase)[:, None]
    found = fits(loads(torque, speed), [one()])
    ratio = (1 - np.abs(speed) / 10) * 2 / np.abs(torque)
    assert found.factor[0, 0] == pytest.approx(ratio.min())
    assert found.time[0, 0] == TIME[ratio[:, 0].argmin()]


def test_rms_is_over_time_and_held_against_the_rating():
    phase = 2 * np.pi * TIME / 2
    found = fits(loads(0.6 * np.sin(phase)[:, None], 0.0), [one(), one(rated_torque=0.3)])
    assert found.rms[0, 0] == pytest.approx(0.6 / np.sqrt(2), rel=1e-6)
    np.testing.assert_allclose(found.heat[:, 0], found.rms[:, 0] / [1.0, 0.3])
    assert found.lasts(1.0)[:, 0].tolist() == [True, False]
    assert found.carries(1.0).all()


def test_uneven_samples_count_by_their_time():
    time = np.array([0.0, 0.1, 2.0])
    some = np.array([[3.0], [1.0], [1.0]])
    load = Loads("r", "m", ("j",), time, some, some, some)
    by_hand = (0.1 * (9 + 1) / 2 + 1.9 * 1.0) / 2.0
    assert load.rms(some)[0] == pytest.approx(np.sqrt(by_hand))


def test_each_servo_accelerates_its_own_rotor_and_not_the_specification_s():
    # 0.3 N·m with a rotor of 0.01 kg·m² at 5 rad/s²: 0.25 without it; with 0.04 it is 0.45.
    load = loads(0.3, 0.0, 5.0, armature=0.01)
    np.testing.assert_allclose(load.torque, 0.25)
    found = fits(load, [one(), one(rotor_inertia=1e-6, gear_ratio=200.0)])
    np.testing.assert_allclose(found.peak[:, 0], [0.25, 0.25 + 1e-6 * 200**2 * 5])
    np.testing.assert_allclose(found.factor[:, 0], [8.0, 2 / 0.45])


def test_a_speed_above_the_free_one_can_t_be_had_even_without_load():
    found = fits(loads([[0.0, 0.0]], [[11.0, 9.0]], joints=("a", "b")), [one()])
    assert found.factor[0].tolist() == [0.0, np.inf]
    assert found.carries(1.0)[0].tolist() == [False, True]


@given(
    torque=st.lists(st.floats(-5, 5), min_size=3, max_size=3),
    speed=st.lists(st.floats(-15, 15), min_size=3, max_size=3),
)
def test_a_factor_of_one_is_the_line_of_the_reports(torque, speed):
    time = np.array([0.0, 1.0, 2.0])
    columns = (np.array(x)[:, None] for x in (torque, speed, [0.0] * 3))
    found = fits(Loads("r", "m", ("j",), time, *columns), [one()])
    if abs(found.use[0, 0] - 1) > 1e-9:
        assert (found.factor[0, 0] >= 1) == (found.use[0, 0] <= 1)


def test_the_smallest_is_by_mass_else_by_size_else_by_torque():
    heavy, light = one(mass=0.2, size=(1, 1, 1)), one(mass=0.1, size=(2, 1, 1), stall_torque=3.0)
    assert by_size([heavy, light]) == ([1, 0], "mass")
    bare = one(size=(3, 1, 1), stall_torque=1.0)
    assert by_size([heavy, light, bare]) == ([0, 1, 2], "volume")
    assert by_size([heavy, light, one(stall_torque=1.0)]) == ([2, 0, 1], "stall torque")


@pytest.fixture
def sizing():
    servos = (
        one(name="big, strong", stall_torque=4.0, mass=0.2, extra={"price": "9"}),
        one(name="fits", mass=0.05, rated_torque=0.9),
        one(name="hot", stall_torque=1.2, mass=0.03),
        one(name="weak", stall_torque=0.5, mass=0.01),
    )
    load = loads([[0.8, 0.2]], [[1.0, 1.0]], joints=("knee", "hip"))
    return size(load, Catalogue(servos, ("a note",)))


def test_the_smallest_for_all_and_for_each_are_named(sizing):
    document = json.loads(json_bytes(sizing.document("scout-pin")))
    assert document["schema"] == "scout-pin/size"
    assert document["smallest"] == {
        "by": "mass",
        "every_joint": "fits",
        "each_joint": ["fits", "weak"],
    }
    assert document["fits"]["carries"] == [[True, True]] * 3 + [[False, True]]
    assert document["fits"]["lasts"] == [[True, True], [True, True], [False, True], [False, True]]
    assert document["yes"] is True
    assert sizing.verdict()[0] == (
        "fits is the smallest of 4 (by mass) that carries every joint for long: safety factor "
        "2.25 at knee, RMS 89% of its rating at knee."
    )


def test_a_servo_that_would_burn_is_said_to_carry_it_once(sizing):
    load, servos = sizing.loads, sizing.actuators[2:]
    said = size(load, Catalogue(servos)).verdict()
    assert said == [
        "No servo of 2 carries every joint for long.",
        "hot carries the motion once: its RMS torque at knee is 133% of its rating.",
        "No servo of the list carries knee for long.",
    ]


def test_a_least_factor_asks_for_more(sizing):
    strict = size(sizing.loads, sizing.catalogue, 3.0)
    assert strict.document("x")["smallest"]["every_joint"] == "big, strong"


def test_numbers_that_can_t_be_right_are_said_beside_the_choice(sizing):
    wrong = one(name="typed", stall_torque=44.0, no_load_speed=50.0, mass=0.005)
    said = size(sizing.loads, Catalogue((wrong, *sizing.actuators)))
    assert said.verdict()[0].startswith("typed is the smallest")
    assert said.verdict()[1] == "But its numbers can't be right: see the warning."
    assert "550 W from 5 g" in said.warnings()[0]


def test_what_is_counted_and_assumed_is_told(sizing):
    notes = " ".join(sizing.notes())
    assert "Counted: the inertia of each servo's own rotor" in notes
    assert "Not counted: masses" in notes
    assert "The rating of big, strong, hot, weak is taken as 0.5 of stall" in notes
    assert "a note." in notes


def test_the_csv_has_a_row_for_each_servo_at_each_joint(sizing):
    rows = list(csv.DictReader(io.StringIO(csv_bytes(sizing.columns()).decode())))
    assert len(rows) == 8
    assert (rows[0]["servo"], rows[0]["joint"], rows[0]["price"]) == ("big, strong", "knee", "9")
    assert float(rows[2]["factor"]) == pytest.approx(2.25)
    assert [row["lasts"] for row in rows[4:]] == ["false", "true"] * 2


def test_tables_show_the_smallest_first_and_say_how_many_are_left_out():
    servos = tuple(one(name=f"s{k}", stall_torque=5.0 - k / 10) for k in range(MOST + 3))
    parts = list(summary(size(loads(0.1, 0.1), Catalogue(servos))))
    joints, table = (part for part in parts if isinstance(part, Table))
    assert joints.rows[0][4] == f"s{MOST + 2}"
    assert [row[0] for row in table.rows][:2] == [f"s{MOST + 2}", f"s{MOST + 1}"]
    assert "3 more servos are in --json and --out." in parts


def test_an_empty_catalogue_and_a_factor_of_nothing_are_refused(sizing):
    with pytest.raises(BadInput, match="empty"):
        size(sizing.loads, Catalogue(()))
    with pytest.raises(BadInput, match="factor"):
        size(sizing.loads, sizing.catalogue, 0.0)


def test_what_samples_leave_open_of_peak_torques_is_said_where_it_is_most():
    peaks = [Interval(1.0, 0.9, 1.05), Interval(0.01, 0.0, 0.05), Interval(0.5, 0.4, 0.5)]
    (said,) = resolution_notes(("hip", "knee", "toe"), peaks)
    assert "larger than said by up to 0.05 N·m (at hip)" in said
    assert resolution_notes(("toe",), peaks[2:]) == []
