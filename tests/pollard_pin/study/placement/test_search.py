"""Where a path should stand: better than where it stood, confirmed by the report on it."""

import copy
import dataclasses
import itertools
import pickle
import types

import numpy as np
import pytest

import pollard_pin
from pollard_pin.kinematics.geometry import USEFUL_BRANCHES
from pollard_pin.motion.curves import line
from pollard_pin.motion.placing import Placement, place_path
from pollard_pin.report.document import trajectory_report
from pollard_pin.study.placement.judged import ARMS, FOLLOWED, REASONS, arms_cross
from pollard_pin.study.placement.limits import with_limits
from pollard_pin.study.placement.pacing import played
from pollard_pin.study.placement.search import evaluate_placements
from pollard_pin.study.placement.told.document import columns, document
from pollard_pin.study.placement.told.words import best_table, flags, sentences, told
from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.report.writers import csv_bytes, json_bytes

X = np.round(np.arange(0.4, 0.56, 0.05), 9)
Z = np.round(np.arange(0.0, 0.16, 0.05), 9)


def printed_curve():
    return pollard_pin.appendix_b(placement=[0.0, 0.0, 0.0])


def nodding():
    return line([0.42, -0.08, 0.02, 0.2, -0.1, 0.3], [0.5, 0.1, 0.1, -0.1, 0.3, -0.2], 1.5)


@pytest.fixture(scope="module")
def found(pollard):
    """Appendix B over x and z; as the thesis's robot has it, beside the default."""
    return evaluate_placements(
        pollard, printed_curve(), x=X, z=Z, samples=201, start=Placement((0.45, 0.0, 0.0))
    )


def test_appendix_b_takes_a_third_less_torque_elsewhere_and_the_report_confirms_it(found):
    best = found.best[0]
    report = trajectory_report(found.robot, found.best_path, branch=best.branch)
    peak = np.abs(report.torque).max()
    usual = np.abs(trajectory_report(found.robot, pollard_pin.appendix_b()).torque).max()
    assert report.within_limits
    assert peak == pytest.approx(best.torque.max(), rel=1e-12)
    assert usual == pytest.approx(found.start.torque.max(), rel=1e-12)
    assert peak < 0.65 * usual
    assert peak == pytest.approx(0.93, abs=0.01)


def test_the_best_stand_in_order_and_none_of_the_grid_is_better(found):
    values = [one.torque.max() for one in found.best]
    assert values == sorted(values)
    judged = found.judged.torque.max(axis=1)
    number = int(np.nanargmin(np.where(found.judged.reason == FOLLOWED, judged, np.nan)))
    placement, branch = found.choices.at(number)
    again = trajectory_report(found.robot, place_path(found.path, placement), branch=branch)
    assert values[0] <= np.abs(again.torque).max() * (1 + 1e-12)


def test_what_lies_between_the_grids_values_is_found_and_can_be_set_up(pollard):
    """Clearance has its best inside; a finer grid around finds none that is better."""
    path = printed_curve()

    def search(x, z, **asked):
        return evaluate_placements(
            pollard, path, x=x, z=z, objective="clearance", samples=401, best=3, **asked
        )

    space = search([0.35, 0.4, 0.45], [0.0, 0.05, 0.1])
    best = space.best[0]
    assert best.refined
    assert not space.at_ends
    for value in best.placement.position:
        assert value == round(value, 4)
    x, _, z = best.placement.position
    coarse = search([0.35, 0.4, 0.45], [0.0, 0.05, 0.1], refine=False)
    assert best.clearance > 1.02 * coarse.best[0].clearance
    near = search(
        np.linspace(x - 0.01, x + 0.01, 9), np.linspace(z - 0.01, z + 0.01, 9), refine=False
    )
    assert best.clearance > near.best[0].clearance - 2e-3


def test_the_branch_is_the_one_that_trying_each_finds(pollard):
    places = {"x": [0.02], "turn": [-0.2, 0.2]}
    path = nodding()
    asked = {"objective": "conditioning", "samples": 51, "refine": False, "best": 1}
    space = evaluate_placements(pollard, path, branch="useful", **places, **asked)
    values = {}
    for branch, x, turn in itertools.product(USEFUL_BRANCHES, *places.values()):
        try:
            placed = place_path(path, Placement((x, 0.0, 0.0), turn))
            report = trajectory_report(pollard, placed, branch=branch)
        except ThesisPinError:
            continue
        if report.within_limits and not arms_cross(pollard.geometry, report.solutions.angles).any():
            values[branch, x, turn] = report.holding.condition.max()
    best = space.best[0]
    key = (best.branch, best.placement.position[0], best.placement.turn)
    assert values[key] == pytest.approx(best.condition, rel=1e-9)
    assert best.condition == pytest.approx(min(values.values()), rel=1e-9)


