"""Joint rates: which sample is refused, however long the motion is."""

import numpy as np
import pytest

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.rates import leg_rates
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.trajectory import BodyMotion


@pytest.mark.parametrize("bad", [3, 4095, 4096, 9000])
def test_a_singular_sample_is_named_by_its_place_in_the_whole_motion(scout, bad):
    """Also beyond the first block of samples."""
    leg = scout.legs["left"]
    theta = np.full((9001, 6), 0.3)
    theta[bad, 1] = -leg.beta[1]
    place = leg_forward_kinematics(leg, theta)
    zero = np.zeros((len(theta), 3))
    foot = BodyMotion(place[:, :3, :3], place[:, :3, 3], zero, zero, zero, zero)
    with pytest.raises(SingularPose, match=f"left leg, sample {bad}:"):
        leg_rates(leg, theta, foot)
