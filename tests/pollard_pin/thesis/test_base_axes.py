"""X and Z along the base's axes: what the thesis differentiates, and what is then right in it."""

import numpy as np
import pytest

from pollard_pin.thesis import catalogue
from pollard_pin.thesis.audit import states
from pollard_pin.thesis.generic.coefficients import Coefficients
from pollard_pin.thesis.references import OpenReferences
from pollard_pin.thesis.symbols.loops import in_base_axes, side
from thesis_pin.audit.comparison.places import places
from thesis_pin.audit.judging.verdicts import residual
from thesis_pin.equations.values import STEP

OPEN = states(closed=False)
RATES = in_base_axes(OPEN)
PLACES = in_base_axes(OPEN, places=True)
FRAMES = [e for e in catalogue().equations if e.cause == "base-frame"]
NOT_ONLY = [e for e in catalogue().equations if e.misread]


def ground(equation):
    """(2.12) and (2.20) print the places along the base's axes, all others only their rates."""
    if equation.section == "2.4.2":
        return OpenReferences(PLACES)
    return Coefficients(RATES) if equation.closed else OpenReferences(RATES)


def as_meant(equation):
    """The members with all slips mended but that of the statement."""
    return [equation.misread.get(k, text) for k, text in enumerate(equation.printed, start=1)]


@pytest.mark.parametrize("equation", FRAMES, ids=lambda equation: equation.id)
def test_every_line_blamed_on_the_frame_is_right_in_the_frame_of_220(equation):
    found = residual(catalogue(), equation, as_meant(equation), ground(equation), equation.left)
    assert found.value < 1e-11, found.reason


@pytest.mark.parametrize("equation", FRAMES, ids=lambda equation: equation.id)
def test_lines_right_in_every_frame_or_right_without_mending_are_not_given_a_misreading(equation):
    print_ = residual(catalogue(), equation, equation.printed, ground(equation), equation.left)
    assert (print_.value < 1e-11) == (not equation.misread)


def test_the_other_slips_of_a_misread_line_are_counted_in_full():
    """The rates of X_i and Y_i have lost five and six dots, besides the brackets after c and s."""
    lost = {
        "2.8.2:dot_X_i": 5,
        "2.8.2:dot_Y_i": 6,
        "2.8.2:dot_Z_i": 0,
        "2.5.2:dot_X": 1,
    }
    for identity, dots in lost.items():
        equation = catalogue()[f"pollard:{identity}"]
        (before,), (after,) = equation.printed, equation.misread.values()
        assert after.count("dot{") - before.count("dot{") == dots
    swapped = catalogue()["pollard:2.4.5:2.39"]
    assert len(places(swapped.printed[0], swapped.misread[1])) == 2
    assert {e.id.split(":", 1)[1] for e in NOT_ONLY} >= {"E:G_14", "E:G_22", "E:G_60", "E:G_68"}


def test_the_values_stay_and_only_what_is_made_by_differentiating_changes():
    for k, i in ((2, ""), (4, "1"), (4, "2")):
        np.testing.assert_allclose(side(RATES, k, i), side(OPEN, k, i), atol=1e-13)
        assert np.abs(side(PLACES, k, i) - side(OPEN, k, i)).max() > 0.1
        moved = [np.imag(side(s.step(dict(OPEN.rates)), k, i)) / STEP for s in (RATES, PLACES)]
        np.testing.assert_allclose(*moved, atol=1e-12)


def test_the_places_are_those_of_the_wrist_less_the_shoulders_turned_arm():
    theta, number = OPEN.variables["theta_21"], OPEN.number
    wrist = OPEN.transform("T_LD0")[:, :3, 3]
    expected = wrist - np.stack(
        [
            number("x_32") * np.cos(theta),
            0 * theta,
            number("z_10") - number("x_32") * np.sin(theta),
        ],
        axis=-1,
    )
    np.testing.assert_allclose(side(PLACES, 2)[:, :3], expected, atol=1e-13)
