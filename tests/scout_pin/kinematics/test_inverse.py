"""Closed-form kinematics of the legs, against Pinocchio, EAIK and yourdfpy."""

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scout_pin.kinematics.forward import leg_forward_kinematics
from scout_pin.kinematics.geometry import LegGeometry
from scout_pin.kinematics.inverse import BRANCHES, leg_inverse_kinematics
from scout_pin.specification import SIDES, Specification
from scout_pin.urdf import JOINT_AXES, offsets
from thesis_pin.errors import BadInput, NotFinite, WrongShape
from thesis_pin.numeric.arrays import wrap
from thesis_pin.numeric.rotations import invert, rotation, transform
from thesis_pin.numeric.trajectory import BodyMotion

from ..conftest import random_specification


def legs_under_test(kind, side, rng):
    spec = Specification.read() if kind == "thesis" else random_specification(rng)
    return LegGeometry.of(spec, side)


def pinocchio_foot(robot, side, theta):
    """Placement of the sole in the torso frame by Pinocchio."""
    q = pin.neutral(robot.model)
    number = SIDES.index(side)
    q[7 + 6 * number : 13 + 6 * number] = theta
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    return data.oMf[robot.sole_frames[side]].homogeneous


def legs_product(leg, theta):
    """Equation (3.4) as a product of elementary transformations, all written out."""
    placement = np.eye(4)
    for k, axis in enumerate(JOINT_AXES):
        origin = np.array(leg_offsets(leg)[k])
        turn = rotation(axis, theta[k] + leg.beta[k])
        placement = placement @ transform(turn, origin)
    return placement @ transform(leg.foot, np.array(leg_offsets(leg)[6]))


def leg_offsets(leg):
    return (
        (leg.x_0, 0.0, 0.0),
        (0.0, 0.0, -leg.z_1),
        (leg.x_2, 0.0, 0.0),
        (leg.x_3, 0.0, 0.0),
        (leg.x_4, 0.0, 0.0),
        (leg.x_5, 0.0, 0.0),
        (0.0, leg.y_6, 0.0),
    )


@pytest.mark.parametrize("side", SIDES)
def test_forward_kinematics_of_numpy_urdf_and_yourdfpy_agree(biped, side, rng, tmp_path):
    import yourdfpy

    path = tmp_path / "robot.urdf"
    path.write_text(biped.urdf)
    other = yourdfpy.URDF.load(path, load_meshes=False, build_scene_graph=True)
    leg = biped.legs[side]
    for theta in rng.uniform(-1.5, 1.5, (20, 6)):
        ours = leg_forward_kinematics(leg, theta)
        np.testing.assert_allclose(ours, pinocchio_foot(biped, side, theta), atol=1e-12)
        np.testing.assert_allclose(ours, legs_product(leg, theta), atol=1e-12)
        other.update_cfg(dict(zip(leg.names, theta, strict=True)))
        np.testing.assert_allclose(ours, other.get_transform(f"{side}_sole", "torso"), atol=1e-12)


def test_neutral_pose_stands_where_the_program_says_erect(scout):
    # Appendix D: xB = 0, yB = 38.5, zB = 234.37 mm, both feet flat, to its digits.
    for side, x in (("left", -44.54), ("right", 44.54)):
        foot = scout.neutral_feet()[side]
        np.testing.assert_allclose(foot[:3, 3] * 1e3, [x, -38.5, -234.37], atol=0.03)
        np.testing.assert_allclose(foot[:3, :3], np.eye(3), atol=1e-12)


@pytest.mark.parametrize("kind", ["thesis", "random"])
@pytest.mark.parametrize("side", SIDES)
def test_every_branch_of_100_000_random_poses_reaches_its_pose(kind, side, rng):
    leg = legs_under_test(kind, side, rng)
    theta = rng.uniform(-np.pi, np.pi, (100_000, 6))
    solutions = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta))
    assert np.nanmax(solutions.rotation_residual) <= 1e-12
    assert np.nanmax(solutions.position_residual) <= 1e-13
    assert set(np.unique(solutions.reachable.sum(axis=-1))) <= {4, 8}


