"""Commands of servos that give way, worked out by hand."""

import numpy as np
import pytest

from scout_pin.study.servo import ServoGains, sag_compensated
from thesis_pin.errors import BadInput, WrongShape


def test_a_command_is_ahead_by_the_torque_over_the_stiffness():
    # 0.4 N·m at 20 N·m/rad is 0.02 rad; 2 rad/s damped by 0.05 + 0.15 adds 0.4 N·m, 0.02 rad
    # again; 10 rad/s² of 0.002 kg·m² 0.02 N·m, 0.001 rad.
    found = sag_compensated(
        [[0.1]], [[2.0]], [[10.0]], [[0.4]], ServoGains(20.0, 0.05), damping=0.15, armature=0.002
    )
    np.testing.assert_allclose(found, [[0.141]], rtol=1e-14)


def test_a_servo_at_its_command_gives_the_torque():
    rng = np.random.default_rng(3)
    q, v, a, torque = rng.normal(size=(4, 5, 12))
    gains = ServoGains(31.0, 0.2)
    command = sag_compensated(q, v, a, torque, gains)
    np.testing.assert_allclose(gains.stiffness * (command - q) - gains.damping * v, torque)


@pytest.mark.parametrize("gains", [(0.0, 0.05), (-1.0, 0.05), (20.0, -0.1), (float("nan"), 0.0)])
def test_servos_that_nobody_has_are_refused(gains):
    with pytest.raises(BadInput, match="servos'"):
        ServoGains(*gains)


def test_arrays_of_other_shapes_are_refused():
    zero = np.zeros((3, 12))
    with pytest.raises(WrongShape, match="torque"):
        sag_compensated(zero, zero, zero, zero[:2], ServoGains())
