"""What is a foot, and what isn't."""

import numpy as np
import pytest

from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.errors import BadInput, NotFinite, WrongShape


def test_corners_say_what_kind_of_foot_it_is():
    assert Foot.of("f").kind == "point"
    assert Foot.of("f", [(0, 0), (1, 0)]).kind == "edge"
    assert Foot.of("f", [(0, 0), (1, 0), (0, 1)]).kind == "sole"


@pytest.mark.parametrize(
    ("corners", "more", "error"),
    [
        ([(0, 0), (0, 0)], {}, BadInput),
        ([(0, 0), (1, 1), (2, 2)], {}, BadInput),
        ([(0, 0, 0)], {}, WrongShape),
        ([(0, np.nan)], {}, NotFinite),
        ([(0, 0), (1, 0)], {"radius": 0.1}, BadInput),
        ([(0, 0)], {"friction": 0.0}, BadInput),
        ([(0, 0)], {"placement": np.ones((4, 4))}, BadInput),
    ],
)
def test_what_is_no_foot_is_refused(corners, more, error):
    with pytest.raises(error):
        Foot.of("f", corners, **more)