@pytest.mark.parametrize("kind", ["thesis", "random"])
@pytest.mark.parametrize("side", SIDES)
def test_the_generating_angles_are_among_the_branches(kind, side, rng):
    leg = legs_under_test(kind, side, rng)
    theta = rng.uniform(-np.pi, np.pi, (100_000, 6))
    solutions = leg_inverse_kinematics(leg, leg_forward_kinematics(leg, theta))
    gap = np.abs(wrap(solutions.angles - theta[:, None])).max(axis=-1)
    # Near a singular pose angles are ill-conditioned: rounding is amplified by
    # the inverse of the determinant's sines.
    gamma = theta + leg.beta
    knee = np.abs(np.sin(gamma[:, 3]))
    amplification = 1 / (solutions.sine_axis * solutions.sine_hip * knee)
    assert (np.nanmin(gap, axis=-1) / amplification).max() <= 1e-12


def test_a_single_pose_and_a_stack_give_the_same_branches(biped, rng):
    leg = biped.legs["left"]
    poses = leg_forward_kinematics(leg, rng.uniform(-2, 2, (40, 6)))
    stack = leg_inverse_kinematics(leg, poses)
    for k, pose in enumerate(poses):
        single = leg_inverse_kinematics(leg, pin.SE3(pose))
        assert single.angles.shape == (8, 6)
        np.testing.assert_allclose(single.angles, stack.angles[k], atol=1e-9)
        np.testing.assert_array_equal(single.valid, stack.valid[k])
    grid = leg_inverse_kinematics(leg, poses.reshape(5, 8, 4, 4))
    np.testing.assert_array_equal(grid.angles.reshape(40, 8, 6), stack.angles)


def test_an_earlier_answers_memory_is_used_again(scout, rng):
    leg = scout.legs["left"]
    first, second = (leg_forward_kinematics(leg, rng.uniform(-2, 2, (5000, 6))) for _ in range(2))
    second[7] = leg_forward_kinematics(leg, yaw_free(leg))
    earlier, fresh = (leg_inverse_kinematics(leg, poses) for poses in (first, second))
    again = leg_inverse_kinematics(leg, second, out=earlier)
    assert np.shares_memory(again.angles, earlier.angles)
    for name in ("angles", "excess", "valid", "sine_axis", "sine_hip", "position_residual"):
        np.testing.assert_array_equal(getattr(again, name), getattr(fresh, name))
    with pytest.raises(WrongShape, match="out"):
        leg_inverse_kinematics(leg, first[:4999], out=again)
    with pytest.raises(BadInput, match="out"):
        leg_inverse_kinematics(leg, first, out=again.angles)
    few = leg_inverse_kinematics(leg, first[:3], out=leg_inverse_kinematics(leg, second[:3]))
    np.testing.assert_array_equal(few.angles, leg_inverse_kinematics(leg, first[:3]).angles)


def test_eaik_finds_the_same_branches(rng):
    eaik = pytest.importorskip("eaik.IK_HP", reason="EAIK isn't installed")
    leg = LegGeometry.of(Specification.read(), "left")
    origins = leg_offsets(leg)
    letters = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}
    # Zero configuration of EAIK: γ = 0, all frames parallel.
    robot = eaik.HPRobot(
        np.array([letters[a] for a in JOINT_AXES]),
        np.array(origins),
    )
    for theta in rng.uniform(-np.pi, np.pi, (200, 6)):
        pose = leg_forward_kinematics(leg, theta)
        ours = leg_inverse_kinematics(leg, pose)
        target = pose.copy()
        target[:3, :3] = pose[:3, :3] @ leg.foot.T
        answer = robot.IK(target)
        # EAIK adds least-squares answers that don't reach the pose; it flags them.
        theirs = np.array(answer.Q)[~np.array(answer.is_LS, dtype=bool)]
        mine = ours.angles[ours.reachable] + leg.beta
        assert len(theirs) == len(mine)
        for solution in theirs:
            assert np.abs(wrap(mine - solution)).max(axis=1).min() < 1e-6


