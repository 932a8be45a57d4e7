"""Checks in code read what is printed: whatever is changed in a line that holds is noticed."""

import re

import numpy as np
import pytest

from scout_pin.thesis import catalogue
from scout_pin.thesis.audit import THESIS
from scout_pin.thesis.claims import angles
from scout_pin.thesis.claims.gait import Numbers
from scout_pin.thesis.claims.law import _law_of_motion as law_of_motion
from scout_pin.thesis.claims.splines import table_rows
from scout_pin.thesis.claims.texts import components, pieces, points, quantity
from scout_pin.thesis.symbols.splines import Splines, spline_coefficients
from thesis_pin.audit.judging.verdicts import judge
from thesis_pin.equations.formula import FormulaError, Symbol


@pytest.fixture(scope="module")
def ground():
    return THESIS.ground(catalogue())


def verdict(ground, equation):
    return judge(
        catalogue(), equation, ground.references(equation), ground.claims, THESIS.name
    ).verdict


def as_it_should_be(identity):
    """An equation with its correction put in as print."""
    equation = catalogue()[identity]
    nothing = {"corrected": {}, "right": {}, "left_printed": "", "misread": {}}
    return equation.model_copy(update={"printed": equation.members("corrected"), **nothing})


SLIPS = [
    ("scout:2:x_31", "left", "x_{31}", "x_{41}"),
    ("scout:2:z_11", "printed", "z", "x"),
    ("scout:3:3.2", "printed", r"\phi_B, \psi_B", r"\psi_B, \phi_B"),
    ("scout:3:3.3", "printed", r"\theta_i", r"\theta_B"),
    ("scout:4:4.1", "left", r"- \frac", r"+ \frac"),
    ("scout:4:4.1", "printed", "+", "-"),
    ("scout:4.7:lagrange_equation_row", "printed", r"+ \Gamma", r"- \Gamma"),
    ("scout:4.7:lagrange_equation_row", "left", r"+ \mathbb{C}", r"- \mathbb{C}"),
    ("scout:4.7:lagrange_equation_vector", "printed", r"+ \boldsymbol", r"- \boldsymbol"),
    ("scout:4.7:lagrange_equation_vector", "left", r"\ddot", r"\dot"),
    ("scout:4.7:lagrange_equation_stacked", "left", r"\mathbb{C}_{16}", r"\mathbb{C}_{15}"),
    ("scout:4.7:lagrange_equation_stacked", "printed", r"\Gamma_7^k", r"\Gamma_8^k"),
    ("scout:4.7:4.23_constraints", "printed", "0", "1"),
    ("scout:4.5:Q#2", "printed", "Q_2", "Q_3"),
    ("scout:4.6.3:Gamma_k", "printed", "{18}", "{17}"),
    ("scout:4.6.1.6:lambda_1", "printed", r"\lambda_2^1", r"\lambda_3^1"),
    ("scout:4.2:lines_announced", "printed", r"\dot{q}_j", "q_j"),
    ("scout:4.3.1:lines_announced", "printed", r"\dot{\mathbf{J}}", r"\mathbf{J}"),
    ("scout:4.5:lines_announced", "printed", r"\tau", r"\omega"),
    ("scout:5:x_B", "printed", "0", "1"),
    ("scout:5:x_B", "left", "x_B", "y_B"),
    ("scout:5:z_B", "printed", "234.37", "234.38"),
    ("scout:5:theta_B", "printed", "0", "1"),
    ("scout:5:x_i", "printed", "-44.54", "44.54"),
    ("scout:5:5.2", "printed", "2.2333", "2.2433"),
    ("scout:5:5.2", "printed", "< 15", "< 16"),
    ("scout:5:5.2", "printed", r"& 0 \leq t", "& 0 < t"),
    ("scout:5:5.2", "printed", r"& 25 \leq", r"& 25 \leq t < 30 \\ 90.76; & 30 \leq"),
    ("scout:5:5.2", "printed", r"\leq 40", "< 40"),
    ("scout:5:5.2", "printed", r"25 \leq t", "25 < t"),
    ("scout:5:5.3", "printed", "- 38.6667", "+ 38.6667"),
    ("scout:5:5.4", "printed", "24t", "42t"),
    ("scout:5:5.5", "printed", "255", "225"),
    ("scout:5:5.6", "printed", r"\frac{2}{5}", r"\frac{2}{3}"),
    ("scout:5:figure_5.2", "printed", "0", "1"),
    ("scout:5:figure_5.2", "left", r"\theta_{2i}", r"\theta_{3i}"),
    ("scout:6.2:ZMP_x_at_rest", "printed", "Tx", "Ty"),
    ("scout:B.2:x_3i", "printed", "74.60", "74.61"),
    ("scout:B.2:l_2", "printed", "127", "126"),
    ("scout:B.3:beta_11", "left", "11", "61"),
    ("scout:B.3:beta_31", "printed", "330", "300"),
    ("scout:B.3:beta_8", "printed", "270", "207"),
    ("scout:B.3:beta", "printed", "= 0", "= 1"),
    ("scout:B.4:soles", "printed", "18.15", "18.51"),
    ("scout:B.4:r_e1^1", "left", "^1", "^2"),
    ("scout:B.4:r_e1^1", "printed", "64.81", "64.18"),
    ("scout:B.4:r_m2^2", "printed", "-26.18", "26.18"),
    ("scout:B.5:m_3i", "printed", "26.67", "26.76"),
    ("scout:B.5:m_T", "printed", "898.54", "898.45"),
    ("scout:B.6:I_41^71", "printed", "4.37", "4.73"),
    ("scout:B.6:I_41^71", "printed", "-6.21", "6.21"),
    ("scout:B.7:r_G52^92", "printed", "- 8.37", "+ 8.37"),
    ("scout:B.7:r_G52^92", "printed", r"\mathbf{i}", r"\mathbf{k}"),
    ("scout:C:C.1", "printed", "t_2 \\", "t_3 \\"),
    ("scout:C.1:C.2", "printed", "b_2 t", "b_3 t"),
    ("scout:C.1:C.3e", "left", "t_{i-1}^2", "t_i^2"),
    ("scout:C.1:C.3h", "printed", "f(t_m)", "f(t_{m-1})"),
    ("scout:C.1:C.4c", "left", "- b_{i+1}", "+ b_{i+1}"),
    ("scout:C.1:C.5", "printed", "0", "1"),
    ("scout:C.1:C.5", "left", "a_1", "a_2"),
    ("scout:C.1:dot_S_2", "printed", "2a_2", "a_2"),
    ("scout:C.1:number_of_equations", "printed", "- 1", "+ 1"),
    ("scout:C.2:node_2", "printed", "84", "48"),
    ("scout:C.2:figure_C.1", "printed", "2.23333", "2.33333"),
    ("scout:D:lengths", "printed", "29.08", "28.09"),
    ("scout:D:beta", "printed", "330°", "300°"),
    ("scout:D:beta_2", "printed", "315°", "351°"),
    ("scout:D:right_sole", "printed", "46.33", "43.66"),
    ("scout:D:y_1", "printed", "77.4", "74.7"),
    ("scout:D:z_2", "printed", "< 15", "< 14"),
    ("scout:D:Out_161_162", "printed", "0.00279586", "0.00279585"),
    ("scout:D:Out_161_162", "printed", r"\mp", r"\pm"),
    ("scout:D:Out_347_358", "printed", "492", "429"),
]  # fmt: skip


