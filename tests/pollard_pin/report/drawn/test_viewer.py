"""What follows the robot in meshcat: its loops, and the tip's colour by its margins."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.report.drawn.page import trajectory_page
from pollard_pin.report.drawn.viewer import overlays, zone
from pollard_pin.report.judged.limits import distance_class


@pytest.fixture(scope="module")
def robot():
    return pollard_pin.load()


def test_the_tips_colour_is_that_of_the_report_along_a_path(robot):
    path = pollard_pin.appendix_b(robot.specification)
    report = pollard_pin.trajectory_report(robot, path, samples=41)
    found = [zone(robot, q) for q in report.joints.q]
    assert found == report.distance_class.astype(int).tolist()


def test_margins_are_those_of_every_useful_branch(robot):
    solutions = robot.inverse_kinematics([0.45, 0.05, 0.1, 0.1, 0.2, 0.3], "useful")
    seen = set()
    for q, margin in zip(solutions.angles, solutions.margin, strict=True):
        condition = robot.actuation(q).condition
        wanted = int(distance_class(np.array([margin]), np.array([condition]))[0])
        assert zone(robot, q) == wanted
        seen.add(wanted)
    assert seen


def test_an_open_loop_has_no_margin_and_shows_its_opening(robot):
    q = robot.inverse_kinematics([0.45, 0, 0, 0, 0, 0]).angles
    rounded, opened = np.round(q, 5), q + 0.02 * np.arange(12)
    assert zone(robot, rounded) == zone(robot, q)
    assert zone(robot, opened) == 3
    items = {item.name: item for item in overlays(robot, np.array([q, opened]))}
    assert items["tip"].level.tolist() == [zone(robot, q), 3]
    gaps = [
        np.linalg.norm(item.vector, axis=1) for item in items.values() if hasattr(item, "vector")
    ]
    assert len(gaps) == 2
    wanted = np.linalg.norm(robot.posture(opened).opening, axis=-1)
    assert sorted(gap[1] for gap in gaps) == pytest.approx(sorted(wanted), abs=1e-12)
    assert max(gap[0] for gap in gaps) < 1e-9


def test_the_report_page_of_appendix_b_in_20_s_stays_under_3_mb(robot):
    report = pollard_pin.trajectory_report(
        robot, pollard_pin.appendix_b(duration=20.0), samples=2001
    )
    assert len(trajectory_page(report)) < 3e6
