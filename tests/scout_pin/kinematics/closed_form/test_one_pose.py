"""Single poses, by floats: the same as stacks, and as exact near what they leave to arrays."""

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.kinematics.closed_form import one_pose
from scout_pin.kinematics.closed_form.stack import ClosedForm
from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.kinematics.signs import BRANCHES
from scout_pin.specification import SIDES, Specification
from thesis_pin.errors import BadInput, NotFinite
from thesis_pin.numeric.arrays import wrap

from ...conftest import random_specification


@pytest.mark.parametrize("seed", range(20))
def test_floats_and_arrays_find_the_same_angles_and_each_reaches_the_pose(seed):
    rng = np.random.default_rng(seed)
    specification = random_specification(rng) if seed % 2 else Specification.read()
    leg = LegGeometry.of(specification, SIDES[seed // 2 % 2])
    poses = leg_forward_kinematics(leg, rng.uniform(-np.pi, np.pi, (100, 6)))
    stack = leg_inverse_kinematics(leg, poses)
    for k, pose in enumerate(poses):
        for given in (pin.SE3(pose), pose):
            single = leg_inverse_kinematics(leg, given)
            assert isinstance(single.solved, list) == (stack.sine_hip[k] > 0.01)  # by floats
            np.testing.assert_array_equal(single.reachable, stack.reachable[k])
            np.testing.assert_allclose(single.excess, stack.excess[k], atol=1e-12)
            np.testing.assert_allclose(single.sine_axis, stack.sine_axis[k], atol=1e-12)
            np.testing.assert_allclose(single.sine_hip, stack.sine_hip[k], atol=1e-12)
            assert np.nanmax(single.position_residual) <= 1e-13
            assert np.nanmax(single.rotation_residual) <= 1e-12
            gap = abs(wrap(single.angles - stack.angles[k])).max(axis=-1)
            sines = single.sine_axis * single.sine_hip
            assert np.nanmax(gap * sines * abs(np.sin(single.angles[:, 3] + leg.beta[3]))) <= 1e-13


@pytest.mark.parametrize("roll", np.geomspace(1e-3, 0.1, 9))
def test_a_leg_nearly_on_its_side_is_as_exact_as_any(scout, roll):
    """Angles about joint 1 lose digits with |sin γ2|: the worst that floats take is 0.01."""
    leg = scout.legs["left"]
    theta = np.array([0.3, roll - leg.beta[1], 0.3, 0.5, 0.2, 0.4])
    single = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta))
    assert np.nanmax(single.position_residual) <= 1e-13
    assert np.nanmax(single.rotation_residual) <= 1e-12
    assert np.nanmin(abs(wrap(single.angles - theta)).max(axis=-1)) < 1e-12


@pytest.mark.parametrize("side", SIDES)
def test_one_branch_is_that_of_all_eight_if_it_is_valid(scout, side, rng):
    leg, valid = scout.legs[side], 0
    poses = leg_forward_kinematics(leg, rng.uniform(-1.5, 1.5, (50, 6)))
    everything = leg_inverse_kinematics(leg, poses)
    for k, pose in enumerate(poses):
        for number in range(len(BRANCHES)):
            theta = one_pose.one_branch(leg, pose, number, False)
            assert (theta is not None) == everything.valid[k, number]
            angles, gap = ClosedForm(leg, pose.reshape(16, 1)).branch(number)
            assert gap[0] == pytest.approx(everything.excess[k, number], abs=1e-14)
            if theta is not None:
                valid += 1
                np.testing.assert_allclose(theta, everything.angles[k, number], atol=1e-9)
                np.testing.assert_allclose(theta, angles[:, 0], atol=1e-9)
                reached = leg_forward_kinematics(leg, np.array(theta))
                np.testing.assert_allclose(reached, pose, atol=1e-12)
    assert valid >= 50


