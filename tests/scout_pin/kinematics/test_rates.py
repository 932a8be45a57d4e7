"""Joint rates: which sample is refused, however long the motion is."""

import numpy as np
import pytest

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.rates import leg_rates
from scout_pin.kinematics.screws import LegScrews
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


@pytest.mark.parametrize("sine", [2e-9, 9e-9, 1.1e-8, 1e-7])
def test_hip_and_ankle_axes_are_in_line_by_their_angle_not_by_the_legs_length(scout, sine):
    """By hand: v in the plane of thigh and shank, and the foot turned beside it."""
    leg = scout.legs["left"]
    gamma = np.array([0.2, 1.1, 0.4, -0.9, 0.0, 0.3])
    thigh, shank = gamma[2], gamma[2] + gamma[3]
    along = leg.x_2 + leg.x_3 * np.cos(thigh) + leg.x_4 * np.cos(shank)
    across = leg.x_3 * np.sin(thigh) + leg.x_4 * np.sin(shank)
    gamma[4] = np.arctan2(across, along) - shank + sine
    screws = LegScrews(leg, (gamma - leg.beta)[None])
    if sine > 1e-8:
        screws.refuse_singular()
    else:
        with pytest.raises(SingularPose, match="in line"):
            screws.refuse_singular()
