"""Walks that go aside and round: where the feet come, what their reports and Pinocchio say."""

import math
from itertools import pairwise

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.motion.cycles import closure, repeat_gait
from scout_pin.motion.exact import exact_toml
from scout_pin.motion.files import load_gait
from scout_pin.motion.swings import sole_gap
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.report.movement import gait_movement
from scout_pin.study.plan.cycles.feet import Moments, Steps
from scout_pin.study.plan.planning import MOST_TURNS, plan_gait, walk
from scout_pin.study.plan.request import GAP, PlanRequest
from scout_pin.study.plan.results.document import document, files
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.report.exchange.movement import content
from thesis_pin.tables.writing import WrittenUnits

from .steps import jumps, states

STEPS = 4
REQUESTS = {
    "aside": PlanRequest(side=-0.02),
    "round": PlanRequest(turn=math.radians(12.0), yaw=math.radians(1.0)),
    "curve": PlanRequest(step_length=0.02, side=0.01, turn=math.radians(-10.0)),
}


@pytest.fixture(scope="module", params=REQUESTS)
def plan(request):
    return plan_gait(scout_pin.load(), REQUESTS[request.param], steps=STEPS)


def gone(request, steps, place=0j):
    """Where a place side by side comes in some steps: on the arc of a circle, or straight."""
    turn, way = request.turn / 2, request.side / 2 + 1j * (request.step_length or 0.0)
    arc = (np.exp(1j * turn * steps) - 1) / (1j * turn) if turn else steps
    return way * arc + np.exp(1j * turn * steps) * place


def lane(plan, foot):
    left, right = plan.cycle.candidate.problem.steps.across
    return complex(right if foot else left)


def test_reports_find_every_limit_kept(plan):
    assert plan.met
    report = plan.walk.report
    assert report.within_limits
    assert report.ends.kind == "rests"
    assert report.margin.min() >= 0.8 * plan.request.margin
    assert report.servo_use.max() <= 0.9 * 1.01
    outer = min(sole_gap(plan.cycle.robot, report.motion)[0], GAP)
    assert outer == pytest.approx(GAP, abs=2e-4)


def test_feet_fall_where_the_way_leads_and_stand_side_by_side_at_the_end(plan):
    gait = plan.walk.gait
    falls = [(0.0, 0), (0.0, 1)]
    falls += [(t, ("left", "right").index(side)) for t, side in gait.touchdowns()]
    assert len(falls) == STEPS + 3
    for k, (t, foot) in enumerate(falls):
        steps = min(max(0, k - 1), STEPS)  # the last one is drawn up
        found = states(gait, t)[1 + foot, :, 0]
        place = gone(plan.request, steps, lane(plan, foot))
        assert complex(found[0], found[1]) == pytest.approx(place, abs=1e-9)
        assert found[5] == pytest.approx(plan.request.turn / 2 * steps, abs=1e-9)
    end = states(gait, gait.end)
    for foot in (0, 1):
        x, y, _, _, _, yaw = end[1 + foot, :, 0]
        assert complex(x, y) == pytest.approx(gone(plan.request, STEPS, lane(plan, foot)), abs=1e-9)
        assert yaw == pytest.approx(plan.request.turn / 2 * STEPS, abs=1e-9)


def test_a_repeated_cycle_goes_its_way_as_often(plan):
    cycle, pairs = plan.gait, 7
    again = repeat_gait(cycle, pairs)
    turn = plan.request.turn
    for foot, k in ((0, 0), (1, -1)):
        found = states(again, again.end)[1 + foot, :, 0]
        place = gone(plan.request, 2 * pairs + k, lane(plan, foot))
        assert complex(found[0], found[1]) == pytest.approx(place, abs=1e-9)
        assert found[5] == pytest.approx(turn * pairs + k * turn / 2, abs=1e-9)
    assert not again.rate_jumps()
    assert closure(cycle).closed
    assert closure(cycle).turn == pytest.approx(turn, abs=1e-9)
    # A cycle's displacement is that of the middle of its feet; the right one is a step behind.
    went = [gone(plan.request, 2 - k, lane(plan, k)) for k in (0, 1)]
    came = [gone(plan.request, -k, lane(plan, k)) for k in (0, 1)]
    assert complex(*closure(cycle).displacement) == pytest.approx(
        (sum(went) - sum(came)) / 2, abs=1e-9
    )
    # Each pair of steps asks the same of the servos.
    robot = plan.cycle.robot
    t = np.linspace(0.01, cycle.end - 0.01, 40)
    one, last = (joint_trajectory(robot, again.sample(t + k * cycle.end)) for k in (0, pairs - 1))
    np.testing.assert_allclose(one.q, last.q, atol=1e-6)
    np.testing.assert_allclose(one.v, last.v, atol=1e-4)
    np.testing.assert_allclose(one.a, last.a, atol=2e-2)


def test_a_walk_goes_on_over_its_joins(plan):
    gait = plan.walk.gait
    start, step = plan.start.course.duration, plan.cycle.pace.step_time
    for t in (start, start + (STEPS - 1) * step):
        assert (jumps(gait, t) < (1e-9, 1e-7, 1e-5)).all()
    assert not gait.rate_jumps()