def test_of_several_branches_those_with_crossing_arms_are_left_out(pollard):
    crossing = pollard_pin.Branch(-1, 1, 1, 1, 1, -1, 1)
    asked = {"z": 0.05, "samples": 51, "refine": False}
    alone = evaluate_placements(pollard, nodding(), branch=crossing, **asked)
    assert "arms of chains 1 and 2 cross" in " ".join(
        part for part in told(alone, None) if isinstance(part, str)
    )
    both = evaluate_placements(
        pollard, nodding(), branch=[crossing, pollard_pin.DEFAULT_BRANCH], **asked
    )
    assert both.failures == {REASONS[ARMS]: 1}
    assert both.best[0].branch == pollard_pin.DEFAULT_BRANCH


def test_a_condition_number_that_is_allowed_bounds_the_best(pollard):
    asked = {"x": [0.45, 0.5], "z": [0.05, 0.1, 0.15], "samples": 201}
    free, held = (
        evaluate_placements(pollard, printed_curve(), condition=most, **asked)
        for most in (None, 16.0)
    )
    assert free.best[0].condition > 16.0 >= held.best[0].condition
    assert free.best[0].torque.max() < held.best[0].torque.max()
    report = trajectory_report(pollard, held.best_path)
    assert report.holding.condition.max() <= 16.0
    assert held.failures["the condition number exceeds what is allowed"] == 2


def test_the_shortest_time_is_one_that_the_motors_keep_and_no_law_there_is_shorter(pollard):
    robot = with_limits(pollard, [2.0, 2.0, 2.0, 0.05, 0.05, 0.05], 10.0)
    space = evaluate_placements(
        robot, nodding(), z=[0.0, 0.05, 0.1], objective="time", samples=51, refine=False
    )
    best = space.best[0]
    times = {
        one.placement: pollard_pin.time_path(robot, place_path(nodding(), one.placement)).duration
        for one in space.best
    }
    assert best.law.duration == pytest.approx(min(times.values()), rel=1e-9)
    assert best.law.duration < best.fastest <= 1.5
    told = sorted(columns(space)["fastest_s"])
    assert told == pytest.approx(sorted(one.fastest for one in space.best), rel=0.01)
    report = trajectory_report(robot, space.best_path)
    assert report.path.duration == pytest.approx(best.law.duration, rel=1e-9)
    assert report.within_limits
    assert max(report.motor_use.torque.max(), report.motor_use.speed.max()) > 0.98


def test_placements_stand_in_the_order_of_their_laws_where_those_are_known(pollard, monkeypatch):
    """The grid's order is that of paths played faster, which laws may turn round."""
    durations = iter([0.9, 0.7, 0.8, 1.1])

    def timed(_, one):
        return dataclasses.replace(one, law=types.SimpleNamespace(duration=next(durations)))

    monkeypatch.setattr("pollard_pin.study.placement.laws._timed", timed)
    space = evaluate_placements(
        pollard, nodding(), z=[0.0, 0.05, 0.1], objective="time", samples=21, refine=False
    )
    assert [one.law.duration for one in space.best] == [0.7, 0.8, 0.9]
    assert space.start.law.duration == 1.1


def test_played_as_fast_as_it_is_told_no_motor_exceeds_its_limits(pollard):
    robot = with_limits(pollard, [2.0, 2.0, 2.0, 0.05, 0.05, 0.05], 10.0)
    space = evaluate_placements(robot, nodding(), objective="time", samples=51)
    best = space.best[0]
    path = played(place_path(nodding(), best.placement), nodding().duration / best.fastest)
    report = trajectory_report(robot, path)
    assert report.within_limits
    assert path.duration == pytest.approx(best.fastest)
    assert max(report.motor_use.torque.max(), report.motor_use.speed.max()) > 0.99


def test_a_path_that_rests_has_no_shortest_time(pollard):
    rest = line([0.45, 0.02, 0.05, 0.1, 0, 0], [0.45, 0.02, 0.05, 0.1, 0, 0], 1.0)
    with pytest.raises(BadInput, match="stays where it is"):
        evaluate_placements(pollard, rest, objective="time", samples=11)
    assert evaluate_placements(pollard, rest, z=[0.0, 0.1], samples=11, refine=False).best


def test_nothing_that_can_be_followed_is_answered_with_reasons(pollard):
    space = evaluate_placements(pollard, nodding(), x=[1.0, 1.1], samples=21)
    assert space.best == ()
    assert space.failures == {"out of reach": 2}
    text = " ".join(part for part in told(space, None) if isinstance(part, str))
    assert "can't be followed from any placement" in text
    assert json_bytes(document(space, None))


def test_only_what_was_tried_is_at_an_end(found):
    assert found.at_ends == ["z"]
    text = " ".join(part for part in told(found, None) if isinstance(part, str))
    assert "lies at the end of z" in text
    assert "now 1.549 N·m (-40%)" in text


def test_documents_and_tables_say_the_same(found):
    report = trajectory_report(found.robot, found.best_path)
    data, table = document(found, report), columns(found)
    assert json_bytes(data)
    assert len(csv_bytes(table).splitlines()) == found.choices.count + 1 == 17
    assert data["summary"]["followed"] == table["outcome"].count(REASONS[FOLLOWED])
    assert data["best"][0]["flags"] == flags(found, found.best[0])
    assert data["report"]["peak_torque"][0] == pytest.approx(data["best"][0]["peak_torque"][0])
    rows = best_table(found).rows
    assert rows[0][0] == "now"
    assert f"{found.best[0].torque.max():.3f}" in rows[1]


