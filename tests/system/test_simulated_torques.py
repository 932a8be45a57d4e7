"""Torques of a caller's own in a simulation: refused where they can't be used."""

import numpy as np
import pytest

import pollard_pin
from thesis_pin.errors import BadInput

POLLARD = pollard_pin.load()
POSE = [0.45, 0.0, 0.1, 0.0, 0.0, 0.0]
Q, V, _ = POLLARD.joint_motion(POSE, np.full(6, 0.1), np.zeros(6))

TORQUES = {
    "too few": (lambda *_: np.zeros(5), r"at t = 0 s has shape \(5,\); allowed: \(6,\)"),
    "a stack": (lambda *_: np.zeros((1, 6)), r"has shape \(1, 6\)"),
    "NaN": (lambda *_: np.full(6, np.nan), "isn't finite"),
    "nothing": (lambda *_: None, r"has shape \(\)"),
    "text": (lambda *_: "x", "isn't an array of numbers"),
    "takes no arguments": (lambda: 0, "t = 0 s: torque.* fails: TypeError"),
    "raises": (lambda *_: 1 / 0, "t = 0 s: torque.* fails: ZeroDivisionError: division"),
}


@pytest.mark.parametrize("name", TORQUES)
def test_torques_a_simulation_cannot_use_are_refused_with_the_time(name):
    torque, says = TORQUES[name]
    with pytest.raises(BadInput, match=says):
        POLLARD.simulate(Q, np.zeros(12), torque, 2e-3)


def test_an_error_of_ours_inside_the_torques_comes_out_as_it_is():
    def torque(*_):
        raise BadInput("out of battery")

    with pytest.raises(BadInput, match=r"^out of battery$"):
        POLLARD.simulate(Q, np.zeros(12), torque, 2e-3)


def test_torques_that_write_into_q_do_not_change_the_motion():
    def meddling(_, q, v):
        q[:], v[:] = 0, 0
        return np.zeros(6)

    quiet = POLLARD.simulate(Q, V, lambda *_: np.zeros(6), 2e-3)
    np.testing.assert_array_equal(POLLARD.simulate(Q, V, meddling, 2e-3).q, quiet.q)