@pytest.mark.parametrize(("identity", "side", "old", "new"), SLIPS)
def test_a_slip_planted_in_a_checked_line_is_found(ground, identity, side, old, new):
    equation = as_it_should_be(identity)
    text = equation.left if side == "left" else equation.printed[0]
    assert old in text
    changed = text.replace(old, new, 1)
    update = {"left": changed} if side == "left" else {"printed": (changed,)}
    assert verdict(ground, equation) == "holds"
    assert verdict(ground, equation.model_copy(update=update)) != "holds"


def test_every_digit_of_a_number_counts(ground):
    """Each digit of each line that is one number, made another one."""
    tried = 0
    for equation in catalogue().equations:
        if equation.claim not in ("mass_sum", "vertex", "gait_pose", "twin_centre", "spline_node"):
            continue
        equation = as_it_should_be(equation.id)
        text = equation.printed[0]
        number = next(re.finditer(r"\d+\.?\d*(?! *t)", text.split(r" \times")[0].split("= ")[-1]))
        at = text.index(number[0], len(text) - len(text.split("= ")[-1]) if "= " in text else 0)
        for k in range(at, at + len(number[0])):
            if text[k] == ".":
                continue
            changed = text[:k] + str((int(text[k]) + 1) % 10) + text[k + 1 :]
            found = verdict(ground, equation.model_copy(update={"printed": (changed,)}))
            assert found != "holds", (equation.id, changed)
            tried += 1
    assert tried > 200


