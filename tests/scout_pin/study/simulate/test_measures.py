"""Numbers of a try, from motions made by hand."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.study.simulate.measures import measures
from scout_pin.study.simulate.planned import Planned
from scout_pin.study.simulate.verdict import criteria, sentences
from scout_pin.study.simulate.walking import Walked
from thesis_pin.simulation.tallies import kept
from thesis_pin.tolerances import GRAVITY

COUNT = 101


@pytest.fixture
def case(scout):
    """Two seconds: the right foot goes 60 mm ahead from 0.5 to 1.5 s, the torso 30 mm."""
    time = np.linspace(0, 2, COUNT)
    share = np.clip(time - 0.5, 0, 1)
    q = np.zeros((COUNT, 19))
    q[:, 6], q[:, 2], q[:, 1] = 1.0, 0.22, 0.03 * share
    feet = np.zeros((2, COUNT, 3))
    feet[0, :, 0], feet[1, :, 0] = -0.04, 0.04
    feet[1, :, 1] = 0.06 * share
    swings = (share > 0) & (share < 1)
    feet[1, swings, 2] = 0.01
    plan = Planned(
        commands=np.zeros((COUNT - 1, 12)),
        before=0,
        after=0,
        step=0.02,
        every=1,
        time=time,
        q=q,
        v=np.zeros((COUNT, 18)),
        feet=feet,
        low=feet[..., 2],
        torque=np.full((COUNT, 12), 0.1),
        line=np.full(12, 0.9),
        duration=2.0,
        stances=(((0.0, 2.0),), ((0.0, 0.5), (1.5, 2.0))),
    )
    soles = np.broadcast_to(np.eye(4), (2, COUNT, 4, 4)).copy()
    soles[..., :3, 3] = feet
    weight = scout.mass * GRAVITY
    load = np.stack([np.where(swings, weight, weight / 2), np.where(swings, 0.0, weight / 2)])
    walked = Walked(
        q.copy(),
        np.zeros((COUNT, 18)),
        np.zeros((COUNT, 12)),
        soles,
        load,
        np.zeros(COUNT, dtype=bool),
        np.full(12, 0.1),
        np.zeros(12),
    )
    return scout, plan, walked


def failing(found):
    return {one.name for one in criteria(found) if not one.met}


def test_a_try_that_is_the_plan_passes(case):
    found = measures(*case)
    assert kept(criteria(found))
    assert sentences(found) == []
    assert found.distance == pytest.approx(0.03)
    assert found.planned_distance == pytest.approx(0.03)
    assert [(one.side, one.start, one.end) for one in found.slips] == [
        ("left", 0.0, 2.0),
        ("right", 0.0, 0.5),
        ("right", 1.5, 2.0),
    ]


@pytest.mark.parametrize(
    ("share", "met"), [(0.94, False), (0.96, True), (1.04, True), (1.06, False)]
)
def test_distance_is_to_be_within_five_per_cent(case, share, met):
    robot, plan, walked = case
    walked.soles[1, :, 1, 3] *= share
    found = measures(robot, plan, walked)
    assert found.distance == pytest.approx(0.03 * share)
    assert ("distance" not in failing(found)) == met


@pytest.mark.parametrize(
    ("degrees", "met"), [(4.9, True), (-4.9, True), (5.1, False), (-5.1, False)]
)
def test_heading_is_to_be_within_five_degrees_and_left_is_told_from_right(case, degrees, met):
    robot, plan, walked = case
    turn = pin.Quaternion(pin.exp3(np.array([0, 0, np.radians(degrees)]))).coeffs()
    walked.q[-1, 3:7] = turn
    found = measures(robot, plan, walked)
    assert np.degrees(found.heading) == pytest.approx(degrees)
    assert ("heading" not in failing(found)) == met
    if not met:
        assert f"to the {'left' if degrees > 0 else 'right'} of" in sentences(found)[0]


@pytest.mark.parametrize(("slip", "met"), [(0.9e-3, True), (1.1e-3, False)])
def test_a_loaded_sole_that_moves_slips_and_an_unloaded_one_does_not(case, slip, met):
    robot, plan, walked = case
    walked.soles[0, 60:, 0, 3] += slip
    found = measures(robot, plan, walked)
    assert found.worst_slip.side == "left"
    assert found.worst_slip.distance == pytest.approx(slip)
    assert ("slip" not in failing(found)) == met
    walked.load[0, 60:] = 0.0
    assert measures(robot, plan, walked).worst_slip.distance < 1e-12


def test_a_sole_that_spins_slips_at_its_corners(case):
    robot, plan, walked = case
    walked.soles[0, 60:, :3, :3] = pin.exp3(np.array([0, 0, 0.02]))
    outline = np.array(robot.specification.leg("left").sole)
    found = measures(robot, plan, walked)
    farthest = np.linalg.norm(outline, axis=1).max() * 2 * np.sin(0.01)
    assert found.worst_slip.distance == pytest.approx(farthest)


@pytest.mark.parametrize(("degrees", "met"), [(9.9, True), (10.5, False)])
def test_tilt_is_from_the_plan_and_its_first_time_is_told(case, degrees, met):
    robot, plan, walked = case
    walked.q[70:, 3:7] = pin.Quaternion(pin.exp3(np.array([np.radians(degrees), 0, 0]))).coeffs()
    found = measures(robot, plan, walked)
    assert np.degrees(found.tilt) == pytest.approx(degrees)
    assert ("upright" not in failing(found)) == met
    if not met:
        assert found.tips_at == pytest.approx(1.4)
    plan.q[70:, 3:7] = walked.q[70:, 3:7]
    assert measures(robot, plan, walked).tilt < 1e-7


def test_servos_at_their_limit_and_soles_that_meet_fail_with_amount_and_time(case):
    robot, plan, walked = case
    full = np.zeros(12)
    full[9] = 0.0123
    meeting = walked.meeting.copy()
    meeting[30] = True
    found = measures(robot, plan, replace(walked, saturated=full, meeting=meeting))
    assert failing(found) == {"torque", "soles"}
    assert sentences(found) == [
        "The servo of right_knee_pitch gives all it has for 1.23% of the time; the plan, its rotor "
        "counted, takes 90% of its torque-speed line.",
        "The soles touch each other at t = 0.6 s.",
    ]


def test_a_foot_that_bears_load_in_mid_swing_stumbles(case):
    robot, plan, walked = case
    walked.load[1, 50] = 2.0
    found = measures(robot, plan, walked)
    assert sentences(found) == [
        "The right foot bears 2.00 N at t = 1 s, where the plan has it 10.0 mm above the floor."
    ]
    walked.load[1, 50] = 0.1  # a brush
    assert measures(robot, plan, walked).stumble is None


@pytest.mark.parametrize(("strays", "met"), [(1.9e-3, True), (2.1e-3, False)])
def test_what_is_to_stay_may_stray_by_two_millimetres(case, strays, met):
    robot, plan, walked = case
    plan.feet[1, :, 1] = 0.0
    walked.soles[1, :, 1, 3] = 0.0
    walked.soles[:, -1, 0, 3] += strays
    found = measures(robot, plan, walked)
    assert found.planned_distance == 0.0
    assert found.distance == pytest.approx(strays)
    assert ("distance" not in failing(found)) == met


def test_a_foot_that_lands_where_the_gait_ends_does_not_slip_by_its_step(case):
    """And one that begins in the air doesn't slip from where it was."""
    robot, plan, walked = case
    landing = replace(plan, stances=(plan.stances[0], ((0.0, 0.5),)), duration=1.5)
    assert measures(robot, landing, walked).worst_slip.distance < 1e-12
    leaving = replace(plan, stances=(plan.stances[0], ((1.5, 2.0),)))
    assert measures(robot, leaving, walked).worst_slip.distance < 1e-12


