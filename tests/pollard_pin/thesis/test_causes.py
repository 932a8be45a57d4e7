"""What Pollard's causes explain is so: following each slip gives the printed lines."""

import re

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import states
from pollard_pin.thesis.references import OpenReferences
from pollard_pin.thesis.symbols.loops import frame
from pollard_pin.thesis.symbols.rates import RATES
from thesis_pin.audit.comparison.kinds import of_equation
from thesis_pin.audit.comparison.places import places
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.equations.catalogue import index_values
from thesis_pin.equations.values import STEP
from thesis_pin.numeric.arrays import wrap

from .conftest import base_frame, value

OPEN, CLOSED = (OpenReferences(states(closed=closed)) for closed in (False, True))


def lines(cause):
    found = [equation for equation in catalogue().equations if equation.cause == cause]
    assert found
    return found


def texts(equation):
    """Pairs of printed and corrected texts that differ."""
    if equation.left_printed:
        yield equation.left_printed, equation.left
    for number, text in equation.mending.items():
        yield equation.printed[number - 1], text


def test_with_the_printed_x_and_z_the_tangent_is_that_of_both_angles():
    """arctan(−Z/X) of (2.20) as printed: θ21 + θ43, not θ43."""
    x, z = (value(catalogue()[f"pollard:2.4.2:{name}"].printed[0], CLOSED) for name in "XZ")
    both = CLOSED.state.variables["theta_21"] + CLOSED.state.variables["theta_43"]
    np.testing.assert_allclose(np.sin(both) * x + np.cos(both) * z, 0, atol=1e-12)
    alone = CLOSED.state.variables["theta_43"]
    assert np.abs(np.sin(alone) * x + np.cos(alone) * z).min() > 1e-4


def rate(along):
    """Rate of (2.20)'s X, Y, Z as printed."""
    return np.imag(base_frame(OPEN.state.step(along))) / STEP


def test_the_rates_of_253_are_those_of_the_printed_x_and_z_but_for_a_lost_dot():
    for k, name in ((0, "X"), (2, "Z")):
        printed = catalogue()[f"pollard:2.5.2:dot_{name}"].printed[0]
        dotted = printed.replace(r"\theta_{21}x_{32}", r"\dot{\theta}_{21}x_{32}")
        assert dotted != printed
        found = value(dotted, OPEN)
        np.testing.assert_allclose(found, rate(dict(OPEN.state.rates))[k], atol=1e-12)


@pytest.mark.parametrize(
    ("first", "along"),
    [(8, ("x", "z", "y", "psi", "theta", "phi")), (16, ("x", "y", "z", "psi", "theta", "phi"))],
)
def test_the_accelerations_G_are_made_from_the_printed_x_and_z(first, along):
    """G_8 … G_13 and G_16 … G_21; of (2.80)'s pair G_9, G_10 the print has the places swapped."""
    pitch, yaw = (OPEN.state.variables[name] for name in ("theta_43", "theta_54"))
    x, y = (value(name, OPEN) for name in "XY")
    for k, name in enumerate(along):
        dx, dy, dz = rate({name: 1.0})
        expected = -dz * np.cos(pitch) - dx * np.sin(pitch)
        if first == 16:
            expected = x * (dy * x - dx * y) * np.cos(yaw) ** 2 * np.cos(pitch)
        printed = value(catalogue()[f"pollard:E:G_{first + k}"].printed[0], OPEN)
        np.testing.assert_allclose(printed + 0 * expected, expected, atol=1e-12)


@pytest.mark.parametrize("i", ["1", "2"])
def test_the_side_chains_V_57_differentiates_base_frame_differences(i):
    """dX/dθ21i = x43i sin θ21i and dY/dθ21i = −cos β54i x43i cos θ21i, as (2.138) has them."""
    number = {
        name: OPEN.state.number(f"{name}i", i)
        for name in ("x_43", "beta_54", "theta_21", "theta_65", "theta_76")
    }
    across = -np.cos(number["beta_54"]) * number["x_43"] * np.cos(number["theta_21"])
    along = number["x_43"] * np.sin(number["theta_21"])
    x, y = value("X_i", OPEN, i=i), value("Y_i", OPEN, i=i)
    expected = (
        (across * x - along * y) * np.cos(number["theta_65"]) * np.cos(number["theta_76"]) ** 2
    )
    printed = value(catalogue()["pollard:D:V_57"].printed[0], OPEN, i=i)
    np.testing.assert_allclose(printed, expected, atol=1e-11)


def test_a_plain_arctangent_is_half_a_turn_off_exactly_behind_a_right_angle():
    checked = 0
    for equation in lines("half-circle"):
        if equation.misread:  # (2.39), whose tangent has another sign besides
            continue
        for indices in index_values(catalogue().parse(equation.left)):
            angle = value(equation.left, CLOSED, **indices)
            gap = wrap(value(equation.printed[0], CLOSED, **indices) - angle)
            behind = np.cos(angle) < 0
            assert behind.any()
            np.testing.assert_allclose(np.abs(gap[behind]), np.pi, atol=1e-9)
            np.testing.assert_allclose(gap[~behind], 0, atol=1e-9)
            checked += 1
    assert checked >= 9


def test_taking_the_stray_one_off_is_all_there_is_to_mend():
    for equation in lines("stray-index"):
        for printed, mended in texts(equation):
            assert re.sub(r"_\{(\d{4})1\}", r"_{\1}", printed) == mended


