"""Gaits walked in the engine: those called walkable walk, the thesis's tips over."""

from types import SimpleNamespace

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.motion.files import load_gait
from scout_pin.report.document import gait_report
from scout_pin.specification import SIDES
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.draws import simulate_gait
from scout_pin.study.simulate.planned import planned
from scout_pin.study.simulate.verdict import criteria, sentences
from scout_pin.study.simulate.walking import _Servos, walk
from thesis_pin.errors import BadInput
from thesis_pin.simulation.engine import Engine

from ...conftest import EXAMPLES
from ...dynamics.test_rotors import REFLECTED, geared
from .conftest import STEP

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install mujoco")


def test_a_gait_called_walkable_walks(walked):
    (found,) = walked.draws
    assert walked.passed
    assert found.distance == pytest.approx(0.02, rel=2e-2)
    assert found.worst_slip.distance < 2e-4
    assert np.degrees(found.tilt) < 0.2
    np.testing.assert_allclose(found.peak_torque, walked.planned_peak, atol=6e-3)


@pytest.mark.parametrize("name", ["squat", "lopsided_walk"])
def test_other_robots_and_motions_keep_to_their_plans_too(report_of, name):
    simulation = simulate_gait(report_of(name), Conditions(time_step=STEP))
    assert simulation.verdict()[0].startswith("PASS")


def test_shorter_steps_of_the_engine_change_nothing_that_counts(report_of, walked):
    finer = simulate_gait(report_of("walk"), Conditions(time_step=STEP / 2))
    assert finer.draws[0].distance == pytest.approx(walked.draws[0].distance, abs=5e-5)
    np.testing.assert_allclose(finer.draws[0].peak_torque, walked.draws[0].peak_torque, atol=2e-3)


def test_the_floor_bears_the_weight(scout, walked):
    before = walked.plan.time < 0
    standing = walked.walked.load[:, before].sum(axis=0)[-100:]
    np.testing.assert_allclose(standing, scout.mass * 9.81, rtol=1e-3)


def test_the_thesis_s_gait_tips_and_loads_its_swinging_foot_and_is_told_so(thesis_walked):
    (found,) = thesis_walked.draws
    assert not thesis_walked.passed
    assert np.degrees(found.tilt) > 10
    said = " ".join(sentences(found))
    assert "It tips: from t = 0.4" in said
    assert found.stumble.load > 1.0
    assert f"The {found.stumble.side} foot bears" in said
    assert "doesn't begin at rest" in thesis_walked.start


def test_without_making_up_for_sag_the_same_gait_comes_short_and_drags_its_feet(report_of):
    conditions = Conditions(time_step=STEP, sag_compensation=False)
    simulation = simulate_gait(report_of("walk"), conditions)
    met = {one.name: one.met for one in criteria(simulation.draws[0])}
    assert not met["distance"]
    assert simulation.draws[0].stumble.load > 1.0


def test_a_servo_s_torque_ends_on_its_line_of_torque_and_speed(report_of):
    """Hurried, servos are at |τ|/stall + |ω|/no-load = 1 where they turn the way they push."""
    report = report_of("walk", 0.03)
    conditions = Conditions(time_step=STEP)
    plan = planned(report, conditions)
    found = walk(report.robot, plan, conditions)
    assert found.saturated.max() > 0
    rate, robot = found.v[:, 6:], report.robot
    # What is recorded was given over the step before, at about the same rate.
    with_rate = np.where(found.torque * rate > 0, np.abs(rate), 0.0)
    line = np.abs(found.torque) / robot.stall_torque + with_rate / robot.no_load_speed
    assert np.quantile(line, 0.999) < 1.3
    assert np.abs(found.torque).max() <= robot.stall_torque.max() * (1 + 1e-12)


def test_slippery_and_tilted_floors_are_felt(report_of):
    report = report_of("squat")
    tilted = Conditions(time_step=STEP, floor_tilt=(np.radians(20.0), 0.0), friction=0.1)
    (found,) = simulate_gait(report, tilted).draws
    assert found.distance > 0.05  # it slides downhill
    assert not criteria(simulate_gait(report, tilted).draws[0])[0].met


def test_draws_are_the_same_however_many_and_whoever_shares_them(report_of):
    report = report_of("squat")
    errors = {"servo_zero_error": np.radians(0.5), "mass_error": 0.05, "time_step": 2e-3}
    alone = simulate_gait(report, Conditions(draws=2, seed=4, **errors))
    shared = simulate_gait(report, Conditions(draws=3, seed=4, jobs=2, **errors))
    for one, other in zip(alone.draws, shared.draws, strict=False):
        assert one.tilt == other.tilt
        np.testing.assert_array_equal(one.peak_torque, other.peak_torque)
    assert len({one.tilt for one in shared.draws}) == 3
    assert shared.summary()["draws"] == 3


def test_progress_counts_every_step_of_every_draw(report_of):
    told = []
    errors = {"servo_zero_error": 0.01, "time_step": 2e-3}
    simulate_gait(
        report_of("squat"), Conditions(draws=2, **errors), progress=lambda *now: told.append(now)
    )
    done = [one for one, _ in told]
    assert done == sorted(done)
    assert done[-1] == told[-1][1]
    assert len({total for _, total in told}) == 1


def test_an_interruption_ends_it_at_once(report_of, monkeypatch):
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate_gait(report_of("squat"), Conditions(time_step=2e-3), progress=stop)


def test_too_many_steps_are_refused_before_any_is_taken(report_of, monkeypatch):
    monkeypatch.setattr("scout_pin.study.simulate.planned.MOST_STEPS", 100)
    with pytest.raises(BadInput, match="steps"):
        simulate_gait(report_of("squat"), Conditions())


