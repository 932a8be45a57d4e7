"""Scenes hold what they say, and refuse what no page could show."""

import numpy as np
import pytest

from thesis_pin.errors import BadInput, NotFinite, UnknownName, WrongShape
from thesis_pin.pages import scene

TIME = np.linspace(0.0, 1.0, 5)
GROUPS = (scene.Group("a", "all"),)


def ball(**changes):
    given = {
        "name": "ball",
        "group": "a",
        "position": np.zeros((5, 3)),
        "radius": 0.1,
        "colours": ("#000000",),
    }
    return scene.Ball(**given | changes)


def made(*items, **changes):
    given = {"title": "t", "description": "d", "time": TIME, "groups": GROUPS, "items": items}
    return scene.Scene(**given | changes)


@pytest.mark.parametrize(
    ("changes", "error", "says"),
    [
        ({"items": (ball(position=np.zeros((4, 3))),)}, WrongShape, "position of item 'ball'"),
        ({"items": (ball(position=np.full((5, 3), np.inf)),)}, NotFinite, "index (0, 0)"),
        ({"items": (ball(level=np.zeros(4)),)}, WrongShape, "level"),
        ({"items": (ball(group="b"),)}, UnknownName, "unknown group 'b'"),
        ({"items": (ball(), ball())}, BadInput, "two items are called 'ball'"),
        ({"time": TIME[::-1]}, BadInput, "increase strictly"),
        ({"time": np.array([0.0])}, WrongShape, "at least 2"),
        ({"readouts": (scene.Readout("x", np.zeros(3)),)}, WrongShape, "readout 'x'"),
    ],
)
def test_what_no_page_could_show_is_refused_with_item_and_array(changes, error, says):
    with pytest.raises(error) as found:
        made(**changes)
    assert says in str(found.value)


def test_thinning_keeps_both_ends_and_short_motions_whole():
    assert scene.thinned(np.arange(5.0), 10).tolist() == [0, 1, 2, 3, 4]
    some = scene.thinned(np.linspace(0, 4, 10001), 1201)
    assert (some[0], some[-1], len(some)) == (0, 10000, 1201)


def test_both_sides_of_an_instant_are_one_moment_to_a_page():
    time = np.array([0.0, 1e-9, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 2.0 - 1e-9, 2.0])
    assert scene.thinned(time, 10).tolist() == [0, 2, 6]
