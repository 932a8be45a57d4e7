"""Which groups are shown at first."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput
from thesis_pin.pages.film.chosen import chosen
from thesis_pin.pages.scene import Group, Scene

SCENE = Scene(
    "three",
    "Nothing.",
    np.array([0.0, 1.0]),
    (Group("robot", "the robot"), Group("zmp", "ZMP"), Group("torques", "torques", visible=False)),
    (),
)


@pytest.mark.parametrize(
    ("show", "hide", "expected"),
    [
        ((), (), [True, True, False]),
        (("torques",), ("zmp",), [True, False, True]),
        (("all",), (), [True, True, True]),
        (("zmp",), ("all",), [False, True, False]),
        (("all",), ("robot",), [False, True, True]),
    ],
)
def test_groups_are_shown_and_hidden_by_name(show, hide, expected):
    assert [group.visible for group in chosen(SCENE, show, hide).groups] == expected
    assert [group.visible for group in SCENE.groups] == [True, True, False]


def test_an_unknown_group_names_those_there_are():
    with pytest.raises(BadInput, match=r"unknown group 'shadows'.*robot, zmp, torques, all"):
        chosen(SCENE, ["shadows"])


@pytest.mark.parametrize("name", ["zmp", "all"])
def test_a_group_that_is_shown_and_hidden_is_a_contradiction(name):
    with pytest.raises(BadInput, match="shown and hidden"):
        chosen(SCENE, [name], [name])
