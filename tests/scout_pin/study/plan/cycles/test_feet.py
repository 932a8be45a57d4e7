"""The feet of a cycle."""

import numpy as np
import pytest

from scout_pin.specification import SIDES
from scout_pin.study.plan.cycles.feet import Moments, Pace, Steps, least_spacing, phases
from scout_pin.study.plan.request import GAP, PlanRequest
from thesis_pin.errors import BadInput

PACE = Pace(step_length=0.03, step_time=0.8, share=0.25)
STEPS = Steps((-0.034, 0.034), 0.02)
MOMENTS = Moments.even(2, 9, 33)


def test_feet_are_their_curves_with_rates_and_accelerations():
    curves = STEPS.curves(PACE)
    t = MOMENTS.times(PACE.share) * PACE.step_time
    # Just beside an instant at which curves change.
    t += np.where(MOMENTS.part == 0.0, 1e-12, np.where(MOMENTS.part == 1.0, -1e-12, 0.0))
    for side, foot in zip(SIDES, STEPS.feet(MOMENTS, PACE), strict=True):
        for order, values in enumerate((foot.position, foot.velocity, foot.acceleration)):
            expected = np.stack([one(t, order) for one in curves[f"{side}_foot"][:3]], axis=1)
            np.testing.assert_allclose(values, expected, atol=1e-8)
        assert not foot.omega.any()


def test_a_foot_stands_while_the_other_goes_two_lengths_and_is_as_high_as_asked():
    left, right = STEPS.feet(MOMENTS, PACE)
    for foot, stands, other in ((left, 0, right), (right, 1, left)):
        mine = MOMENTS.step == stands
        assert np.ptp(foot.position[mine], axis=0).max() == 0.0
        assert not foot.velocity[mine].any()
        way = np.ptp(other.position[mine], axis=0)
        np.testing.assert_allclose(way, [0.0, 2 * PACE.step_length, STEPS.lift], atol=1e-12)
    assert right.position[0, 1] == -PACE.step_length
    assert right.position[-1, 1] == PACE.step_length
    assert left.position[-1, 1] == pytest.approx(2 * PACE.step_length)


def test_feet_leave_and_meet_the_floor_at_rest():
    ends = MOMENTS.swings & ((MOMENTS.part == 0.0) | (MOMENTS.part == 1.0))
    assert ends.sum() == 4
    for foot in STEPS.feet(MOMENTS, PACE):
        assert np.abs(foot.velocity[ends]).max() == 0.0
        assert np.abs(foot.acceleration[ends]).max() == 0.0


def test_phases_say_who_bears_load_at_each_moment():
    t = MOMENTS.times(PACE.share) * PACE.step_time
    names = {(True, True): "double", (True, False): "left", (False, True): "right"}
    for when, stands in zip(t, MOMENTS.support, strict=True):
        assert any(
            phase.start - 1e-12 <= when <= phase.end + 1e-12
            and phase.support == names[bool(stands[0]), bool(stands[1])]
            for phase in phases(PACE)
        )


def test_feet_leave_a_gap_between_the_soles_unless_told_how_far_apart(scout, lopsided):
    assert least_spacing(scout) == pytest.approx(2 * 28.18e-3)
    for robot in (scout, lopsided):
        left, right = Steps.of(robot, PlanRequest()).across
        soles = [np.array(robot.specification.leg(side).sole)[:, 0] for side in SIDES]
        assert right + soles[1].min() - left - soles[0].max() == pytest.approx(GAP)
        assert Steps.of(robot, PlanRequest(foot_spacing=0.2)).across == (-0.1, 0.1)


def test_soles_that_would_touch_are_refused(scout):
    with pytest.raises(BadInput, match=r"touch.*56\.36 mm"):
        Steps.of(scout, PlanRequest(foot_spacing=0.0563))
    assert Steps.of(scout, PlanRequest(foot_spacing=0.0566)).across[1] == 0.0283
