"""Messages name the numbers that a hand wouldn't have written."""

import mechanisms as m
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.configurations.culprits import culprits


def leaning(old, new):
    tree, guess = m.four_bar()
    assert tree.joints[2].count(old) == 1
    tree.joints[2] = tree.joints[2].replace(old, new)
    return tree.robot(), guess


def test_an_axis_that_is_not_quite_one_is_named():
    robot, _ = leaning("0.0 0.0 1.0", "4.4e-08 0.0 1.0")
    assert culprits(robot.description) == ("axis 4.4e-08 of rocker_joint",)


def test_an_angle_that_is_not_quite_right_is_named():
    robot, _ = leaning(f"{m.np.pi / 2!r}", "1.5708")
    (words,) = culprits(robot.description)
    assert words == "rpy 1.5708, 3.7e-06 from 90°, of rocker_joint"


def test_round_numbers_are_nobodys_fault():
    assert culprits(m.four_bar()[0].robot().description) == ()
    assert culprits(m.bennett()[0].robot().description) == ()


def test_a_refusal_names_them():
    robot, guess = leaning("0.0 0.0 1.0", "0.005 0.0 1.0")
    with pytest.raises(BadInput, match=r"axis 0\.005 of rocker_joint"):
        loops.close(robot, guess)
