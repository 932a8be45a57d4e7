"""Motions of very many samples: the same numbers, kept shorter."""

import numpy as np

import pollard_pin


def test_very_many_samples_have_the_numbers_of_few(pollard):
    """Long motions, solutions and torques are worked out in blocks, and kept shorter."""
    path = pollard_pin.appendix_b()
    count = 66_001
    long, few = path.sample(count), path.at(np.linspace(0.0, path.duration, count)[::1000])
    for name in ("time", "pose", "rate", "acceleration"):
        np.testing.assert_allclose(getattr(long, name)[::1000], getattr(few, name), atol=1e-12)
    one, other = (pollard_pin.joint_trajectory(pollard, motion) for motion in (long, few))
    np.testing.assert_allclose(one.a[::1000], other.a, atol=1e-9)
    found, expected = (
        pollard_pin.inverse_dynamics(pollard, motion, joints)
        for motion, joints in ((long, one), (few, other))
    )
    for name in ("torque", "loop_force", "joint_force"):
        np.testing.assert_allclose(getattr(found, name)[::1000], getattr(expected, name), atol=1e-9)
    for name in ("position_residual", "rotation_residual", "loop_residual"):
        assert getattr(one.solutions, name).max() < 1e-12