def test_corrections_of_checked_lines_hold_when_they_are_what_is_printed(ground):
    mended = [e.id for e in catalogue().equations if e.claim and (e.mending or e.left_printed)]
    assert len(mended) > 15
    for identity in mended:
        assert verdict(ground, catalogue()[identity]) in ("misprint", "wrong"), identity
        assert verdict(ground, as_it_should_be(identity)) == "holds", identity


def test_the_law_of_the_forces_is_two_things_its_text_and_what_it_asks_for(ground):
    equation = catalogue()["scout:4.7:lagrange_equation_forces"]
    assert verdict(ground, equation) == "wrong"
    twisted = equation.right[1].replace(r"\boldsymbol{\tau} +", r"\boldsymbol{\tau} -")
    assert twisted != equation.right[1]
    assert verdict(ground, equation.model_copy(update={"right": {1: twisted}})) == "unexplained"


def test_the_law_of_motion_fails_where_its_left_side_is_not_pinocchio_s():
    equation = catalogue()["scout:4:4.1"]
    found = law_of_motion(catalogue(), lambda: (0.5, "off"), equation)
    assert found.printed == 0.5


# -- how texts are read ---------------------------------------------------------------


def test_a_number_is_read_with_its_unit_and_its_last_digit():
    assert quantity(r"44.54 \times 10^{-3} [m]") == pytest.approx((44.54e-3, 0.005e-3))
    assert quantity(r"330^\circ") == (330.0, 0.5)
    assert quantity(r"234.37[\text{mm}]") == pytest.approx((234.37, 0.005))


@pytest.mark.parametrize("text", ["4 4", "44.54 \\times 10^3", "x", "", "1 [inch]", "3.1.4"])
def test_what_is_no_number_is_refused(text):
    with pytest.raises(FormulaError, match="can't be read"):
        quantity(text)


def test_a_vector_is_read_in_the_axes_it_names():
    text = r"-7.69 \times 10^{-3} \mathbf{j}_B - 0.62 \times 10^{-3} \mathbf{k}_B"
    np.testing.assert_allclose(components(text, "B"), [0, -7.69e-3, -0.62e-3])
    again, unsigned = text.replace(r"\mathbf{k}", r"\mathbf{j}"), text.replace("- 0.62", "0.62")
    for wrong in (text.replace("_B", "_1", 1), again, unsigned, "2"):
        with pytest.raises(FormulaError):
            components(wrong, "B")


