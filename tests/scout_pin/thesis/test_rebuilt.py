"""Lost lines of the Scout thesis: what is rebuilt follows from what is printed elsewhere."""

from __future__ import annotations

import re

import numpy as np
import pytest

from scout_pin.thesis import ExplicitModel
from scout_pin.thesis.audit import audit
from scout_pin.thesis.catalogue import catalogue

LOST = tuple(equation for equation in catalogue().equations if equation.illegible)
UNDER_A_DERIVATIVE = {
    "4.1:W_31": "4.3.4:dot_W_31",
    "4.1:W_41": "4.3.5:dot_W_41",
    "4.1:W_51": "4.3.6:dot_W_51",
    "4.1:W_22": "4.3.3:dot_W_22",
    "4.1:W_61": "4.4.7:dW_61/dq_j",
}


def cells(matrix: str) -> list[str]:
    """Cells of a row of vectors, filled up to 18 with the zero at its end."""
    inside = re.search(r"\\begin\{\w+\}(?:\{c+\})?(.*)\\end", matrix)
    assert inside
    found = [cell.strip() for cell in inside[1].split("&")]
    return found + [r"\mathbf{0}"] * (18 - len(found))


def test_every_line_says_where_it_begins():
    assert [e.id for e in catalogue().equations if not e.line] == []


def test_every_lost_line_is_rebuilt_and_says_from_what():
    assert len(LOST) == 33
    report = audit(only=[equation.id for equation in LOST])
    assert {row.verdict for row in report.rows} == {"rebuilt"}
    assert all(row.note.startswith("rebuilt: ") and row.reason for row in report.rows)
    assert max(row.residual_corrected for row in report.rows) < 1e-12


@pytest.mark.parametrize(("lost", "printed"), UNDER_A_DERIVATIVE.items())
def test_a_matrix_is_the_one_that_the_thesis_prints_under_its_derivative(lost, printed):
    rebuilt, whole = (catalogue()[f"scout:{name}"] for name in (lost, printed))
    assert cells(rebuilt.rebuilt[0]) == cells(whole.printed[0])


def test_what_survives_of_a_line_stands_in_it():
    for equation in LOST:
        for fragment in equation.surviving:
            assert equation.rebuilt[-1].endswith(fragment)


def test_a_slip_in_a_rebuilt_line_is_not_called_rebuilt():
    whole = catalogue()["scout:4.1:W_42"]
    moved = whole.rebuilt[0].replace(r"\mathbf{j}_{22}", r"\mathbf{j}_{21}")
    changed = catalogue().with_equation(whole.model_copy(update={"rebuilt": (moved,)}))
    assert audit(changed, only=[whole.id]).rows[0].verdict == "unexplained"


def test_the_explicit_model_follows_a_rebuilt_line_and_the_print_says_it_is_lost():
    printed = ExplicitModel(edition="printed")
    printed.D(np.full(18, 0.1))
    lost = catalogue()["scout:4.1:W_31"].illegible
    assert printed.substituted["scout:4.1:W_31"] == f"{lost}; what follows from the rest stands in"
    rows = catalogue()["scout:4.1:W_31"].rebuilt[0].replace("k}_{41}", "j}_{21}")
    whole = catalogue()["scout:4.1:W_31"].model_copy(update={"rebuilt": (rows,)})
    followed, changed = ExplicitModel(), ExplicitModel()
    changed.catalogue = catalogue().with_equation(whole)
    q = np.full(18, 0.1)
    assert np.abs(followed.D(q) - changed.D(q)).max() > 1e-6
