"""Walks from rest to rest: what their reports say, what is written, what stands in the way."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.exact import exact_toml
from scout_pin.motion.files import load_gait
from scout_pin.study.plan import planning
from scout_pin.study.plan.cycles import aims
from scout_pin.study.plan.cycles.shortfall import Binding, Shortfall
from scout_pin.study.plan.planning import MOST_STEPS, plan_gait, walk
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.results.document import document, files
from scout_pin.study.plan.results.result import Plan
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.report.writers import json_bytes

from ...conftest import EXAMPLES
from .steps import jumps, states

STEPS = 3


@pytest.fixture(scope="module")
def told():
    """What the plan tells of its progress."""
    return []


@pytest.fixture(scope="module")
def plan(told):
    def progress(done, total):
        told.append((done, total))

    request = PlanRequest(margin=0.008)
    return plan_gait(scout_pin.load(), request, steps=STEPS, progress=progress)


def test_a_walk_is_judged_by_reports_at_800_samples(plan):
    assert plan.met
    walk = plan.walk
    assert len(walk.report.joints.time) >= 800
    assert walk.report.within_limits
    assert walk.report.margin.min() >= 0.8 * 0.008
    shares = walk.report.actuators.peak_torque / plan.cycle.robot.stall_torque
    assert shares.max() <= 0.9 * 1.01
    assert walk.report.servo_use.max() <= 0.9 * 1.01  # a tenth of the line is left


def test_a_walk_begins_and_ends_at_rest_with_its_feet_side_by_side(plan):
    gait = plan.walk.gait
    assert plan.walk.report.ends.kind == "rests"
    length = plan.cycle.pace.step_length
    for t, y in ((gait.start, 0.0), (gait.end, STEPS * length)):
        found = states(gait, t)
        np.testing.assert_allclose(found[1:, 1, 0], y, atol=1e-12)
        np.testing.assert_allclose(found[..., 1], 0.0, atol=1e-8)
        np.testing.assert_allclose(found[..., 2], 0.0, atol=1e-6)


def test_the_torso_keeps_its_posture_from_rest_to_rest(plan):
    gait, request = plan.walk.gait, plan.request
    t = np.linspace(gait.start, gait.end, 3001)
    z, pitch, roll, yaw = (curve(t) for curve in gait.curves["torso"][2:])
    for values, most in ((pitch, request.pitch), (roll, request.roll), (yaw, request.yaw)):
        assert np.abs(values).max() <= most
    neutral = -plan.cycle.robot.neutral_feet()["left"][2, 3]
    assert z.min() >= 0.8 * neutral
    assert z.max() <= neutral


def test_a_walk_goes_on_over_its_joins(plan):
    gait = plan.walk.gait
    start, step = plan.start.course.duration, plan.cycle.pace.step_time
    for t in (start, start + (STEPS - 1) * step):
        assert (jumps(gait, t) < (1e-11, 1e-8, 1e-6)).all()
    assert not gait.rate_jumps()


def test_steps_of_the_walk_are_the_cycle(plan):
    gait, cycle = plan.walk.gait, plan.gait
    start, step = plan.start.course.duration, plan.cycle.pace.step_time
    # The right foot goes first; where it lands the cycle's second step begins.
    for t in np.linspace(0.01, step - 0.01, 7):
        mine, its = states(gait, start + t), states(cycle, cycle.start + step + t)
        gap = mine - its
        gap[:, 1, 0] -= gap[0, 1, 0]
        np.testing.assert_allclose(gap, 0.0, atol=1e-8)


def test_files_read_back_give_the_same_report(plan, tmp_path):
    made = files(plan, "scout-pin plan --steps 3")
    assert {"walk.toml", "cycle.toml", "joints.csv", "commands.csv", "plan.json"} <= set(made)
    for name, report in (("walk.toml", plan.walk.report), ("cycle.toml", None)):
        (tmp_path / name).write_bytes(made[name])
        assert made[name].startswith(b"# Made by: scout-pin plan --steps 3\n")
        found = scout_pin.gait_report(plan.cycle.robot, load_gait(tmp_path / name), samples=801)
        if report is None:
            assert found.ends.kind == "cycles"
            assert found.margin.min() == pytest.approx(plan.judged.margin, abs=1e-9)
        else:
            np.testing.assert_allclose(found.dynamics.torque, report.dynamics.torque, atol=1e-9)
            np.testing.assert_allclose(found.margin, report.margin, atol=1e-9)


def test_the_longest_walk_can_be_read_back(plan, tmp_path):
    gait = walk(plan.cycle, plan.start, plan.stop, 99)  # odd, as the stop was planned
    text = exact_toml(gait)
    assert len(text) * MOST_STEPS / 99 < LIMITS.toml_bytes
    (tmp_path / "long.toml").write_text(text, encoding="utf-8")
    assert load_gait(tmp_path / "long.toml").phases == gait.phases


def test_a_long_walk_is_judged_as_finely_as_a_short_one(plan, monkeypatch):
    asked = []

    def report(robot, gait, samples):
        asked.append((gait.cycle, samples))
        return plan.walk.report

    monkeypatch.setattr(planning, "gait_report", report)
    monkeypatch.setattr(planning, "plan_cycle", lambda *_, **__: plan.cycle)
    plan_gait(scout_pin.load(), steps=21)
    assert asked == [(True, 801), (False, 80 * 23)]


def test_a_walk_is_held_to_the_least_margin_that_its_parts_were_planned_with(plan, monkeypatch):
    parts = iter([plan.start, replace(plan.stop, margin=0.0064)])
    monkeypatch.setattr(planning, "plan_cycle", lambda *_, **__: plan.cycle)
    monkeypatch.setattr(planning, "plan_transition", lambda *_: next(parts))
    found = plan_gait(scout_pin.load(), plan.request, steps=STEPS)
    assert found.walk.margin == 0.0064
    assert plan.walk.margin == 0.008


def test_a_short_step_is_as_short_as_asked():
    found = plan_gait(scout_pin.load(), PlanRequest(step_length=0.0005), steps=1)
    assert found.met
    assert found.cycle.pace.step_length == 0.0005
    assert states(found.walk.gait, found.walk.gait.end)[1, 1, 0] == pytest.approx(0.0005)


def test_a_walk_of_one_step_needs_no_cycle(plan, monkeypatch):
    monkeypatch.setattr(planning, "plan_cycle", lambda *_, **__: plan.cycle)  # the same request's
    found = plan_gait(scout_pin.load(), PlanRequest(margin=0.008), steps=1)
    assert found.met
    assert [p.support for p in found.walk.gait.phases] == [
        "double",
        "left",
        "double",
        "right",
        "double",
    ]


def test_a_lopsided_biped_walks_too():
    robot = scout_pin.load(EXAMPLES / "lopsided.toml")
    found = plan_gait(robot, steps=2)
    assert found.met
    assert found.walk.report.within_limits


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"margin": 0.0075}, "margin of 7.50 mm"),
        ({"torque": 0.92}, "of its stall torque"),
        ({"speed": 0.95}, "of its no-load speed"),
        ({"line": 0.92}, "of its torque-speed line"),
        ({"walks": False}, "its report says"),
    ],
)
def test_what_a_report_finds_passed_is_not_written_as_good(plan, change, said):
    walk = replace(plan.walk, judged=replace(plan.walk.judged, **change))
    bad = replace(plan, walk=walk)
    assert not bad.met
    assert any(said in why for why in bad.failures())
    with pytest.raises(BadInput, match="isn't met"):
        files(bad)


def test_what_stands_in_the_way_is_named_with_what_could_be_met(plan):
    cycle = plan.cycle
    worst = replace(cycle.worst[0], kind="knee", subject="left", value=1.03, limit=0.985)
    nearest = {
        "step_length": cycle.request.changed(step_length=0.0912, step_time=0.8),
        "foot_spacing": cycle.request.changed(foot_spacing=0.088),
    }
    short = Shortfall((Binding(True, worst),), nearest)
    found = Plan(replace(cycle, shortfall=short), STEPS)
    assert not found.met
    text = " ".join(found.verdict())
    assert "the knees' reach (left" in text
    assert "beyond the reach of a straight leg" in text
    assert "a step of 91.2 mm or with feet 88 mm apart." in text
    said = document(found)
    assert (said["met"], said["walk"]) == (False, None)
    assert said["shortfall"]["nearest"]["step_length"]["step_length"] == 0.0912
    assert json_bytes(said)


def test_an_interrupted_search_keeps_the_best_so_far():
    calls = []

    def impatient(done, total):
        calls.append((done, total))
        if len(calls) == 3:
            raise KeyboardInterrupt

    request = PlanRequest(objective="largest_margin")
    found = plan_gait(scout_pin.load(), request, steps=1, progress=impatient)
    assert found.interrupted
    assert found.met
    assert "interrupted" in " ".join(found.verdict())


def test_an_interrupt_before_there_is_anything_stays_one(monkeypatch):
    from scout_pin.study.plan.cycles.search import Search

    def first(self, request):
        raise KeyboardInterrupt

    monkeypatch.setattr(Search, "first", first)
    with pytest.raises(KeyboardInterrupt):
        plan_gait(scout_pin.load())


def test_progress_only_grows_and_ends_at_the_whole(plan, told):
    assert plan.met
    done = [one / total for one, total in told]
    assert len(done) > 5
    assert done == sorted(done)
    assert told[-1][0] == told[-1][1]


@pytest.mark.parametrize(
    ("asked", "steps", "samples", "said"),
    [
        ({}, 0, 801, "steps"),
        ({}, 101, 801, "at most 100"),
        ({}, 3, 799, "samples"),
        ({"foot_spacing": 0.05}, 3, 801, "overlap"),
    ],
)
def test_what_cannot_be_meant_is_refused(asked, steps, samples, said):
    with pytest.raises(BadInput, match=said):
        plan_gait(scout_pin.load(), PlanRequest(**asked), steps=steps, samples=samples)


def test_a_request_of_another_kind_is_refused():
    with pytest.raises(BadInput, match="PlanRequest"):
        plan_gait(scout_pin.load(), {"step_length": 0.03})


def test_a_walk_is_as_good_as_the_cycle_of_its_objective(scout, monkeypatch):
    monkeypatch.setattr(aims, "STEPS", 4)  # far enough: each may take a margin 2.4 mm further
    request = PlanRequest(objective="largest_margin")
    plan = plan_gait(scout, request, steps=1)
    assert plan.met
    best = plan.cycle.candidate.request.margin
    assert best > 2 * request.margin
    assert plan.walk.report.margin.min() >= 0.99 * best
