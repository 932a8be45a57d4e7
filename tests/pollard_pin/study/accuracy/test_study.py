"""Errors along the thesis's curve and over a workspace, against figures worked out elsewhere."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import pollard_pin
from pollard_pin.study.accuracy.draws import drawn
from pollard_pin.study.accuracy.exact import reached
from pollard_pin.study.accuracy.parameters import COLUMNS
from pollard_pin.study.accuracy.stacking import stacked
from pollard_pin.study.accuracy.study import path_accuracy, workspace_accuracy
from pollard_pin.study.accuracy.tolerances import Rule, default_tolerances, tolerances
from pollard_pin.study.accuracy.within import within
from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.tolerances import TOLERANCES


@pytest.fixture(scope="module")
def stack(pollard, curve, lengths):
    return stacked(pollard, curve, lengths, np.array([500.0] * 3 + [100.0] * 3))


@pytest.fixture(scope="module")
def study(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    return path_accuracy(pollard, path, draws=50, within=5e-3, samples=101)


def test_seventeen_lengths_are_as_worked_out_by_another_program(stack):
    """2.08 mm is the length of the sums along the axes, 0.61 mm the root of the sum of squares."""
    assert np.linalg.norm(stack.components, axis=1).max() == pytest.approx(2.08e-3, abs=5e-6)
    assert stack.root.max() == pytest.approx(0.614e-3, abs=1e-6)
    assert stack.slopes.shape == (401, 17)
    assert stack.give.min() == pytest.approx(0.47e-3, abs=5e-6)
    assert stack.give.max() == pytest.approx(1.74e-3, abs=5e-6)


def test_the_worst_corner_is_reached_and_none_of_many_lies_beyond(pollard, curve, lengths, stack):
    rng = np.random.default_rng(1)
    signs = rng.choice([-1.0, 1.0], (17, 3000)) * lengths.sizes[:, None]
    k = int(stack.worst.argmax())
    tips = reached(pollard.specification, curve[k : k + 1], lengths.whole(signs)).tip
    away = np.linalg.norm(tips - pollard.posture(curve[k]).tip, axis=-1).max()
    assert 0.8 * stack.farthest[k] < away <= stack.farthest[k] * 1.001


def test_linear_errors_of_a_tenth_of_a_millimetre_are_exact_to_two_thousandths(
    pollard, curve, stack
):
    posture, largest = pollard.posture(curve).tip, stack.slopes.max(axis=0) * 1e-4
    names = [n for n in COLUMNS if n.startswith("chain_") and "beta" not in n]
    from pollard_pin.study.accuracy.sensitivity import sensitivity

    slopes = sensitivity(pollard, curve)[:, :3]
    for k, name in enumerate(names):
        for size in (1e-4, -1e-4):
            errors = np.zeros((len(COLUMNS), 1))
            errors[COLUMNS.index(name)] = size
            away = reached(pollard.specification, curve, errors).tip - posture
            gap = away - size * slopes[:, :, COLUMNS.index(name)]
            assert np.linalg.norm(gap, axis=1).max() < 2e-3 * largest[k], name
    assert stack.bent.max() < 0.01


def test_drawn_robots_spread_as_the_squares_say(pollard, curve, lengths):
    some = curve[::80]
    for allowed in (lengths, default_tolerances("normal")):
        found = drawn(pollard, some, allowed, 2000, seed=4)
        expected = stacked(pollard, some, allowed).deviation
        np.testing.assert_allclose(found.deviation, expected, rtol=0.04)
        assert found.assembled.all()
        assert (found.distance.max(axis=0) <= stacked(pollard, some, allowed).worst * 1.3).all()


def test_robots_that_cannot_be_assembled_are_counted(pollard):
    pose = np.array([[0.31, 0.0, -0.1, 0.0, 0.0, 0.0], [0.45, 0.0, 0.0, 0.0, 0.0, 0.0]])
    angles = pollard.inverse_kinematics(pose).angles
    found = drawn(pollard, angles, default_tolerances().times(10.0), 100)
    lost = np.isnan(found.distance).mean(axis=0)
    assert 0.0 < lost[0] < 1.0
    assert lost[1] == 0.0
    assert np.isinf(found.farthest[~found.assembled]).all()


def test_equal_tolerances_put_the_exact_worst_case_at_the_limit(pollard, curve):
    allowed = tolerances([Rule("lengths", 0.1, "mm"), Rule("motors", 0.02, "deg")])
    found = within(pollard, curve, allowed, 1e-3)
    assert stacked(pollard, curve, allowed.times(found.factor)).farthest.max() == pytest.approx(
        1e-3, rel=1e-4
    )
    by_name = {one.of: one for one in found.equal}
    assert set(by_name) == {"lengths", "motors"}
    same = tolerances([Rule("lengths", by_name["lengths"].worst, "mm")])
    assert stacked(pollard, curve, same).farthest.max() == pytest.approx(1e-3, rel=1e-4)
    assert by_name["lengths"].root == pytest.approx(0.1 / 0.6142911, rel=1e-5)


def test_a_tolerance_that_keeps_a_wide_limit_is_confirmed_by_exact_kinematics(pollard, curve):
    """60 mm are far from linear: the linear factor leads to robots beyond the limit."""
    allowed = tolerances([Rule("x_87", 0.1, "mm")])
    found = within(pollard, curve[::20], allowed, 0.06)
    linear = 0.06 / stacked(pollard, curve[::20], allowed).worst.max()
    assert abs(found.factor / linear - 1.0) > 0.02
    exact = stacked(pollard, curve[::20], allowed.times(found.factor)).farthest.max()
    assert exact == pytest.approx(0.06, rel=2e-4)


def test_a_study_says_what_moves_the_tip_most(study):
    first = study.contributions[0]
    assert first.parameter.name == "motor.chain1_shoulder"
    assert sum(one.share for one in study.contributions) == pytest.approx(1.0)
    assert first.reach == pytest.approx(first.slope * np.radians(0.1))
    said = " ".join(study.verdict())
    assert "FAIL: the spray tip may be more than 5 mm off its place" in said
    assert "Without any effect on the tool: chain_1.beta_54, chain_2.beta_54." in said
    assert not study.within_limits
    assert not study.doubts()


def test_shares_are_those_of_the_variances_as_each_is_drawn(pollard):
    """Of one motor: anywhere within 0.1° has a third of the variance of one end or the other."""
    rules = [Rule(f"{one}.chain1_shoulder", 0.1, "deg") for one in ("motor", "backlash")]
    path = pollard_pin.appendix_b(pollard.specification)
    found = path_accuracy(pollard, path, tolerances(rules), draws=0, samples=11)
    shares = {one.parameter.kind: one.share for one in found.contributions}
    assert shares == pytest.approx({"motors": 0.25, "backlash": 0.75})


def test_a_wider_limit_is_kept(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    found = path_accuracy(pollard, path, draws=0, within=7e-3, samples=31)
    assert found.within_limits
    assert found.verdict()[0] == "PASS: the spray tip stays within 7 mm of its place at worst."


def test_a_limit_that_is_kept_on_half_of_the_path_is_not_kept(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    every = path_accuracy(pollard, path, draws=0, samples=31).stack.farthest
    middle = float(np.sort(every)[14:16].mean())
    found = path_accuracy(pollard, path, draws=0, within=middle, samples=31)
    assert not found.within_limits
    assert f"on {16 / 31:.1%} of the path" in found.verdict()[0]


def test_the_same_seed_draws_the_same_robots(pollard, study):
    path = pollard_pin.appendix_b(pollard.specification)
    again = path_accuracy(pollard, path, draws=60, samples=101)
    np.testing.assert_array_equal(again.draws.distance[:50], study.draws.distance)


def test_near_singularities_linear_numbers_are_doubted(pollard):
    x, z = np.linspace(0.15, 0.7, 23), np.linspace(-0.45, 0.3, 23)
    found = workspace_accuracy(pollard, x, 0.0, z, within=5e-3)
    stack = found.stack
    assert found.bent.any()
    assert np.isinf(stack.exact).any()
    assert (stack.bent[np.isinf(stack.exact)] > TOLERANCES.linear).all()
    condition = found.space.condition[found.space.reachable & np.isfinite(found.space.condition)]
    assert np.median(condition[found.bent]) > 2 * np.median(condition[~found.bent])
    (doubt,) = found.doubts()
    assert f"at {found.bent.sum()} of {len(found.pose)} poses" in doubt
    assert "can't be assembled" in doubt
    assert "more than 5%" in doubt


def test_a_workspace_is_at_each_position_as_on_a_path(pollard):
    found = workspace_accuracy(pollard, [0.4, 0.5], 0.05, [0.0, 0.1], [0.1, 0.0, 0.0])
    assert len(found.pose) == 4
    alone = stacked(pollard, found.angles[2:3], default_tolerances())
    for field in dataclasses.fields(alone):
        if field.name not in ("kinds", "give"):
            expected = getattr(found.stack, field.name)[2]
            np.testing.assert_allclose(getattr(alone, field.name)[0], expected, rtol=1e-9)
    assert found.contributions[0].slope == pytest.approx(
        np.median(found.stack.slopes[:, found.allowed.each.index(found.contributions[0].tolerance)])
    )


def test_what_cannot_be_studied_is_refused(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    with pytest.raises(BadInput, match="samples"):
        path_accuracy(pollard, path, samples=300_000)
    with pytest.raises(BadInput, match="draws at 401 poses"):
        path_accuracy(pollard, path, draws=100_000)
    with pytest.raises(BadInput, match="stiffness"):
        path_accuracy(pollard, path, stiffness=[1.0, 2.0])
    with pytest.raises(BadInput, match="stiffness is -1"):
        path_accuracy(pollard, path, stiffness=-1.0)
    with pytest.raises(BadInput, match="within"):
        path_accuracy(pollard, path, within=0.0)
    with pytest.raises(Unreachable, match="no position"):
        workspace_accuracy(pollard, 3.0, 0.0, [0.0, 0.1])


def test_a_path_across_a_singularity_is_refused(pollard):
    from pollard_pin.motion.curves import line

    start, end = (np.array([x, 0.0, -0.1, 0.0, 0.0, 0.0]) for x in (0.45, 0.25))
    with pytest.raises(SingularPose):
        path_accuracy(pollard, line(start, end, 2.0))


def test_the_sentence_says_both_worst_cases_where_the_tables_have_the_linear_one(study):
    """A reader finds the table's number in the sentence, and why it isn't the first one."""
    from pollard_pin.study.accuracy.told.tables import kinds_table

    linear = kinds_table(study).rows[-1][2]
    said = next(one for one in study.verdict() if one.startswith("At worst"))
    first = f"{study.stack.farthest.max() * 1e3:.3g} mm off"
    assert first in said
    assert f"{float(linear):.3g} mm as far as what is linear goes" in said
    assert f"{float(linear):.3g} mm off" != first


def test_where_both_worst_cases_are_one_number_it_is_said_once(pollard):
    path = pollard_pin.appendix_b(pollard.specification)
    little = tolerances([Rule("lengths", 0.001, "mm")])
    said = path_accuracy(pollard, path, little, draws=0, samples=21).verdict()
    assert "what is linear goes" not in " ".join(said)


def test_notes_say_which_kinds_are_drawn_how_and_name_no_exact_ones_where_none_are(pollard):
    from pollard_pin.study.accuracy.told.tables import notes

    path = pollard_pin.appendix_b(pollard.specification)
    allowed = pollard_pin.read_tolerances(
        Path(__file__).parents[4] / "examples" / "tolerances.toml"
    )
    said = notes(path_accuracy(pollard, path, allowed, draws=1, samples=11))
    (drawn_how,) = (one for one in said if one.startswith("drawn robots"))
    assert "as likely (encoders)" in drawn_how
    assert "at one end or the other (play)" in drawn_how
    assert "standard deviations (lengths, " in drawn_how
    (counted,) = (one for one in said if "have a tolerance" in one)
    assert counted.startswith("56 of 56")
    assert "exact" not in counted
