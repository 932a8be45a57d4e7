"""A request's limits on quantities, by hand."""

from dataclasses import fields

import numpy as np
import pytest

from scout_pin.specification import JOINT_NAMES
from scout_pin.study.plan.limits import KINDS, UNITS, Limits, worst, worsts
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.samples import Quantities
from scout_pin.study.plan.sampling.sloped import Sloped

STALL, FREE = 0.432, 4.55
POSTURE = np.array(
    [[-np.inf, -np.inf, 0.2, -0.1, -0.2, -0.3], [np.inf, np.inf, 0.23, 0.1, 0.2, 0.3]]
)


def quantities(**values):
    """Two samples at which nothing is near its limit, but for what is given at the second."""
    usual = {
        "edge": np.full((2, 4), 0.03),
        "force": np.ones((2, 1)),
        "contact": np.full((2, 8), -0.5),
        "torque": np.zeros((2, 12)),
        "rate": np.zeros((2, 12)),
        "angle": np.zeros((2, 12)),
        "knee": np.zeros((2, 2)),
    }
    for name, (column, value) in values.items():
        usual[name][1, column] = value
    slope = {
        name: np.arange(value.size * 18.0).reshape(*value.shape, 18)
        for name, value in usual.items()
    }
    return Quantities(*(Sloped(usual[one.name], slope[one.name]) for one in fields(Quantities)))


REQUEST = PlanRequest(
    margin=0.01, torque_reserve=0.2, speed_reserve=0.3, line_reserve=0.05, knee=0.2
)

CASES = [
    ("margin", {"edge": (2, 0.004)}, "", 0.6, 0.004, 0.01),
    ("torque", {"torque": (5, -0.4)}, JOINT_NAMES[5], 0.4 / STALL - 0.8, 0.4, 0.8 * STALL),
    ("speed", {"rate": (6, 4.0)}, JOINT_NAMES[6], 4.0 / FREE - 0.7, 4.0, 0.7 * FREE),
    (
        "line",
        {"torque": (1, 0.3), "rate": (1, -3.0)},
        JOINT_NAMES[1],
        0.3 / STALL + 3.0 / FREE - 0.95,
        0.3 / STALL + 3.0 / FREE,
        0.95,
    ),
    ("knee", {"knee": (1, -1.02)}, "right", (1.02 - np.cos(0.2)) / 0.1, 1.02, np.cos(0.2)),
    ("lower", {"angle": (3, -1.6)}, JOINT_NAMES[3], (1.6 - np.radians(85.5)) / 0.2, -1.6, None),
    ("upper", {"angle": (4, 1.55)}, JOINT_NAMES[4], (1.55 - np.radians(85.5)) / 0.2, 1.55, None),
    ("contact", {"contact": (0, 0.02)}, "", 0.3, 0.02, -0.01),
    ("force", {"force": (0, -0.2)}, "", 0.3, -0.2, 0.1),
]


@pytest.mark.parametrize(("kind", "given", "subject", "excess", "value", "limit"), CASES)
def test_each_limit_is_passed_by_as_much_as_one_works_out(
    scout, kind, given, subject, excess, value, limit
):
    limits = Limits.of(scout, REQUEST)
    found = limits.excess(scout, quantities(**given))
    assert found[kind].value.max() == pytest.approx(excess)
    first, sample, _, size = worst(found)
    assert (first, sample) == (kind, 1)
    assert size == pytest.approx(excess)
    said = worsts(scout, limits, found, np.array([0.0, 0.7]), POSTURE)[0]
    assert (said.kind, said.subject, said.t) == (kind, subject, 0.7)
    assert said.value == pytest.approx(value)
    if limit is not None:
        assert said.limit == pytest.approx(limit)
    else:
        assert abs(said.limit) == pytest.approx(np.radians(85.5))


@pytest.mark.parametrize(("kind", "given"), [(case[0], case[1]) for case in CASES])
def test_slopes_go_with_what_is_passed(scout, kind, given):
    limits = Limits.of(scout, REQUEST)
    here = quantities(**given)
    way = np.random.default_rng(1).normal(size=18)
    step = 1e-7

    def moved(sign):
        return Quantities(
            *(
                Sloped(one.value + sign * step * one.slope @ way, None)
                for one in (getattr(here, name.name) for name in fields(Quantities))
            )
        )

    change = (
        limits.excess(scout, moved(1))[kind].value - limits.excess(scout, moved(-1))[kind].value
    )
    found = limits.excess(scout, here)[kind]
    entry = np.unravel_index(int(np.argmax(found.value)), found.value.shape)
    assert found.slope[entry] @ way == pytest.approx(change[entry] / (2 * step), rel=1e-5)


def test_the_servo_line_can_be_left_out(scout):
    limits = Limits.of(scout, PlanRequest(servo_line=False))
    assert "line" not in limits.excess(scout, quantities())


def test_posture_is_told_in_its_own_units(scout):
    over = np.full((2, 12), -1.0)
    over[0, 2], over[1, 10] = 0.5, 0.7  # the torso too low, and rolled too far
    limits = Limits.of(scout, REQUEST)
    said = worsts(scout, limits, {"posture": Sloped(over, None)}, np.array([0.1, 0.2]), POSTURE)
    assert (said[0].subject, said[0].t) == ("roll", 0.2)
    assert said[0].value == pytest.approx(0.2 + 0.07)
    over[1, 10] = -1.0
    low = worsts(scout, limits, {"posture": Sloped(over, None)}, np.array([0.1, 0.2]), POSTURE)[0]
    assert (low.subject, low.limit) == ("height", 0.2)
    assert low.value == pytest.approx(0.2 - 0.005)


def test_every_kind_has_words_and_units_where_it_has_one():
    assert {case[0] for case in CASES} | {"posture"} == set(KINDS)
    assert set(UNITS) < set(KINDS)
