"""An object's line in a console: short, named, without addresses or long arrays."""

import functools
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from thesis_pin.display.brief import ROOM, Brief
from thesis_pin.display.line import brief


@dataclass(frozen=True)
class Arm(Brief):
    name: str
    reach: float = 1.0
    samples: np.ndarray = field(default_factory=lambda: np.zeros((5000, 3)))
    note: str = ""


@dataclass(frozen=True)
class Long(Arm):
    words: tuple[str, ...] = ()
    kept: str = "as ever" * 20


def test_arrays_are_told_by_their_shapes():
    assert repr(Arm("left")) == "Arm(name='left', reach=1, samples=array 5000×3, note='')"


def test_what_is_the_default_gives_way_first():
    line = repr(Long("left", reach=2.5, note="x" * 300, words=tuple("abc" * 40)))
    assert len(line) <= ROOM
    assert "reach=2.5" in line
    assert "as ever" not in line


@given(st.lists(st.text(max_size=300), max_size=30), st.text(max_size=500), st.floats())
def test_every_line_is_short(words, note, reach):
    assert len(repr(Long("left", reach=reach, note=note, words=tuple(words)))) <= ROOM


@pytest.mark.parametrize(
    ("value", "line"),
    [
        (0.1 + 0.2, "0.3"),
        (1e-20, "1e-20"),
        (float("nan"), "nan"),
        (np.float64(2.0), "2"),
        (np.array(3.0), "3"),
        (np.zeros(0), "array 0"),
        ((1, 2), "(1, 2)"),
        ([np.zeros(3)] * 4, "list of 4"),
        ({"a": object()}, "dict of 1"),
        (functools.partial(sorted, [2]), "function sorted"),
        (object(), "object"),
        (Arm("left"), "Arm 'left'"),
        ([Arm("left")], "list of 1"),
        ("a" * 99, repr("a" * 58 + " …")),
        (None, "None"),
    ],
)
def test_a_value_in_a_few_letters(value, line):
    assert brief(value) == line