@given(seed=st.integers(0, 2**32 - 1), side=st.sampled_from(SIDES))
@settings(max_examples=60, deadline=None)
def test_inverse_after_forward_kinematics_is_the_identity_for_any_leg(seed, side):
    rng = np.random.default_rng(seed)
    leg = LegGeometry.of(random_specification(rng), side)
    pose = leg_forward_kinematics(leg, rng.uniform(-np.pi, np.pi, 6))
    solutions = leg_inverse_kinematics(leg, pose)
    assert solutions.reachable.sum() >= 4
    assert np.nanmax(solutions.position_residual) <= 1e-12
    assert np.nanmax(solutions.rotation_residual) <= 1e-12


@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_the_biped_is_mirror_symmetric(seed):
    """A mirrored pose has mirrored angles on the other leg: all negated but the roll."""
    theta = np.random.default_rng(seed).uniform(-1.5, 1.5, 6)
    left, right = (LegGeometry.of(Specification.read(), side) for side in SIDES)
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    pose = leg_forward_kinematics(left, theta)
    np.testing.assert_allclose(
        leg_forward_kinematics(right, theta * [-1, 1, -1, -1, -1, -1]),
        mirror @ pose @ mirror,
        atol=1e-12,
    )


def test_an_unreachable_pose_says_by_how_much(scout):
    pose = scout.neutral_feet()["left"].copy()
    pose[2, 3] -= 0.1
    solutions = scout.leg_inverse_kinematics("left", pose)
    assert not solutions.reachable.any()
    assert np.isnan(solutions.angles).all()
    # Hand calculation: distance of p5 from p3 in the branch that keeps the hip.
    leg = scout.legs["left"]
    p3, p5 = np.array([0.0, 0.0, -83.66e-3]), np.array([0.0, 8.655e-3, -197.880e-3 - 0.1])
    by_hand = np.linalg.norm(p5 - p3) - (leg.x_3 + leg.x_4)
    assert solutions.excess.min() == pytest.approx(by_hand, abs=1e-6)
    assert f"{by_hand * 1e3:.2f}" in solutions.explain()
    for branch in range(8):
        assert f"{solutions.excess[branch] * 1e3:.3f} mm" in solutions.explain(branch=branch)


def test_a_pose_outside_the_limits_names_the_joint_and_the_limit(scout):
    theta = np.array([0.0, 0.0, 0.2, 0.0, 1.9, 0.0])  # ankle at 109°
    solutions = scout.leg_inverse_kinematics(
        "left", leg_forward_kinematics(scout.legs["left"], theta)
    )
    assert solutions.reachable.any()
    assert not solutions.valid.any()
    assert "left_" in solutions.explain()
    assert "outside -90° to 90°" in solutions.explain()


def knee_straight(leg):
    return np.array([0.1, 0.2, 0.3, -leg.beta[3], 0.4, 0.1])


def axis_free(leg):
    """Angles that put p2 on the line of link 5: γ5 turns a along p5 − p2."""
    theta = np.array([0.2, -0.1, 0.3, 0.5, 0.0, 0.4])
    gamma = theta + leg.beta
    sum_4 = gamma[2] + gamma[3]
    v = np.array(
        [
            leg.x_2 + leg.x_3 * np.cos(gamma[2]) + leg.x_4 * np.cos(sum_4),
            leg.x_3 * np.sin(gamma[2]) + leg.x_4 * np.sin(sum_4),
        ]
    )
    theta[4] = np.arctan2(v[1], v[0]) - sum_4 - leg.beta[4]
    return theta


def yaw_free(leg):
    return np.array([0.3, -leg.beta[1], 0.3, 0.5, 0.2, 0.4])


SINGULAR = {"knee straight": knee_straight, "axis free": axis_free, "yaw free": yaw_free}


