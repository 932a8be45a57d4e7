"""Inverse kinematics as a notebook's cell shows it: what is said of numbers made by hand."""

from types import SimpleNamespace

import numpy as np

from thesis_pin.report.cells import solutions_cell

NAMES, JOINTS = ("up", "down", "out"), ("hip", "knee")


def test_one_pose_has_its_branches_in_degrees_the_valid_ones_first():
    found = SimpleNamespace(
        valid=np.array([False, True, False]),
        reachable=np.array([True, True, False]),
        angles=np.array([[np.pi / 2, 0.0], [np.pi / 6, -np.pi], [np.nan, np.nan]]),
    )
    cell = solutions_cell(found, "Leg", NAMES, JOINTS)
    assert cell.rows == [
        ("down", "within limits", "30.00", "-180.00"),
        ("up", "beyond limits", "90.00", "0.00"),
        ("out", "out of reach", "–", "–"),
    ]
    assert cell.good is True
    assert cell.said == ["1 of 3 branches reaches the pose within the joints' limits."]


def test_several_poses_are_counted_branch_by_branch():
    found = SimpleNamespace(
        valid=np.array([[True, False, False], [True, False, False], [False, False, False]]),
        reachable=np.array([[True, True, False], [True, False, False], [True, False, False]]),
        angles=np.zeros((3, 3, 2)),
    )
    cell = solutions_cell(found, "Leg", NAMES, JOINTS)
    assert cell.rows == [("up", "2", "3"), ("down", "0", "1"), ("out", "0", "0")]
    assert cell.good is False
    assert cell.said == ["2 of 3 poses are reached within the joints' limits."]
