"""What a notebook shows of an object: the answer first, few rows, nothing unescaped."""

import re
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import ROWS, SENTENCES, Cell, attributes, html, of_value

EVIL = "<script>alert('x')</script>\"&"


@dataclass(frozen=True)
class Leg(Brief):
    """A leg of :class:`~some.where.Robot`.

    Attributes:
        name: Its name.
        lengths: Of thigh and shank [m],
            shape ``(2,)``.
        low, high: Its limits [rad].

    Nothing: of this.
    """

    name: str
    lengths: np.ndarray
    low: float = 0.0
    high: float = 1.0


def test_meanings_come_from_the_docstring():
    assert attributes(Leg) == {
        "name": "Its name.",
        "lengths": "Of thigh and shank [m], shape (2,).",
        "low": "Its limits [rad].",
        "high": "Its limits [rad].",
    }


def test_an_object_becomes_a_table_of_its_values():
    text = Leg("left", np.array([0.25, 0.5]))._repr_html_()
    assert "Leg left: A leg of Robot." in text
    assert re.search(r">lengths</td>.*>0.25, 0.5</td>.*>Of thigh and shank \[m\]", text)


def test_everything_is_escaped():
    cell = Cell(EVIL, [EVIL], True, (EVIL,), [(EVIL,)], note=EVIL)
    for text in (html(cell), Leg(EVIL, np.zeros(2))._repr_html_()):
        assert "<script" not in text
        assert "alert(&#x27;x&#x27;)" in text


def test_long_tables_and_answers_say_how_much_is_left_out():
    rows = [(f"row {k}", str(k)) for k in range(ROWS + 5)]
    text = html(Cell("many", [f"It is {k}." for k in range(SENTENCES + 2)], None, ("a", "b"), rows))
    assert "… 5 more rows" in text
    assert "… 2 more sentences" in text
    assert f"row {ROWS - 1}<" in text
    assert f"row {ROWS}<" not in text
    assert text.index("It is 0.") < text.index("row 0<")


def test_arrays_are_told_by_shape_range_and_gaps():
    assert of_value(np.array([[1.0, np.nan], [-2.0, 7.0]])) == "2×2: -2 to 7, 1 not finite"
    assert of_value(np.array([True, False, True])) == "3: 2 yes"
    assert of_value(np.full(9, np.nan)) == "9: no number, 9 not finite"
    assert of_value(("hip", "knee")) == "hip, knee"