def test_points_and_pieces_are_read_whole_or_not_at_all():
    np.testing.assert_array_equal(points("(1, -2.5), (3, 4)"), [[1, -2.5], [3, 4]])
    first, second = pieces(
        r"\begin{cases} t^2 - 3; & 0 \leq t < 2 \\ -\frac{1}{2}t; & 2 < t \end{cases}"
    )
    np.testing.assert_array_equal(first.coefficients, [1, 0, -3])
    np.testing.assert_array_equal(second.coefficients, [0, -0.5, 0])
    assert (first.closed, second.closed, second.end) == ((True, False), (False, False), np.inf)
    for wrong in ("(1, 2) (3, 4)", "(1; 2)"):
        with pytest.raises(FormulaError):
            points(wrong)
    for wrong in ("3t; & 0 < t", r"\begin{cases} 3t + 2t; & 0 < t < 1 \end{cases}"):
        with pytest.raises(FormulaError):
            pieces(wrong)


# -- what they are held against ----------------------------------------------------------


def test_spline_coefficients_are_those_of_a_smooth_curve_through_the_nodes():
    splines = Splines()
    found = spline_coefficients(splines.nodes, splines.values)
    start, end = splines.nodes[:, :-1], splines.nodes[:, 1:]
    a, b, c = np.moveaxis(found, -1, 0)
    np.testing.assert_allclose((a * start + b) * start + c, splines.values[:, :-1], atol=1e-9)
    np.testing.assert_allclose((a * end + b) * end + c, splines.values[:, 1:], atol=1e-9)
    slopes = 2 * a * end + b
    np.testing.assert_allclose(slopes[:, :-1], (2 * a * end + b)[:, :-1])
    np.testing.assert_allclose((2 * a * start + b)[:, 1:], slopes[:, :-1], atol=1e-9)
    np.testing.assert_allclose(a[:, 0], 0.0, atol=1e-12)


@pytest.mark.parametrize("name", ["a_0", "a_99", "b_99", "t_99", "f_99", "dot_a_1", "dot_t_1"])
def test_a_spline_has_the_nodes_and_pieces_it_has_and_they_stand_still(name):
    *dot, base, sub = name.split("_")
    symbol = Symbol(base, sub, dots=len(dot))
    assert Splines().lookup(Symbol(base, "1"), {}).rank == 0
    with pytest.raises(FormulaError, match="defined"):
        Splines().lookup(symbol, {})


def test_the_printed_angles_close_the_printed_gait_and_a_hundredth_of_a_millimetre_shows():
    numbers = Numbers.read(catalogue())
    assert numbers.gap() == 0.0
    for name in numbers.lengths:
        changed = {**numbers.lengths, name: numbers.lengths[name] + 1e-5}
        moved = Numbers(changed, numbers.angles, numbers.pose, numbers.splines)
        assert moved.gap() > 1e-6, name


def test_the_splines_leave_out_the_last_instant_of_the_table():
    last = max(float(row["t"]) for row in table_rows())
    for number in ("5.2", "5.3", "5.5", "5.6"):
        row = catalogue()[f"scout:5:{number}"]
        printed, mended = pieces(row.printed[0]), pieces(row.members("corrected")[0])
        assert not any(piece.has(np.array([last]))[0] for piece in printed)
        assert any(piece.has(np.array([last]))[0] for piece in mended)


def test_an_angle_that_is_off_fails_by_as_many_degrees(ground, monkeypatch):
    degrees, half = angles.printed_angles()
    equation = catalogue()["scout:D:Out_347_358"]
    off = degrees.copy()
    off[7, 3] += 0.25
    monkeypatch.setattr(angles, "printed_angles", lambda: (off, half))
    found = ground.claims[equation.claim](equation).printed
    # The print is rounded to its last digit, and the program's solver stops before the root.
    assert abs(found - 0.25) < 2 * half[7, 3] + 2 * angles.SOLVER


def test_the_sign_of_a_printed_zero_counts_as_its_last_digit(ground):
    equation = catalogue()["scout:B.6:I_31^51"]
    (text,) = equation.printed
    assert text.count("-0.00") == 2
    changed = equation.model_copy(update={"printed": (text.replace("-0.00", "0.00"),)})
    found = ground.claims["twin_inertia"](changed).printed
    assert found == pytest.approx(0.01 / 57.65, rel=1e-9)  # of the twin's largest entry
