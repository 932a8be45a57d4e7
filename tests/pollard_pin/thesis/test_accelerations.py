"""Second derivatives of the audit's references, and what the thesis's failures rest on."""

from dataclasses import replace

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import states
from pollard_pin.thesis.explicit import ANGLES, ExplicitModel
from pollard_pin.thesis.references import OpenReferences
from pollard_pin.thesis.state import POSE
from pollard_pin.thesis.symbols.accelerations import Circle, accelerating, coefficient
from pollard_pin.thesis.symbols.loops import side

from ..conftest import closed_motion
from .conftest import base_frame
from .conftest import value as value_of


@pytest.fixture(scope="module")
def opened():
    return states(closed=False)


def value(formula, state, i=""):
    return value_of(formula, OpenReferences(state), i=i)


def test_derivatives_on_the_circle_are_those_of_calculus(opened):
    circle = Circle(opened, "")
    angle = circle.state.variables["theta_43"]
    theta, rate, bend = (
        given["theta_43"] for given in (opened.variables, opened.rates, opened.accelerations)
    )
    found = [circle.derivative(np.cos(angle) ** 2, order) for order in (0, 1, 2)]
    double = [np.sin(2 * theta), np.cos(2 * theta)]
    np.testing.assert_allclose(found[0], np.cos(theta) ** 2, atol=1e-14)
    np.testing.assert_allclose(found[1], -rate * double[0], atol=1e-13)
    np.testing.assert_allclose(found[2], -bend * double[0] - 2 * rate**2 * double[1], atol=1e-12)


def test_circles_are_as_exact_for_fast_states(opened):
    fast = replace(opened, rates={name: 1e3 * rate for name, rate in opened.rates.items()})
    circle = Circle(fast, "")
    theta, rate, bend = (
        given["theta_54"] for given in (fast.variables, fast.rates, fast.accelerations)
    )
    expected = -bend * np.sin(theta) - rate**2 * np.cos(theta)
    found = circle.derivative(np.cos(circle.state.variables["theta_54"]), 2)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())


def test_references_on_the_closed_mechanism_give_the_models_accelerations(robot, rng):
    poses, rate, acceleration, _, _, expected = closed_motion(robot, rng, 20)
    state = ExplicitModel(robot.specification).references(poses, rate, acceleration).state
    found = accelerating(state).accelerations
    actual = np.stack([found[name] for name in ANGLES], axis=-1)
    np.testing.assert_allclose(actual, expected, atol=1e-9 * np.abs(expected).max())


def test_the_last_coefficient_is_all_that_the_poses_acceleration_leaves(opened):
    """Linear in the joints' accelerations, and the pose's own do not enter."""
    pushed = {**opened.accelerations, **{name: np.full(opened.size, 9.0) for name in POSE}}
    for name in ("G_14", "G_30", "G_46", "G_76"):
        rest = coefficient(opened, name, "1")
        same = coefficient(replace(opened, accelerations=pushed), name, "1")
        np.testing.assert_allclose(rest, same, atol=1e-11 * np.abs(rest).max())
        still, doubled = (
            coefficient(
                replace(opened, accelerations={k: f * v for k, v in opened.accelerations.items()}),
                name,
                "1",
            )
            for f in (0.0, 2.0)
        )
        np.testing.assert_allclose(rest - still, doubled - rest, atol=1e-10 * np.abs(rest).max())


def test_the_second_derivative_of_a_vector_is_that_of_calculus(opened):
    """The forearm x_32 along the x axis of a frame that θ21 turns about y."""
    theta, rate, bend = (
        one["theta_21"] for one in (opened.variables, opened.rates, opened.accelerations)
    )
    sine, cosine = np.sin(theta), np.cos(theta)
    expected = np.stack(
        [-cosine * rate**2 - sine * bend, 0 * theta, sine * rate**2 - cosine * bend], axis=-1
    )
    expected *= opened.constants["x_32"][:, None]
    np.testing.assert_allclose(value(r"\ddot{\mathbf{r}}_{32}", opened), expected, atol=1e-10)


def in_base_frame(state):
    """X and Z as (2.20) prints them, and their first and second derivatives."""

    circle = Circle(state, "")
    x, _, z = base_frame(circle.state)
    return [[circle.derivative(v, k) for v in (x, z)] for k in (1, 2)]


def test_the_second_derivatives_of_X_and_Z_fail_because_220_is_in_the_base_frame(opened):
    """With the base frame's, and the dot that ψ lost, (2.79) is right."""
    _, expected = in_base_frame(opened)
    for letter, lost, mended, right in (
        ("X", r"\dot{\psi}s\psi", r"\ddot{\psi}s\psi", expected[0]),
        ("Z", r"- \dot{\psi}c\psi", r"- \ddot{\psi}c\psi", expected[1]),
    ):
        (text,) = catalogue()[f"pollard:2.6.2:ddot_{letter}"].printed
        assert text.count(lost) == 1
        np.testing.assert_allclose(value(text.replace(lost, mended), opened), right, atol=1e-11)