def test_the_torso_turns_with_the_feet_and_keeps_its_posture(plan):
    cycle, request = plan.gait, plan.request
    t = np.linspace(0.0, cycle.end * (1 - 1e-12), 501)
    motion = cycle.sample(t)
    heading = request.turn / 2 * (t / plan.cycle.pace.step_time - 0.5)
    for matrix, h in zip(motion.torso.rotation, heading, strict=True):
        own = pin.rpy.rpyToMatrix(0.0, 0.0, -h) @ matrix
        yaw, roll = np.arctan2(-own[0, 1], own[0, 0]), np.arcsin(own[0, 2])
        pitch = np.arctan2(-own[1, 2], own[2, 2])
        assert abs(yaw) <= request.yaw + 1e-6
        assert abs(roll) <= request.roll + 1e-6
        assert abs(pitch) <= request.pitch + 1e-6


def test_torques_are_those_of_pinocchio_on_the_gait_differenced(plan):
    """On one foot: what rates and accelerations of the written curves make of RNEA."""
    robot, gait = plan.cycle.robot, plan.gait
    problem, known = plan.cycle.candidate.problem, plan.cycle.candidate.known
    moments = Moments(np.array([0, 1]), np.array([True, True]), np.array([0.4, 0.6]))
    excess = problem.excess(known, moments=moments)
    torque = excess["torque"].value * robot.stall_torque + problem.limits.torque
    h = 1e-4
    for k, t in enumerate(moments.times(known.share) * plan.cycle.pace.step_time):
        motion = gait.sample(t + np.array([-h, 0.0, h]))
        q = scout_pin.coordinates.free_flyer_state(motion.torso, joint_trajectory(robot, motion))[0]
        before, after = (pin.difference(robot.model, *pair) / h for pair in pairwise(q))
        v, a = (before + after) / 2, (after - before) / h
        # RNEA of a pose between: the wrench of the standing sole holds the root.
        data = robot.model.createData()
        need = pin.rnea(robot.model, data, q[1], v, a)
        frame = robot.sole_frames[("left", "right")[k]]
        jacobian = pin.computeFrameJacobian(robot.model, data, q[1], frame, pin.LOCAL)
        wrench = np.linalg.solve(jacobian[:, :6].T, need[:6])
        viscous = robot.specification.assumptions.joint_friction.viscous * v[6:]
        expected = need[6:] - jacobian[:, 6:].T @ wrench + viscous
        np.testing.assert_allclose(torque[k], np.abs(expected), atol=2e-3)


def test_files_read_back_are_the_plan_and_say_which_way(plan, tmp_path):
    made = files(plan)
    (tmp_path / "walk.toml").write_bytes(made["walk.toml"])
    found = scout_pin.gait_report(plan.cycle.robot, load_gait(tmp_path / "walk.toml"), samples=801)
    assert found.margin.min() == pytest.approx(plan.walk.judged.margin, abs=1e-4)
    said, pace = document(plan)["walk"], document(plan)["pace"]
    end = gone(plan.request, STEPS)
    np.testing.assert_allclose(said["displacement"], [end.real, end.imag], atol=1e-12)
    assert said["turn"] == pytest.approx(2 * plan.request.turn)
    assert pace["aside"] == plan.request.side / 2
    text = plan.verdict()[0]
    for amount, words in (
        (plan.request.step_length, "40 mm ahead"),
        (plan.request.side, f"{abs(plan.request.side) * 1e3:g} mm to the "),
        (plan.request.turn, f"{abs(math.degrees(plan.request.turn)):.4g}° round to the "),
    ):
        assert (words in text) == bool(amount)


def test_the_longest_walk_that_turns_can_be_read_back(plan):
    if plan.request.turn:
        text = exact_toml(walk(plan.cycle, plan.start, plan.stop, MOST_TURNS))
        assert len(text) < LIMITS.toml_bytes


@pytest.mark.parametrize("units", ["", "mm,deg"])
def test_a_cycle_still_closes_where_it_is_written_down_again(plan, tmp_path, units):
    chosen = WrittenUnits.parse(units) if units else None
    movement, file = gait_movement(plan.cycle.robot, plan.gait), tmp_path / "cycle.toml"
    file.write_bytes(content(movement, "toml", chosen))
    again = closure(load_gait(file))
    assert not again.gaps
    assert again.turn == pytest.approx(plan.request.turn, abs=1e-9)


@pytest.mark.parametrize("asked", [{"side": 0.03}, {"side": -0.03}, {"turn": 0.2}, {"turn": -0.2}])
def test_soles_keep_their_gap_where_they_come_nearest(scout, asked):
    request = PlanRequest(**asked)
    steps = Steps.of(scout, request)
    straight = Steps.of(scout, PlanRequest())
    assert steps.across[1] > straight.across[1]
    if "side" in asked:  # alternately nearer and farther by half of it
        assert steps.across[1] - straight.across[1] == pytest.approx(0.015 / 2, abs=2e-6)
    with pytest.raises(BadInput, match="touch") as caught:
        Steps.of(scout, PlanRequest(foot_spacing=0.06, **asked))
    assert f"{2e3 * steps.across[1]:.4g} mm" in str(caught.value)