def test_what_comes_aside_to_the_right_counts_positive(case):
    robot, plan, walked = case
    walked.soles[:, -1, 0, 3] += 0.004
    assert measures(robot, plan, walked).sideways == pytest.approx(0.004)


def test_what_it_was_turned_by_before_it_began_is_not_its_heading(case):
    robot, plan, walked = case
    turn = pin.Quaternion(pin.exp3(np.array([0, 0, np.radians(6.0)]))).coeffs()
    walked.q[:, 3:7] = turn
    assert measures(robot, plan, walked).heading == pytest.approx(0.0, abs=1e-12)


def test_a_foot_that_lands_early_slips_from_where_it_took_load(case):
    robot, plan, walked = case
    early = slice(65, 76)  # from 1.3 to 1.5 s
    plan.low[1, early] = 1e-3
    walked.load[1, 65:] = walked.load[1, 0]
    walked.soles[1, 65:, :2, 3] = walked.soles[1, -1, :2, 3]
    walked.soles[1, 65:70, 0, 3] -= 1.5e-3
    found = measures(robot, plan, walked)
    assert (found.worst_slip.side, found.worst_slip.start) == ("right", 1.5)
    assert found.worst_slip.distance == pytest.approx(1.5e-3)


def going_round(case, radius, turn=np.pi / 2, steps=6, toward=-1.0):
    """The same time filled with steps round a place ``radius`` away, to the robot's left.

    Or where ``toward`` leads, x + iy: 1j is ahead, so that the robot goes aside, to its right.
    """
    scout, plan, walked = case
    each = turn / steps
    landings = np.linspace(0.5, 1.5, steps)
    gone = np.array([(plan.time[:, None] >= landings)[:, k::2].sum(axis=1) for k in (0, 1)])
    # The right foot lands first, one step round; each landing is two steps after its last one.
    fallen = np.stack([2 * gone[1], np.maximum(2 * gone[0] - 1, 0)])
    fallen[0, plan.time >= 1.6] = fallen[1, plan.time >= 1.6] = steps
    middle = radius * toward
    places = middle + (np.array([-0.04, 0.04])[:, None] - middle) * np.exp(1j * each * fallen)
    feet = np.zeros(plan.feet.shape)
    feet[..., 0], feet[..., 1] = places.real, places.imag
    q = plan.q.copy()
    q[:, 1] = 0.0
    half = each * fallen.mean(axis=0) / 2
    q[:, 5], q[:, 6] = np.sin(half), np.cos(half)
    stances = tuple(
        ((0.0, 0.4), *((float(t), float(t)) for t in landings[1 - k :: 2])) for k in (0, 1)
    )
    soles = walked.soles.copy()
    soles[..., :3, 3] = feet
    plan = replace(plan, feet=feet, q=q, stances=stances)
    return scout, plan, replace(walked, q=q.copy(), soles=soles)