def test_an_angle_of_half_a_turn_is_plus_pi_never_minus(scout):
    """By hand: θ = ±180° place a body alike, and (−π, π] holds one of them."""
    leg = scout.legs["left"]
    for joint in (0, 5):
        for turn in (np.pi, -np.pi):
            theta = np.array([0.0, 0.1, 0.2, 0.5, 0.1, 0.1])
            theta[joint] = turn
            pose = leg_forward_kinematics(leg, theta)
            for found in (
                leg_inverse_kinematics(leg, pose).angles,
                leg_inverse_kinematics(leg, np.tile(pose, (20, 1, 1))).angles,
            ):
                assert np.nanmin(found) > -np.pi
                assert np.nanmax(found) <= np.pi


def test_a_matrix_that_changes_later_changes_no_answer(scout):
    leg = scout.legs["left"]
    pose = leg_forward_kinematics(leg, np.full(6, 0.3))
    found, other = leg_inverse_kinematics(leg, pose), leg_inverse_kinematics(leg, pose)
    pose[0, 3] += 0.1
    assert found.sine_axis == other.sine_axis
    assert np.nanmax(found.position_residual) <= 1e-13


WRONG = {
    "stretched": lambda pose: pose * np.array([[1.0 + 1e-6, 1.0, 1.0, 1.0]]),
    "skew": lambda pose: pose + 1e-6 * np.eye(4)[[1, 0, 2, 3]] * [1, 1, 0, 0],
    "mirrored": lambda pose: pose * np.array([[1.0, -1.0, 1.0, 1.0]]),
    "last row": lambda pose: pose + np.array([[0.0] * 4] * 3 + [[0.0, 1e-17, 0.0, 0.0]]),
    "last entry": lambda pose: pose + np.diag([0.0, 0.0, 0.0, 1e-15]),
}


@pytest.mark.parametrize("kind", WRONG)
@pytest.mark.parametrize("place", [None, 0, 17, 3599, 3600, 7999])
def test_what_is_no_rigid_placement_is_refused_wherever_it_stands(scout, kind, place):
    leg = scout.legs["left"]
    pose = leg_forward_kinematics(leg, np.full(6, 0.3))
    given = pose if place is None else np.tile(pose, (8000, 1, 1))
    given[... if place is None else place] = WRONG[kind](pose)
    with pytest.raises(BadInput, match=rf"rigid placement at index \({place or 0},\)"):
        leg_inverse_kinematics(leg, given)


@pytest.mark.parametrize("place", [None, 0, 17, 3600, 7999])
@pytest.mark.parametrize("entry", [(0, 0), (1, 3), (2, 2), (2, 3), (3, 1)])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_isnt_finite_is_refused_wherever_it_stands(scout, bad, entry, place):
    leg = scout.legs["left"]
    pose = leg_forward_kinematics(leg, np.full(6, 0.3))
    given = pose if place is None else np.tile(pose, (8000, 1, 1))
    given[(... if place is None else place, *entry)] = bad
    with pytest.raises(NotFinite):
        leg_inverse_kinematics(leg, given)


@pytest.mark.parametrize("count", [1, 8000])
def test_rotations_are_refused_from_the_same_error_on_for_one_and_for_many(scout, count):
    """By hand: stretched by s along an axis, the largest entry of RᵀR − 1 is s² − 1."""
    leg = scout.legs["left"]
    pose = leg_forward_kinematics(leg, np.full(6, 0.3))
    given = np.tile(pose, (count, 1, 1)) if count > 1 else pose.copy()
    for error in (5e-11, 2e-10, 9e-10):
        given[..., :3, 0] = pose[:3, 0] * np.sqrt(1.0 + error)
        leg_inverse_kinematics(leg, given)
    given[..., :3, 0] = pose[:3, 0] * np.sqrt(1.0 + 1.1e-9)
    with pytest.raises(BadInput, match="rigid"):
        leg_inverse_kinematics(leg, given)
