"""Formulas, lines with a slip and what lines are judged by, for the tests of Pollard's thesis."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import THESIS, Environments
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.equations.catalogue import Equation
from thesis_pin.equations.evaluation import evaluate


@pytest.fixture(scope="module")
def ground():
    return THESIS.ground(catalogue())


@pytest.fixture(scope="module")
def environments():
    return Environments()


def value(text, symbols, **indices):
    """What a formula is where its symbols are what an environment says, of a chain if it has i."""
    return evaluate(catalogue().parse(text), symbols, {k: v for k, v in indices.items() if v}).array


def base_frame(state):
    """X, Y, Z as (2.20) prints them: the wrist less the elbow, in the base's axes."""
    wrist = state.transform("T_LD0")[..., :3, 3]
    theta = state.variables["theta_21"]
    x = wrist[..., 0] - state.constants["x_32"] * np.cos(theta)
    z = wrist[..., 2] - state.constants["z_10"] + state.constants["x_32"] * np.sin(theta)
    return np.stack([x, wrist[..., 1], z])


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
