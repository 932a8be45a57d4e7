"""How short a motion may be with which motor: the smallest in time, tables, documents, figures."""

import csv
import io
import json

import numpy as np
import pytest

from thesis_pin.report.writers import csv_bytes, json_bytes
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.loads import Loads
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.figures import curve_files, curve_plot
from thesis_pin.sizing.smallest.result import smallest
from thesis_pin.sizing.smallest.timed import sizes, timed

MOTORS = (
    Actuator("big", 4.0, 5.0, mass=0.4),
    Actuator("mid", 2.0, 9.0, mass=0.2),
    Actuator('small, "s"', 1.0, 9.0, mass=0.1),
)


def times(motor):
    """Twice the torque takes half as long; the smallest can't."""
    able = motor.stall_torque >= 2
    return {"fastest": 8 / motor.stall_torque if able else None, "scaled": None}


@pytest.fixture
def found():
    return timed(MOTORS, times, within=4.0)


def test_the_smallest_that_is_in_time_is_named(found):
    assert found.able == [True, True, False]
    assert found.smallest.name == "mid"
    assert found.verdict() == [
        "mid is the smallest of 3 (by mass) with which it can be done in 4 s: it takes at least "
        "4 s."
    ]
    late = timed(MOTORS, times, within=1.0)
    assert not late.yes
    assert late.verdict()[1] == "big is the fastest: 2 s."
    assert timed(MOTORS, lambda _: {"fastest": None}).verdict() == [
        "With no motor of 3 it can be done."
    ]


def test_the_table_has_the_smallest_first_and_says_never(found):
    rows = found.table().rows
    assert [row[0] for row in rows] == ['small, "s"', "mid", "big"]
    assert list(rows[0][3:]) == ["never", "never"]


def test_the_document_and_the_csv_have_every_motor(found):
    answer = Answer("robot", "motion", ("j",), curve=found, catalogue=Catalogue(MOTORS))
    document = json.loads(json_bytes(answer.document("pollard-pin")))
    assert document["schema"] == "pollard-pin/smallest-motors"
    assert [one["times"]["fastest"] for one in document["curve"]["motors"]] == [2.0, 4.0, None]
    assert document["yes"] is True
    rows = list(csv.DictReader(io.StringIO(csv_bytes(found.columns()).decode())))
    assert [row["motor"] for row in rows] == ["big", "mid", 'small, "s"']


def test_the_figure_goes_over_the_stall_torque(found):
    plot = curve_plot(found, "motion")
    np.testing.assert_array_equal(plot.curves[0].x, [1.0, 2.0, 4.0])
    np.testing.assert_array_equal(plot.curves[0].y, [np.nan, 4.0, 2.0])
    assert plot.curves[-1].name == "smallest: mid"
    answer = Answer("robot", "motion", ("j",), curve=found)
    assert set(curve_files(answer)) == {"curve.png", "curve.svg"}


def test_sizes_of_a_curve_begin_with_the_least_and_end_with_its_multiple():
    some = np.array(list(sizes(2.0, 7, 3.0)))
    assert len(some) == 7
    np.testing.assert_allclose(some[[0, -1]], [2.0, 6.0])
    assert (np.diff(some) > 0).all()


def test_an_answer_says_each_note_once_and_has_a_row_for_each_joint_and_timing():
    time = np.linspace(0.0, 1.0, 3)
    values = np.full((3, 2), 0.5)
    load = Loads("robot", "motion", ("a", "b"), time, values, values, values, ("Half.",))
    cases = tuple(
        smallest(load, Family.of(2, 10.0), timing=word) for word in ("As it is", "Left free")
    )
    answer = Answer("robot", "motion", load.joints, cases)
    notes = answer.all_notes()
    assert notes.count("Half.") == 1
    assert len(notes) == len(set(notes))
    rows = list(csv.DictReader(io.StringIO(csv_bytes(answer.columns()).decode())))
    assert [(row["timing"], row["joint"]) for row in rows] == [
        (word, joint) for word in ("As it is", "Left free") for joint in "ab"
    ]
    assert float(rows[0]["once_Nm"]) == pytest.approx(0.5 / 0.95)
