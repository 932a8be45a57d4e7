"""The page and the view of a balance report: forces, polygon and points are where they act."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from standing_robots import standing

from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.pages.page import in_words
from thesis_pin.pages.reports.balance import _tiles, balance_page
from thesis_pin.pages.reports.balance_scene import scene
from thesis_pin.report.balance.document import BalanceReport
from thesis_pin.report.balance.making import balance_report


@pytest.fixture(scope="module")
def report():
    robot, feet, pose = standing("talos")
    return balance_report(robot, pose=pose, feet=feet)


def test_arrows_start_where_the_floor_pushes_and_point_as_it_does(report):
    items = {item.name: item for item in scene(report).items}
    for k, name in enumerate(report.names):
        arrow = items[f"contact {name}"]
        np.testing.assert_array_equal(arrow.origin, report.found.stance.origin[:, k])
        np.testing.assert_array_equal(arrow.vector, report.found.wrench[:, k, :3])
    polygon = items["support"]
    assert polygon.outlines[0][:, 2] == pytest.approx(1e-3)  # a little above the floor
    np.testing.assert_array_equal(items["zmp"].position, report.found.zero_moment_point)
    assert scene(report).floor == 0.0


def test_parameters_are_words_without_a_floor_s_rounding(report):
    grounded = replace(report.found, floor=Floor(-3.6e-10))
    page = balance_page(BalanceReport(report.motors, grounded, True)).decode()
    parameters = page[page.index(">Parameters<") : page.index(">Software<")]
    parameters = re.sub('<span class="number">(.*?)</span>', r"\1", parameters)
    left, right = report.names
    assert f"{left}, {right}" in parameters
    assert "0.6, 0.6" in parameters
    assert "e-10" not in parameters
    assert not {"[", "{", "None"} & set(parameters)
    assert in_words({"a": (1.5, True), "b": None, "c": []}) == "a: 1.5, yes; b: –; c: –"


@pytest.mark.parametrize(("margin", "good"), [(0.01, True), (-9e-5, None)])
def test_a_margin_outside_by_less_than_counts_has_no_tick(report, margin, good):
    near = replace(report.found)
    near.__dict__["margin"] = np.full(2, margin)  # as if it were found
    page = balance_page(BalanceReport(report.motors, near, True)).decode()
    tile = page[page.index("least margin") - 200 : page.index("least margin") + 200]
    assert f"{margin * 1e3:.3g} mm" in tile
    mark = _tiles(BalanceReport(report.motors, near, True))[1]
    assert (mark.label, mark.good) == ("least margin", good)


def test_where_a_robot_slips_its_margin_is_kept_and_its_friction_is_not():
    robot, feet, pose = standing("solo12")
    slipping = balance_report(robot, pose=pose, feet=feet, floor=Floor(0.0, np.radians(35)))
    assert slipping.cause.slips
    good = {tile.label: tile.good for tile in _tiles(slipping)}
    assert slipping.least_margin.value > 0
    assert (good["least margin"], good["friction in use"]) == (True, False)


def test_the_largest_torque_and_the_largest_share_of_a_limit_are_two_motors(report):
    motors = report.motors
    most, nearest = motors.actuators.peak_torque.argmax(), motors.effort_use.argmax()
    assert motors.names[most] != motors.names[nearest]
    tiles = {tile.label: tile.value for tile in _tiles(report)}
    assert tiles["peak torque"] == f"{motors.actuators.peak_torque[most]:.4g} N·m"
    assert tiles["of a motor's limit in use, at most"] == f"{motors.effort_use[nearest]:.0%}"


def test_a_held_pose_has_no_columns_of_rates_and_work(report):
    page = balance_page(report).decode()
    assert "peak speed" not in page
    assert "of limit" in page
    assert "bears load" not in page


def test_a_page_names_the_description_s_file_without_its_folder():
    robot, feet, pose = standing("anymal")
    report = balance_report(robot, pose=pose, feet=feet)
    assert any(robot.description.where in one for one in report.warnings())
    page = balance_page(report).decode()
    assert "anymal.urdf:" in page
    assert str(Path(robot.description.where).parent) not in page


def test_a_foot_off_the_floor_has_no_arrow_and_a_slope_is_drawn():
    robot, feet, pose = standing("anymal")
    floor = Floor(0.1, np.radians(10))
    report = balance_report(
        robot, pose=pose, feet=feet, floor=floor, support=np.array([True, True, True, False])
    )
    shown = scene(report)
    items = {item.name: item for item in shown.items}
    assert np.isnan(items[f"contact {feet[3].name}"].vector).all()
    assert shown.floor is None
    assert np.abs(floor.above(items["floor"].outlines[0])).max() < 0.01


def test_the_page_holds_the_verdict_and_names_can_t_break_out(report):
    page = balance_page(report).decode()
    assert "The robot stands on" in page
    robot, feet, pose = standing("bolt")
    named = [replace(foot, name=f"<b>{foot.name}</b>") for foot in feet]
    evil = balance_page(balance_report(robot, pose=pose, feet=named)).decode()
    assert "<b>FL_FOOT</b>" not in evil
    assert "it tips" in evil


def test_edges_and_points_have_forces_but_no_polygon():
    robot, _, pose = standing("bolt")
    feet = [Foot.of("FL_FOOT", [(0.0, 0.0), (0.05, 0.0)]), Foot.of("FR_FOOT")]
    one = balance_report(robot, pose=pose, feet=feet[1:])
    assert "support" not in {item.name for item in scene(one).items}
    both = balance_report(robot, pose=pose, feet=feet)
    assert "support" in {item.name for item in scene(both).items}
    assert balance_page(both)
