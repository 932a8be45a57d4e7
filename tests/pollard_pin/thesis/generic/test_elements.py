"""Lines that name a matrix's elements are held where no element vanishes."""

import numpy as np
import pytest

from pollard_pin.thesis.audit import THESIS
from pollard_pin.thesis.generic.elements import Elements
from thesis_pin.equations.formula import FormulaError, Symbol

from ..conftest import value, verdict

EQUATIONS = THESIS.catalogue()
GROUND = THESIS.ground(EQUATIONS)
NAMED = ["2.4.4:2.26", "2.4.4:2.30", "2.4.6:2.44", "2.7.4:2.110", "2.7.5:2.119", "2.7.6:2.128"]


@pytest.mark.parametrize("name", NAMED)
def test_an_element_of_a_transforms_last_row_can_not_change_unseen(name):
    equation = EQUATIONS[f"pollard:{name}"]
    assert verdict(GROUND, equation) == "holds"
    (text,) = equation.printed
    letter = text.split("_{11}")[0][-1]
    for place in ("41", "34") if f"{letter}_{{41}}" in text else ("34", "33"):
        for changed in (f"-{letter}_{{{place}}}", f"2 {letter}_{{{place}}}", f"{letter}_{{42}}"):
            slipped = text.replace(f"{letter}_{{{place}}}", changed)
            assert slipped != text
            assert (
                verdict(GROUND, equation.model_copy(update={"printed": (slipped,)}))
                == "unexplained"
            )


@pytest.mark.parametrize("name", ["b_{41}", "a_{51}", "a", r"\dot{a}_{41}", "a_{41}^0"])
def test_nothing_but_an_element_of_the_matrix_is_one(name):
    symbols = Elements(Symbol("A", bold=True), "a", transform=True)
    np.testing.assert_array_equal(value("a_{41}", symbols), np.zeros(4))
    np.testing.assert_array_equal(value("a_{44}", symbols), np.ones(4))
    with pytest.raises(FormulaError, match="isn't an element"):
        value(name, symbols)


def test_no_other_line_is_held_to_free_elements():
    found = [
        equation.id.removeprefix("pollard:")
        for equation in EQUATIONS.equations
        if any(isinstance(free.environment, Elements) for free in GROUND.substituted(equation))
    ]
    assert found == NAMED