@pytest.mark.parametrize("name", SINGULAR)
@pytest.mark.parametrize("stacked", [False, True])
def test_singular_poses_are_reached_named_and_keep_the_reference(scout, name, stacked):
    leg = scout.legs["left"]
    theta = SINGULAR[name](leg)
    pose = leg_forward_kinematics(leg, theta)
    given_pose = np.broadcast_to(pose, (40, 4, 4)) if stacked else pose
    solutions = leg_inverse_kinematics(leg, given_pose, reference=theta)
    index = (0,) if stacked else ()
    assert name in str(solutions.singularity[index])
    # At the boundary the knee's cosine is known to rounding only, its angle to
    # the root of that; the pose itself is still reached to 1e-12.
    assert np.nanmax(solutions.position_residual) <= 1e-12
    assert np.nanmax(solutions.rotation_residual) <= 1e-12
    gap = np.abs(wrap(solutions.angles[index] - theta)).max(axis=-1)
    assert np.nanmin(gap) < (1e-7 if name == "knee straight" else 1e-9)
    without = leg_inverse_kinematics(leg, pose)
    assert np.nanmax(without.position_residual) <= 1e-12


def test_motion_seen_from_a_moving_torso_is_its_derivative(rng):
    """BodyMotion.seen_from against central differences of the relative placement."""
    from thesis_pin.numeric.rotations import euler_placement

    coefficients = rng.normal(size=(2, 3, 6)) * 0.3

    def body(which, t):
        c = coefficients[which]
        powers = [np.array([1, t, t * t]), np.array([0, 1, 2 * t]), np.array([0, 0, 2.0])]
        x, v, a = (power @ c for power in powers)
        turn, omega, alpha = euler_placement("xyz", x[None, 3:], v[None, 3:], a[None, 3:])
        return BodyMotion(turn, x[None, :3], v[None, :3], a[None, :3], omega, alpha)

    def relative(t):
        return invert(body(0, t).placement[0]) @ body(1, t).placement[0]

    t, h = 0.4, 1e-4
    seen = body(1, t).seen_from(body(0, t))
    before, here, after = relative(t - h), relative(t), relative(t + h)
    np.testing.assert_allclose(seen.placement[0], here, atol=1e-14)
    velocity, acceleration = (after - before) / (2 * h), (after - 2 * here + before) / h**2
    np.testing.assert_allclose(seen.velocity[0], velocity[:3, 3], atol=1e-7)
    np.testing.assert_allclose(seen.acceleration[0], acceleration[:3, 3], atol=1e-6)
    spin = velocity[:3, :3] @ here[:3, :3].T
    np.testing.assert_allclose(seen.omega[0], [spin[2, 1], spin[0, 2], spin[1, 0]], atol=1e-7)
    turning = acceleration[:3, :3] @ here[:3, :3].T - spin @ spin
    np.testing.assert_allclose(
        seen.alpha[0], [turning[2, 1], turning[0, 2], turning[1, 0]], atol=1e-6
    )


def test_gait_lies_on_the_documented_branches(scout):
    feet = scout.neutral_feet()
    for side, branch in (("left", (1, 1, 1)), ("right", (-1, 1, -1))):
        angles = scout.leg_inverse_kinematics(side, feet[side]).angles
        np.testing.assert_allclose(angles[BRANCHES.index(branch)], 0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("pose", "error", "says"),
    [
        (np.eye(3), WrongShape, "4, 4"),
        (np.full((4, 4), np.nan), NotFinite, "finite"),
        (2 * np.eye(4), BadInput, "rigid"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), BadInput, "rigid"),
        ("foot", BadInput, "array"),
    ],
)
def test_a_pose_that_is_none_is_refused(scout, pose, error, says):
    with pytest.raises(error, match=says):
        scout.leg_inverse_kinematics("left", pose)


def test_urdf_offsets_are_the_leg_geometry(biped):
    for sign, side in ((-1.0, "left"), (1.0, "right")):
        np.testing.assert_array_equal(
            offsets(biped.specification.leg(side), sign), leg_offsets(biped.legs[side])
        )
