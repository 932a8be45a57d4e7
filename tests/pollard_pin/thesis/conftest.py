"""What lines are judged by, and lines with a slip, shared by the tests of Pollard's thesis."""

import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import THESIS, Environments
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.equations.catalogue import Equation


@pytest.fixture(scope="module")
def ground():
    return THESIS.ground(catalogue())


@pytest.fixture(scope="module")
def environments():
    return Environments()


def with_slip(identity: str, old: str, new: str) -> Equation:
    """A line with a piece of its members replaced, once in each."""
    equation = catalogue()[f"pollard:{identity}"]
    printed = tuple(text.replace(old, new, 1) for text in equation.printed)
    assert printed != equation.printed
    return equation.model_copy(update={"printed": printed})


def verdict(ground, equation, here=None, free=None):
    """The verdict on a line: where it has to hold, and where what it takes as given is free."""
    here = ground.references(equation) if here is None else here
    free = ground.substituted(equation) if free is None else free
    return judge(catalogue(), equation, here, ground.claims, "", free).verdict