def test_the_loops_without_ball_and_wrist_agree_in_place_and_not_in_orientation():
    for equation in lines("whole-matrices"):
        for indices in index_values(catalogue().parse(equation.left_printed)):
            sides = equation.left_printed, equation.printed[0]
            one, other = (value(side, CLOSED, **indices) for side in sides)
            np.testing.assert_allclose(one[..., 3], other[..., 3], atol=1e-11)
            assert np.abs(one[..., :3, :3] - other[..., :3, :3]).max(axis=(1, 2)).min() > 0.1


def test_only_theta_21_and_theta_21i_are_confused_and_V_59_has_them_right():
    for equation in lines("one-for-i"):
        for printed, mended in texts(equation):
            for place in places(printed, mended):
                assert set(re.findall(r"\\theta_\{\w+\}", place)) == {
                    r"\theta_{21}",
                    r"\theta_{21i}",
                }
    (row,) = (row for row in RATES if row.first == 59)
    for i in "12":
        below, _ = row.relation(OPEN.state, i)
        np.testing.assert_allclose(below, frame(OPEN.state, f"T_LD{i}")[..., 2, 0] ** 2, atol=1e-12)
    assert residual_of("pollard:D:V_59") < 1e-11


def residual_of(identity):
    equation = catalogue()[identity]
    references = CLOSED if equation.closed else OPEN
    return residual(catalogue(), equation, equation.printed, references, equation.left).value


class Renumbered(OpenReferences):
    """V_15 and what follows read as the next ones; that of θ21 with the other sign."""

    def lookup(self, symbol, indices):
        match = re.fullmatch(r"V_(\d+)", symbol.name)
        if not match or int(match[1]) < 15:
            return super().lookup(symbol, indices)
        following = catalogue().notation.symbol(f"V_{{{int(match[1]) + 1}}}")
        found = super().lookup(following, indices)
        return type(found)(-found.array, found.rank) if match[1] == "20" else found


def test_with_every_V_one_higher_and_one_sign_the_print_of_260_is_right():
    references = Renumbered(CLOSED.state)
    for k in (7, 8, 10, 11, 12):
        printed = value(catalogue()[f"pollard:2.5.3:E_{k}"].printed[0], references)
        np.testing.assert_allclose(printed, value(f"E_{{{k}}}", CLOSED), rtol=1e-9, atol=1e-10)


def test_E_9_lacks_just_the_coefficient_of_z_that_258_lacks():
    printed = value(catalogue()["pollard:2.5.3:E_9"].printed[0], Renumbered(CLOSED.state))
    (row,) = (row for row in RATES if row.first == 15)
    _, numerator = row.relation(CLOSED.state, "")
    missing = value("E_9", CLOSED) - printed
    np.testing.assert_allclose(missing, numerator({"z": 1.0}), rtol=1e-8, atol=1e-9)


def bare(text):
    """A formula without brackets, dots, bold letters and spaces."""
    for command in (r"\\d?dot", r"\\(?:mathbf|boldsymbol)"):
        text = re.sub(command + r"\{((?:[^{}]|\{[^{}]*\})*)\}", r"\1", text)
    return re.sub(r"\\(?:left|right)\s*\.?|[()\[\]\s]|\\,", "", text)


@pytest.mark.parametrize(
    ("cause", "mixed"),
    [("lost-arguments", set()), ("lost-dots", set()), ("scanned-brackets", {"C:ddot_c_32"})],
)
def test_but_for_brackets_and_dots_the_print_is_the_correction(cause, mixed):
    """In one line of four thousand characters a letter is wrong besides."""
    for equation in lines(cause):
        found = set(of_equation(equation))
        assert found & {"bracket", "dot"}, equation.id
        assert found <= {"bracket", "dot", "symbol", "index"}, equation.id
        for number, mended in equation.mending.items():
            same = bare(equation.printed[number - 1]) == bare(mended)
            assert same == (equation.id.partition(":")[2] not in mixed), equation.id


def test_the_axis_is_only_an_index_of_the_angle():
    for equation in lines("axis-index"):
        assert re.sub(r"\\theta_[xyz]", r"\\theta", equation.left_printed) == equation.left


@pytest.mark.parametrize(
    ("cause", "pattern"),
    [
        ("offset-along-x", r"z_\{32i\}"),
        ("lost-centre", r"\+ .*(G3'|R_x|B_x).* is missing"),
        ("dotted-J", r"should be \\dot\{J\}"),
        ("both-dotted", r"\\dot\{r\}\S* should be r"),
        ("dotted-axis", r"\\dot\{j\}_[13]\^0 should be j"),
        ("R-for-B", r"R_y should be B_y"),
        ("turned-twice", r"k_\{\w+\}\^0 should be k_\{(\w+)\}\^\{\1\}"),
        ("twice-V1", r"1j\} should be 𝕍'_\{2j\}"),
        ("chain-rule", r"\+.* is missing after ∂|is missing after \+"),
    ],
)
def test_chapter_3s_causes_name_what_every_one_of_their_lines_needs(cause, pattern):
    for equation in lines(cause):
        found = [place for pair in texts(equation) for place in places(*pair)]
        assert any(re.search(pattern, place) for place in found), (equation.id, found)
