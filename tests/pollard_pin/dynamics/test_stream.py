"""A path in blocks gives what the whole gives."""

import numpy as np
import pytest

import pollard_pin
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.motion.curves import line
from pollard_pin.motion.trajectory import joint_trajectory


def test_blocks_are_the_whole_path_in_pieces(pollard):
    path = pollard_pin.appendix_b()
    motion = path.sample(333)
    joints = joint_trajectory(pollard, motion)
    whole = inverse_dynamics_at(pollard, joints.q, joints.v, joints.a)
    found = list(pollard_pin.torque_blocks(pollard, path, motion.time, size=50))
    assert [block.first for block in found] == list(range(0, 333, 50))
    for expected, parts in (
        (motion.time, [b.motion.time for b in found]),
        (motion.acceleration, [b.motion.acceleration for b in found]),
        (joints.q, [b.joints.q for b in found]),
        (joints.v, [b.joints.v for b in found]),
        (joints.a, [b.joints.a for b in found]),
        (whole.torque, [b.dynamics.torque for b in found]),
        (whole.loop_force, [b.dynamics.loop_force for b in found]),
    ):
        np.testing.assert_allclose(np.concatenate(parts), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("size", [7, 50])
def test_angles_that_pass_half_a_turn_go_on_from_block_to_block(pollard, size):
    start, end = np.array([[0.45, 0.0, 0.1, 0.0, 0.0, turn] for turn in (-2.0, -1.0)])
    path = line(start, end, 1.0)
    times = np.linspace(0.0, 1.0, 100)
    expected = joint_trajectory(pollard, path.at(times)).q
    assert (np.abs(expected) > np.pi).any()
    blocks = pollard_pin.torque_blocks(pollard, path, times, size=size)
    found = np.concatenate([block.joints.q for block in blocks])
    np.testing.assert_allclose(found, expected, atol=1e-12)
