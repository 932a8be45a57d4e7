"""Lines of vectors are held where bases move and offsets lie off the axes, so slips are seen."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.generic.vectors import FreeVectors, definitions
from thesis_pin.audit.judging.residuals import residual
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Symbol

from ..conftest import verdict, with_slip

KNOWN = definitions(catalogue())


def vectors(but=""):
    return FreeVectors(catalogue(), KNOWN, but)


@pytest.mark.parametrize(
    ("identity", "old", "new"),
    [
        ("3.2:v_G1^0", r"\mathbf{v}_{10}^0", r"2 \mathbf{v}_{10}^0"),
        ("3.2:v_G5^0", r"\mathbf{v}_{10}^0 +", ""),
        ("3.4:v_G1i^0", r"+ \mathbf{v}_{32i}^0", r"- \mathbf{v}_{32i}^0"),
        ("3.4:v_32i^0", r"\boldsymbol{\omega}", r"2 \boldsymbol{\omega}"),
        ("3.5.1:dot_k_1i", r"\dot{\mathbf{r}}_{32i}^0", r"2 \dot{\mathbf{r}}_{32i}^0"),
        ("3.5.1:dot_r_32i^0", r"\dot{\mathbf{R}}", r"3 \dot{\mathbf{R}}"),
        ("A:dr_32i/dq_j", r"\mathbf{r}_{32i}^{2i}", r"2 \mathbf{r}_{32i}^{2i}"),
    ],
)
def test_a_slip_in_what_vanishes_on_the_mechanism_is_seen(ground, environments, identity, old, new):
    changed = with_slip(identity, old, new)
    equation = catalogue()[changed.id]
    built = environments.as_built(equation)
    assert verdict(ground, equation, built) == "holds"
    assert verdict(ground, changed, built) == "unexplained"
    assert verdict(ground, changed, built, free=()) == "holds"  # it multiplies what is zero


def test_the_members_that_are_said_to_hold_with_free_vectors_do():
    said = [equation for equation in catalogue().equations if "vectors" in equation.free]
    assert len(said) > 20
    for equation in said:
        only = equation.free["vectors"]
        where = vectors(equation.id)
        found = residual(catalogue(), equation, equation.printed, where, equation.left, only)
        assert len(found.members) == len(only)
        assert found.value < 1e-12, equation.id


def test_a_frames_rotation_turns_at_its_angular_velocity():
    free = vectors()
    rate = free.lookup(Symbol("R", "5", "0", dots=1, bold=True), {}).array
    turned = free.lookup(Symbol("R", "5", "0", bold=True), {}).array
    spin = rate @ np.swapaxes(turned, -1, -2)
    omega = free.lookup(Symbol("omega", "5", "0", bold=True), {}).array
    np.testing.assert_allclose(spin @ omega[..., None], 0, atol=1e-12)
    for column in np.eye(3):
        np.testing.assert_allclose(spin @ column, np.cross(omega, column), atol=1e-12)


def test_a_line_under_test_says_nothing_of_its_own_left_side():
    (loop,) = [equation for equation, _ in KNOWN["r_G1^0", 0]]
    name = Symbol("r", "G1", "0", bold=True)
    made, free = (evaluate(name, vectors(but), {}).array for but in ("", loop.id))
    assert np.abs(made - free).min() > 1e-6


def test_what_isnt_a_vector_is_refused_by_name():
    with pytest.raises(FormulaError, match="L_1 isn't a vector"):
        vectors().lookup(Symbol("L", "1"), {})
