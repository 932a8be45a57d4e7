"""Motions whose time is in another unit, and those that are slow or at rest."""

import pytest

from thesis_pin.report.pace import doubts


@pytest.mark.parametrize(("factor", "word"), [(1e3, "milliseconds"), (1e6, "microseconds")])
@pytest.mark.parametrize("acceleration", [0.02, 0.3, 5.0, 90.0])
def test_a_robot_s_motion_in_another_unit_is_doubted_and_the_unit_named(factor, word, acceleration):
    (said,) = doubts(6 * factor, 0.05, acceleration / factor**2)
    assert f"in {word}?" in said
    assert said.startswith(f"the motion lasts {6 * factor:g} s")


def test_a_motion_that_is_only_slow_is_said_to_be():
    (said,) = doubts(3600.0, 0.05, 2e-9)
    assert "inertia plays no part" in said
    assert "?" not in said


@pytest.mark.parametrize(
    ("travel", "acceleration"), [(0.0, 0.0), (0.05, 0.3), (0.05, 2e-4), (1e-6, 5e-5), (0.1, 0.0)]
)
def test_motions_at_a_robot_s_pace_and_poses_that_are_held_are_not_doubted(travel, acceleration):
    assert doubts(6.0, travel, acceleration) == []