def test_G_14_and_G_22_fail_because_220_is_in_the_base_frame(opened):
    """They are (2.78) and (2.81) with X and Z in one frame and their derivatives in another."""
    state = replace(
        opened,
        accelerations={**opened.accelerations, **dict.fromkeys(POSE, np.zeros(opened.size))},
    )
    (x1, z1), (x2, z2) = in_base_frame(state)
    x, y, z = side(state, 2)[:, :3].T
    theta, rate, bend = (
        given["theta_43"] for given in (state.variables, state.rates, state.accelerations)
    )
    c, s = np.cos(theta), np.sin(theta)
    (text,) = catalogue()["pollard:E:G_14"].printed
    expected = -z2 * c - x2 * s + 2 * rate * (z1 * s - x1 * c) + rate**2 * (z * c + x * s)
    slip = r"+ 2 \dot{\theta} \dot{\psi} x_"
    text = text.replace(slip, slip.replace("psi", "phi"), 1)
    np.testing.assert_allclose(value(text, opened), expected, atol=1e-10)

    circle = Circle(state, "")
    y1, y2 = (circle.derivative(side(circle.state, 2)[:, 1], order) for order in (1, 2))
    yaw = state.variables["theta_54"]
    above = -2 * x1 * y1 * x * c + y2 * x**2 * c + 2 * x1**2 * y * c - x2 * x * y * c
    above += -(rate**2) * x**2 * y * c - 2 * y1 * rate * x**2 * s
    above += 2 * x1 * rate * x * y * s - bend * x**2 * y * s
    expected = np.cos(yaw) ** 2 * above - 2 * state.rates["theta_54"] ** 2 * x**3 * np.tan(yaw)
    (text,) = catalogue()["pollard:E:G_22"].printed
    np.testing.assert_allclose(value(text + ")", opened), expected, atol=1e-10)


def side_in_base_frame(state, i):
    """First and second derivatives of X_i, Y_i, Z_i without the turn by θ21i, as in (2.163)."""
    circle = Circle(state, i)
    still = circle.state.with_(**{f"theta_21{i}": np.zeros(circle.state.size)})
    x, y, z = side(still, 4, i)[:, :3].T
    angle, arm, tilt = (
        circle.state.number(f"{name}{i}") for name in ("theta_21", "x_43", "beta_54")
    )
    moved = (
        x - arm * np.cos(angle),
        y - np.cos(tilt) * arm * np.sin(angle),
        z + np.sin(tilt) * arm * np.sin(angle),
    )
    return [[circle.derivative(v, order) for v in moved] for order in (1, 2)]


def mended(identity, *edits):
    """The printed member after edits, each of which must find its place."""
    (text,) = catalogue()[identity].printed
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new)
    return text


G_60 = (
    (
        r"\dot{\theta}_{65}^2 (c \theta_{65i} z_{32}",
        r"\dot{\theta}_{65i}^2 c \theta_{65i} (z_{32i}",
    ),
    (r"\dot{\theta}_{65}", r"\dot{\theta}_{65i}"),
    ("y_{10} c", "y_{10i} c"),
    ("x_{1211} c", "x_{1211i} c"),
    ("x_{43}", "x_{43i}"),
    (r"\dot{\theta}_{21}^2 x_{43i}", r"\dot{\theta}_{21i}^2 x_{43i}"),
    (r"(\dot{\theta}_{21}^2 c \theta_{21i}", r"(\dot{\theta}_{21i}^2 c \theta_{21i}"),
    (r"\ddot{\theta}_{21} s \theta_{21i}", r"\ddot{\theta}_{21i} s \theta_{21i}"),
    (r"c \beta_{1413i} - \theta_{54})", r"c(\beta_{1413i} - \theta_{54})"),
    (r"s \beta_{1413i} - \theta_{54})", r"s(\beta_{1413i} - \theta_{54})"),
    (r"s \theta_{54} s \theta_{65i}", r"s \theta_{54}) s \theta_{65i}"),
)


@pytest.mark.parametrize("i", "12")
def test_G_60_fails_because_the_differences_are_in_the_base_frame(opened, i):
    """With its lost i and brackets it is (2.162) with X and Z in one frame, rates in another."""
    text = mended("pollard:E:G_60", *G_60)
    (x1, _, z1), (x2, _, z2) = side_in_base_frame(opened, i)
    x, _, z = side(opened, 4, i)[:, :3].T
    theta, rate = (given[f"theta_65{i}"] for given in (opened.variables, opened.rates))
    c, s = np.cos(theta), np.sin(theta)
    expected = -z2 * c - x2 * s + 2 * rate * (z1 * s - x1 * c) + rate**2 * (z * c + x * s)
    np.testing.assert_allclose(value(text, opened, i), expected, atol=1e-10)
