"""How far a leg is from its singularities."""

import numpy as np
import pytest

from scout_pin.kinematics.singularity import leg_conditioning


@pytest.mark.parametrize("side", ["left", "right"])
def test_conditioning_is_that_of_the_finite_difference_jacobian(biped, side, rng):
    leg, step = biped.legs[side], 1e-6
    theta = rng.uniform(-0.6, 0.6, (3, 6))
    found = leg_conditioning(leg, theta)
    for k in range(3):
        moved = theta[k] + step * np.vstack([np.eye(6), -np.eye(6)])
        poses = biped.leg_forward_kinematics(side, moved)
        change = (poses[:6] - poses[6:]) / (2 * step)
        spin = change[:, :3, :3] @ biped.leg_forward_kinematics(side, theta[k])[:3, :3].T
        length = biped.specification.leg(side).x_3 + biped.specification.leg(side).x_4
        jacobian = np.vstack(
            [
                change[:, :3, 3].T / length,
                np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]]),
            ]
        )
        values = np.linalg.svd(jacobian, compute_uv=False)
        assert found[k] == pytest.approx(values[-1] / values[0], rel=1e-6)


def test_a_straight_knee_is_singular(scout):
    theta = np.zeros((1, 6))
    theta[0, 3] = -np.radians(scout.specification.leg("left").beta_deg[3])
    assert leg_conditioning(scout.legs["left"], theta)[0] < 1e-9
