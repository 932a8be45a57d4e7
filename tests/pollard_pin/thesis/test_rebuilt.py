"""Lost lines of the Pollard thesis: what is rebuilt follows from what is printed elsewhere."""

from __future__ import annotations

import numpy as np
import pytest

from pollard_pin.thesis.audit import Environments, audit
from pollard_pin.thesis.catalogue import catalogue
from thesis_pin.equations.editions import EditionEnvironment
from thesis_pin.equations.formula import Symbol

LOST = tuple(equation for equation in catalogue().equations if equation.illegible)


def test_every_line_says_where_it_begins():
    assert [e.id for e in catalogue().equations if not e.line] == []


def test_every_lost_line_is_rebuilt_and_says_from_what():
    assert len(LOST) == 36
    report = audit(only=[equation.id for equation in LOST])
    assert {row.verdict for row in report.rows} == {"rebuilt"}
    assert all(row.note.startswith("rebuilt: ") and row.reason for row in report.rows)
    assert max(row.residual_corrected for row in report.rows) < 1e-12


@pytest.mark.parametrize(
    ("name", "right", "slip"),
    [
        ("C:ddot_d_31", r"2 \dot{\theta}_{54}", r"3 \dot{\theta}_{54}"),
        ("D:V_55", r"s \theta_{43}", r"c \theta_{43}"),
        ("E:G_92", r"\ddot{f}_{11}", r"\ddot{f}_{21}"),
        ("3.3.2:3.96", r"\mathbf{B}_z(\theta_{54})", r"\mathbf{R}_z(\theta_{54})"),
    ],
)
def test_a_slip_in_a_rebuilt_line_is_not_called_rebuilt(name, right, slip):
    whole = catalogue()[f"pollard:{name}"]
    assert right in whole.rebuilt[0]
    changed = (whole.rebuilt[0].replace(right, slip, 1), *whole.rebuilt[1:])
    other = catalogue().with_equation(whole.model_copy(update={"rebuilt": changed}))
    assert audit(other, only=[whole.id]).rows[0].verdict == "unexplained"


@pytest.mark.parametrize("letter", ["c_22", "d_31", "d_32", "e_31", "e_33", "f_11", "f_21"])
def test_a_rebuilt_second_derivative_is_what_the_first_one_changes_by(letter):
    """The complex step goes through the printed or rebuilt first derivative, not the second."""
    closed = Environments().closed
    first = Symbol(letter[0], letter[2:], dots=1)
    indices = {} if letter[0] == "c" else {"i": "2"}
    followed = EditionEnvironment(catalogue(), closed).lookup(
        Symbol(letter[0], letter[2:], dots=2), indices
    )
    stepped = EditionEnvironment(catalogue(), closed.moved(None)).lookup(first, indices)
    rate = np.imag(stepped.array) / 1e-30
    np.testing.assert_allclose(followed.array, rate, rtol=1e-9, atol=1e-9)