def test_a_plan_that_turns_is_held_against_its_way_round(case):
    scout, plan, walked = going_round(case, 0.3)
    found = measures(scout, plan, walked)
    assert found.planned_turn == pytest.approx(np.pi / 2)
    assert found.planned_distance == pytest.approx(0.3 * np.pi / 2, rel=0.02)
    assert found.distance == pytest.approx(found.planned_distance)
    assert found.heading == pytest.approx(0.0, abs=1e-12)
    # It ends heading to its left, along -x: ten millimetres farther, five to its right.
    walked.soles[:, -1, :2, 3] += [-0.010, 0.005]
    farther = measures(scout, plan, walked)
    assert farther.distance - farther.planned_distance == pytest.approx(0.010, abs=2e-3)
    assert farther.sideways == pytest.approx(0.005, abs=3e-3)
    words = next(one.words for one in criteria(farther) if one.name == "distance")
    assert "far, round to the left" in words


@pytest.mark.parametrize("turn", [np.pi / 2, -np.pi / 2])
@pytest.mark.parametrize(("strays", "met"), [(0.0019, True), (0.0021, False)])
def test_what_turns_in_its_place_may_stray_by_two_millimetres(case, strays, met, turn):
    scout, plan, walked = going_round(case, 0.0, turn)
    walked.soles[:, -1, 1, 3] += strays
    found = measures(scout, plan, walked)
    assert found.stays
    assert found.sideways == 0.0
    assert found.distance == pytest.approx(strays)
    first = next(one for one in criteria(found) if one.name == "distance")
    assert first.met == met
    assert ("turns in its place" in first.words) == met


@pytest.mark.parametrize(("radius", "stays"), [(0.03, True), (0.06, False), (0.3, False)])
def test_a_way_aside_and_round_is_as_long_as_its_arc_not_as_the_zigzag_of_its_landings(
    case, radius, stays
):
    scout, plan, walked = going_round(case, radius, steps=24, toward=1j)
    found = measures(scout, plan, walked)
    assert found.stays == stays  # nearer than half the distance of its feet
    assert found.planned_distance == pytest.approx((not stays) * radius * np.pi / 2, rel=0.02)
    if not stays:  # it ends going along y, to its right: 10 mm farther, 5 mm to the right of that
        walked.soles[:, -1, :2, 3] += [0.005, 0.010]
        farther = measures(scout, plan, walked)
        assert farther.distance - farther.planned_distance == pytest.approx(0.010, abs=1e-3)
        assert farther.sideways == pytest.approx(0.005, abs=1e-3)


def test_a_torso_that_leans_ahead_turns_no_farther(case):
    scout, plan, walked = going_round(case, 0.3, np.pi / 4)
    lean = pin.Quaternion(pin.exp3(np.array([-0.5, 0.0, 0.0])))
    for q in plan.q:
        q[3:7] = (pin.Quaternion(q[3:7]) * lean).coeffs()
    assert measures(scout, plan, walked).planned_turn == pytest.approx(np.pi / 4)


@pytest.mark.parametrize("turn", [np.pi - 0.05, 1.5 * np.pi])
def test_a_try_that_turns_past_half_a_turn_keeps_its_way_and_its_heading(case, turn):
    radius = 0.06  # less than the distance of the feet, more than half of it
    scout, plan, walked = going_round(case, radius, turn, steps=18)
    off = 0.1 / 2  # to the left all the way, which comes past half a turn before the plan does
    half = pin.Quaternion(np.array([0.0, 0.0, np.sin(off), np.cos(off)]))
    for q in walked.q[1:]:
        q[3:7] = (half * pin.Quaternion(q[3:7])).coeffs()
    found = measures(scout, plan, walked)
    assert found.planned_turn == pytest.approx(turn)
    assert not found.stays
    assert found.planned_distance == pytest.approx(radius * turn, rel=0.02)
    assert found.heading == pytest.approx(0.1)