def test_the_share_of_the_line_counts_rotors_and_only_the_way_a_servo_pushes(report_of):
    from scout_pin.study.simulate.world import rotors

    report = report_of("walk", 0.05)
    conditions = Conditions(time_step=STEP, armature=2e-3)
    joints, torque, robot = report.joints, report.dynamics.torque, report.robot
    given = torque + rotors(robot, conditions) * joints.a
    share = np.abs(given) / robot.stall_torque
    share += np.where(given * joints.v > 0, np.abs(joints.v), 0.0) / robot.no_load_speed
    np.testing.assert_allclose(planned(report, conditions).line, share.max(axis=0), rtol=2e-2)


def test_soles_are_where_pinocchio_has_them(scout, walked):
    model, data = scout.model, scout.model.createData()
    pin.framesForwardKinematics(model, data, walked.walked.q[0])
    for number, side in enumerate(SIDES):
        expected = data.oMf[scout.sole_frames[side]].homogeneous
        np.testing.assert_allclose(walked.walked.soles[number, 0], expected, atol=1e-9)


class Begun(Exception):
    """What a try asks of the engine."""


@pytest.mark.parametrize(("name", "stands"), [("squat", True), ("thesis", False)])
def test_a_try_begins_as_planned_and_servos_are_off_by_their_zeros(
    report_of, monkeypatch, name, stands
):
    placed = []
    monkeypatch.setattr(Engine, "place", lambda _, q, v, time: placed.append((q, v, time)))

    def run(_, asked, **how):
        raise Begun(asked)

    monkeypatch.setattr(Engine, "run", run)
    report = report_of(name)
    conditions = Conditions(time_step=STEP, servo_zero_error=0.01, seed=5)
    plan = planned(report, conditions)
    with pytest.raises(Begun) as begun:
        walk(report.robot, plan, conditions, 2)
    off = begun.value.args[0] / 20.0 - plan.commands
    zeros = conditions.errors(2)[0]
    assert np.abs(zeros).max() > 5e-3
    np.testing.assert_allclose(off, np.broadcast_to(zeros, off.shape), atol=1e-12)
    ((q, v, time),) = placed
    np.testing.assert_array_equal(q, plan.q[0])
    if stands:
        assert v is None
        assert time == pytest.approx(-0.5)
    else:
        assert time == 0.0
        np.testing.assert_allclose(v[6:], report.joints.v[0], atol=1e-9)
        assert np.abs(v).max() > 0.01


def test_servos_are_watched_while_the_gait_lasts_and_weaken_the_way_they_turn(scout):
    model = SimpleNamespace(actuator_forcerange=np.zeros((12, 2)))
    data = SimpleNamespace(qvel=np.zeros(18), actuator_force=np.zeros(12))
    data.qvel[6:8] = 0.25 * scout.no_load_speed[0], -2.0 * scout.no_load_speed[1]
    plan = SimpleNamespace(before=2, after=3, commands=np.zeros((10, 12)))
    servos = _Servos(scout, SimpleNamespace(model=model, data=data), plan)
    stall = scout.stall_torque[0]
    for number in range(10):
        servos.before()
        lasts = 2 <= number < 7
        data.actuator_force[:3] = 0.75 * stall, 0.01 * number, 0.1 if lasts else 0.3
        servos.after()
    np.testing.assert_allclose(model.actuator_forcerange[:3] / stall, [[-1, 0.75], [0, 1], [-1, 1]])
    assert servos.steps == 5
    np.testing.assert_allclose(servos.peak[:3], [0.75 * stall, 0.06, 0.1])
    np.testing.assert_allclose(servos.full, [5.0] + [0.0] * 11)


def test_rotors_of_the_specification_and_of_the_conditions_are_commanded_alike(scout):
    """On one foot, where nothing is shared."""
    gait, conditions = load_gait(EXAMPLES / "walk.toml"), Conditions(armature=REFLECTED)
    plain, other = (
        planned(gait_report(robot, gait, samples=101, time_unit=0.05), conditions)
        for robot in (scout, geared())
    )
    steps = len(plain.commands) - plain.before - plain.after
    t = gait.start + np.arange(steps) * plain.step / 0.05
    single = plain.before + np.flatnonzero(~gait.sample(t, 0.05).support.all(axis=1))
    assert len(single) > 100
    np.testing.assert_allclose(plain.commands[single], other.commands[single], atol=1e-9)
    without = planned(
        gait_report(scout, gait, samples=101, time_unit=0.05), Conditions(armature=0.0)
    )
    assert np.abs(plain.commands - without.commands)[single].max() > 1e-4
    np.testing.assert_allclose(plain.line, other.line, rtol=0.02)


def test_stances_last_from_landing_to_lift_off(report_of):
    """Where samples of the gait begin and end to have a foot in support."""
    report = report_of("walk", 0.1)
    plan, gait = planned(report, Conditions(time_step=STEP)), report.gait
    t = np.linspace(gait.start, gait.end, 2001)
    support = gait.sample(t, 0.1).support
    for side, stances in enumerate(plan.stances):
        changes = np.diff(np.r_[0, support[:, side].astype(int), 0])
        starts, ends = np.flatnonzero(changes == 1), np.flatnonzero(changes == -1) - 1
        expected = np.stack([t[starts], t[ends]], axis=1) * 0.1 - gait.start * 0.1
        np.testing.assert_allclose(stances, expected, atol=2e-3 * plan.duration)