def test_a_notebook_shows_the_answer_and_the_best(found):
    cell = found._repr_html_()
    assert "now 1.549 N·m (-40%)" in cell
    assert cell.count("<tr") == len(found.best) + 2


def test_flags_say_every_part_of_a_placement(pollard):
    space = evaluate_placements(
        pollard,
        nodding(),
        x=0.01,
        turn=np.radians([-10.0, -5.0]),
        mirrored=True,
        samples=51,
        branch=[USEFUL_BRANCHES[4]],
        refine=False,
    )
    worst = space.best[-1]
    degrees = round(np.degrees(worst.placement.turn))
    words = f"--placement 0.01 0 0 --turn {degrees} --mirror --branch={USEFUL_BRANCHES[4]}"
    assert flags(space, worst) == words


def test_the_same_search_twice_is_the_same(pollard):
    def search():
        space = evaluate_placements(pollard, nodding(), x=[0.0, 0.04], z=[0.0, 0.04], samples=51)
        return json_bytes(document(space, None))

    assert search() == search()


def test_progress_goes_up_to_its_total(pollard):
    seen = []
    evaluate_placements(
        pollard,
        nodding(),
        x=[0.0, 0.02],
        turn=[0.0, 0.1],
        samples=21,
        progress=lambda *step: seen.append(step),
    )
    done = [one for one, _ in seen]
    assert done == sorted(done)
    assert len({total for _, total in seen}) == 1
    assert seen[-1][0] == seen[-1][1]


def test_searches_travel(found):
    for other in (pickle.loads(pickle.dumps(found)), copy.deepcopy(found)):
        np.testing.assert_array_equal(other.cost, found.cost)
        assert other.best_path.sample(5).pose.tolist() == found.best_path.sample(5).pose.tolist()


def test_a_picture_and_a_page_are_drawn_of_volumes_planes_lines_and_nothing(pollard):
    from pollard_pin.study.placement.told.figures import placements_figure
    from pollard_pin.study.placement.told.page import placements_page

    path = nodding()
    for axes, panels in (
        ({"x": [0.0, 0.1], "y": [0.0, 0.1], "z": [0.0, 0.05, 0.1]}, 3),
        ({"x": [0.0, 0.1], "z": [0.0, 0.05, 0.1]}, 1),
        ({"turn": [0.0, 0.1, 0.2]}, 1),
        ({"x": [0.0, 0.1], "turn": [0.0, 0.1]}, 1),
        ({"x": [1.0, 1.1], "y": [0.0, 0.1]}, 1),
        ({}, 1),
    ):
        space = evaluate_placements(pollard, path, samples=21, refine=False, **axes)
        figure = placements_figure(space)
        drawn = [ax for ax in figure.axes if ax.get_xlabel()]
        assert len(drawn) == panels
    report = trajectory_report(pollard, space.best_path, samples=21)
    for page in (placements_page(space, report), placements_page(space, None)):
        assert b"data:image/svg+xml;base64," in page


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"x": []}, "ascending"),
        ({"y": [0.1, 0.1]}, "ascending"),
        ({"z": np.nan}, "z"),
        ({"mirrored": [True, True]}, "mirrored"),
        ({"objective": "beauty"}, "objective"),
        ({"samples": 1}, "samples"),
        ({"best": 0}, "best"),
        ({"branch": "none"}, "branches"),
        ({"x": np.arange(2000.0), "y": np.arange(2000.0)}, "4,000,000 placements"),
    ],
)
def test_what_cannot_be_searched_is_refused(pollard, wrong, says):
    with pytest.raises(BadInput, match=says):
        evaluate_placements(pollard, nodding(), **wrong)


@pytest.mark.parametrize("wrong", [{"torque": [1.0, 2.0]}, {"torque": -1.0}, {"speed": 0.0}])
def test_limits_that_are_none_are_refused(pollard, wrong):
    with pytest.raises(BadInput, match="six"):
        with_limits(pollard, **wrong)


def test_other_limits_change_nothing_else(pollard):
    other = with_limits(pollard, 2.0, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    effort, velocity = other.specification.assumptions.joint_limits.of_motors()
    assert effort.tolist() == [2.0] * 6
    assert velocity.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    assert with_limits(pollard) is pollard
    q = pollard.inverse_kinematics([0.45, 0.02, 0.05, 0.1, 0.0, 0.0]).angles
    np.testing.assert_array_equal(
        other.inverse_kinematics([0.45, 0.02, 0.05, 0.1, 0.0, 0.0]).angles, q
    )


def test_a_best_place_that_nearly_touches_a_singularity_is_warned_of_and_another_is_not(found):
    best = found.best[0]
    for margin, condition, warned in (
        (0.049, 20.0, True),
        (0.3, 101.0, True),
        (0.051, 99.0, False),
    ):
        near = copy.deepcopy(best)
        near.judged.margin[0], near.judged.condition[0] = margin, condition
        text = " ".join(sentences(dataclasses.replace(found, best=(near, *found.best[1:]))))
        assert ("nearly touches a singularity" in text) is warned
