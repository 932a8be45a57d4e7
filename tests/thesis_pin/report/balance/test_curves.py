"""What a balance report draws on the floor."""

import numpy as np
from standing_robots import standing

from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.soles.outlines import area
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.report.balance.curves import _stances, ground
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.balance.making import balance_report


def test_each_stretch_of_a_stance_is_drawn_once():
    support = np.array([[1, 1]] * 3 + [[1, 0]] * 5 + [[1, 1]] * 2, dtype=bool)
    assert _stances(support).tolist() == [1, 5, 9]


def test_the_floor_of_a_held_pose_shows_its_polygon_soles_and_points():
    robot, feet, pose = standing("talos")
    report = balance_report(robot, pose=pose, feet=feet)
    plot = ground(report)
    (polygon,) = [one for one in plot.areas if one.name == "support polygon"]
    soles = [one for one in plot.areas if one.name == "soles"]
    assert area(polygon.corners) > sum(area(one.corners) for one in soles[::2]) > 0
    zmp = next(curve for curve in plot.curves if curve.name == "zero-moment point")
    np.testing.assert_allclose(zmp.x[0], report.found.zero_moment_point[0, 0], atol=1e-12)
    points = {curve.name: curve for curve in plot.curves}
    com = points["centre of mass, from above"]
    np.testing.assert_allclose(com.x, points["zero-moment point"].x, atol=1e-9)
    assert com.marks != points["zero-moment point"].marks  # else one hides the other


def test_points_of_contact_of_all_feet_share_a_line_of_the_legend():
    robot, feet, pose = standing("anymal")
    report = balance_report(robot, pose=pose, feet=feet)
    (points,) = [curve for curve in ground(report).curves if curve.name == "points of contact"]
    want = report.found.floor.flat(report.found.stance.origin[0])
    found = np.unique(np.stack([points.x, points.y], axis=1).round(9), axis=0)
    np.testing.assert_allclose(found, np.unique(want.round(9), axis=0), atol=1e-12)


def test_what_two_points_span_is_a_line():
    robot, feet, pose = standing("bolt")
    (line,) = ground(balance_report(robot, pose=pose, feet=feet)).areas
    assert (line.name, len(line.corners), line.filled) == ("support polygon", 2, False)


def test_polygons_come_before_lines_so_that_a_legend_shows_one():
    robot, feet, pose = standing("anymal")
    on = np.ones((21, 4), dtype=bool)
    on[:10, [0, 3]] = False
    q = np.repeat(stand(robot, feet, pose).q[None], 21, axis=0)
    still = np.zeros((21, robot.model.nv))
    found = foot_dynamics(robot, feet, q, still, still, support=on)
    report = balance_report(robot, pose=pose, feet=feet)
    drawn = ground(BalanceReport(report.motors, found, False)).areas
    assert [one.filled for one in drawn] == [True, False]
