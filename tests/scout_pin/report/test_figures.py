"""Figures and plots of a gait report show what the report says."""

import numpy as np
import pytest

import scout_pin
from scout_pin.kinematics.singularity import leg_conditioning
from scout_pin.report.figures import skeleton, stick_figures
from scout_pin.report.page import gait_page


@pytest.fixture(scope="module")
def report():
    return scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(), samples=41)


def test_conditioning_is_that_of_the_finite_difference_jacobian(biped, rng):
    theta = rng.uniform(-0.6, 0.6, (3, 12))
    found = leg_conditioning(biped, theta)
    step = 1e-6
    for k in range(3):
        for j, side in enumerate(("left", "right")):
            leg = theta[k, 6 * j : 6 * j + 6]
            moved = leg + step * np.vstack([np.eye(6), -np.eye(6)])
            poses = biped.leg_forward_kinematics(side, moved)
            change = (poses[:6] - poses[6:]) / (2 * step)
            here = biped.leg_forward_kinematics(side, leg)
            spin = change[:, :3, :3] @ here[:3, :3].T
            size = biped.specification.leg(side).x_3 + biped.specification.leg(side).x_4
            jacobian = np.vstack(
                [
                    change[:, :3, 3].T / size,
                    np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]]),
                ]
            )
            values = np.linalg.svd(jacobian, compute_uv=False)
            assert found[k, j] == pytest.approx(values[-1] / values[0], rel=1e-6)


def test_a_straight_knee_is_singular(scout):
    theta = np.zeros((1, 12))
    theta[0, 3] = -np.radians(scout.specification.leg("left").beta_deg[3])
    assert leg_conditioning(scout, theta)[0, 0] < 1e-9


def test_stick_figures_show_the_motion_of_the_report(report):
    some = np.array([0, 20, 40])
    lines = skeleton(report, some)
    for side, foot in (("left", report.motion.left_foot), ("right", report.motion.right_foot)):
        np.testing.assert_allclose(lines[side][:, -1], foot.position[some], atol=1e-12)
        # Six joints, then the sole; neighbours are a link apart at every moment.
        lengths = np.linalg.norm(np.diff(lines[side], axis=1), axis=-1)
        np.testing.assert_allclose(lengths, np.tile(lengths[0], (3, 1)), atol=1e-9)
    middle = lines["torso"].mean(axis=1)
    np.testing.assert_allclose(middle, report.motion.torso.position[some], atol=1e-9)


def test_stick_figures_have_two_views_of_every_frame(report):
    figure = stick_figures(report, frames=5)
    assert len(figure.axes) == 10
    assert figure.axes[4].get_title() == f"{report.joints.time[-1]:.2f} s"


def test_a_page_is_the_same_bytes_for_the_same_report(report):
    assert gait_page(report) == gait_page(report)
