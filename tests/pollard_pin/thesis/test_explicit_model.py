"""The thesis's explicit model, as an API, against Pinocchio on the closed mechanism."""

import numpy as np
import pinocchio as pin
import pytest

from pollard_pin.coordinates import angular_rate_matrix
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.specification import LINK_NAMES, SKEWED_PATH, Specification
from pollard_pin.thesis import ExplicitModel
from pollard_pin.thesis.claims.dynamics import projected_terms, random_motion
from thesis_pin.audit.judging.verdicts import largest_relative
from thesis_pin.errors import (
    BadInput,
    NotFinite,
    SingularPose,
    UnknownName,
    Unreachable,
    WrongShape,
)
from thesis_pin.loops import kinematics as loops


@pytest.fixture(scope="module")
def thesis():
    return ExplicitModel()


@pytest.fixture(scope="module")
def skewed_model():
    return ExplicitModel(Specification.read(SKEWED_PATH))


@pytest.fixture(params=["thesis", "skewed_model"])
def model(request):
    """The thesis's robot, and one with unequal side chains and β54 ≠ 0."""
    return request.getfixturevalue(request.param)


def pinocchio_rates(robot, pose, q):
    """Joint rates over the pose's, from Pinocchio's constraint and tool Jacobians alone."""
    data, frame = robot.model.createData(), robot.model.getFrameId("tool_tip")
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    tool = pin.computeFrameJacobian(robot.model, data, q, frame, axes)
    twist = np.zeros((12, 6))
    twist[6:9, :3], twist[9:, 3:] = np.eye(3), angular_rate_matrix(pose)
    return np.linalg.solve(np.vstack([loops.jacobian(robot, q), tool]), twist)


def test_rows_of_all_three_chains_are_pinocchios_joint_rates(model):
    pose, _, _ = random_motion(model, 60)
    q = model.robot.inverse_kinematics(pose, model.branch).angles
    expected = np.array([pinocchio_rates(model.robot, *one) for one in zip(pose, q, strict=True)])
    assert largest_relative(model.rows(pose), expected) < 1e-12


def test_D_velocity_terms_and_gravity_are_pinocchios_projected_dynamics(model):
    """The audit, of which every row is tested, holds the same law at a thousand states."""
    pose, v, _ = random_motion(model, 150)
    assert len(pose) == 150
    mass, velocity, gravity = model.terms(pose, v)
    truth = projected_terms(model.robot, pose, v)
    found = mass, (velocity @ v[..., None])[..., 0], gravity
    for ours, pinocchio in zip(found, truth, strict=True):
        assert largest_relative(ours, pinocchio) < 1e-10


def test_the_generalized_force_is_what_six_motors_supply(model):
    pose, v, a = random_motion(model, 20)
    q, rate, acceleration = model.robot.joint_motion(pose, v, a, model.branch)
    torque = inverse_dynamics_at(model.robot, q, rate, acceleration).torque
    motors = model.rows(pose)[:, [0, 6, 9, 3, 4, 5]]
    supplied = np.einsum("nij,ni->nj", motors, torque)
    assert largest_relative(model.generalized_force(pose, v, a), supplied) < 1e-9


def test_k_are_the_rows_and_the_levers_that_make_M(model):
    pose, _, _ = random_motion(model, 3)
    rows = model.rows(pose)
    for place, number in enumerate((2, 6, 7, 12, 18, 25)):
        np.testing.assert_allclose(model.k(number, pose), rows[:, place], rtol=1e-12)
    levers = [model.k(number, pose, 2) for number in (3, 4, 5)]
    sides = [model.k(number, pose, 2) for number in (2, 6, 7)]
    made = sum(a[..., None] * b[:, None] for a, b in zip(levers, sides, strict=True))
    np.testing.assert_allclose(made, model.M(3, pose, 2), rtol=1e-9)


def test_accelerations_are_the_closed_forms(model):
    pose, v, a = random_motion(model, 20)
    expected = model.robot.accelerations(pose, v, a, model.branch)
    assert largest_relative(model.accelerations(pose, v, a), expected) < 1e-9


def test_M_gives_velocities_of_centres_of_gravity_and_angular_velocities(model):
    pose, v, _ = random_motion(model, 3)
    q, rate, _ = model.robot.joint_motion(pose, v, None, model.branch)
    places = [(k, None) for k in range(1, 6)] + [(k, chain) for chain in (1, 2) for k in (1, 2)]
    for name, (k, chain) in zip(LINK_NAMES, places, strict=True):
        centre = model.M(2 * k - 1, pose, chain) @ v[..., None]
        turn = model.M(2 * k, pose, chain) @ v[..., None]
        for n in range(3):
            linear, angular = body_motion(model.robot, name, q[n], rate[n])
            np.testing.assert_allclose(centre[n, :, 0], linear, atol=1e-10)
            np.testing.assert_allclose(turn[n, :, 0], angular, atol=1e-10)


def body_motion(robot, name, q, v):
    """Velocity of a body's centre of gravity and its angular velocity, by Pinocchio."""
    data, frame = robot.model.createData(), robot.model.getFrameId(name)
    pin.forwardKinematics(robot.model, data, q, v)
    pin.updateFramePlacements(robot.model, data)
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    twist = pin.getFrameVelocity(robot.model, data, frame, axes)
    lever = data.oMf[frame].rotation @ robot.specification.com(name)
    return twist.linear + np.cross(twist.angular, lever), twist.angular


def test_D_is_the_sum_of_the_bodies_shares(model):
    pose, _, _ = random_motion(model, 4)
    shares = [model.N(k, pose) for k in range(1, 6)]
    shares += [model.N(k, pose, chain) for chain in (1, 2) for k in (1, 2)]
    np.testing.assert_allclose(sum(shares), model.D(pose), rtol=1e-12)


def test_single_terms_are_those_given_at_once(thesis):
    pose, v, _ = random_motion(thesis, 3)
    mass, velocity, gravity = thesis.terms(pose, v)
    np.testing.assert_array_equal(thesis.D(pose), mass)
    np.testing.assert_array_equal(thesis.V(pose, v), velocity)
    np.testing.assert_array_equal(thesis.C(pose), gravity)


def test_J_tau_turns_base_torques_into_their_power(thesis):
    pose, v, _ = random_motion(thesis, 5)
    _, rate, _ = thesis.robot.joint_motion(pose, v, None, thesis.branch)
    torque = np.array([1.0, -2.0, 3.0])
    power = np.einsum("i,nij,nj->n", torque, thesis.J_tau(pose), v)
    np.testing.assert_allclose(power, rate[:, [0, 6, 9]] @ torque, rtol=1e-10)


def test_stacks_of_any_shape_and_single_poses_agree(thesis):
    pose, v, _ = random_motion(thesis, 4)
    stacked = thesis.V(pose.reshape(2, 2, 6), v.reshape(2, 2, 6))
    assert stacked.shape == (2, 2, 6, 6)
    np.testing.assert_allclose(stacked[1, 0], thesis.V(pose[2], v[2]), rtol=1e-9)
    assert thesis.rows(pose[0]).shape == (12, 6)
    assert thesis.D(np.zeros((0, 6))).shape == (0, 6, 6)


def test_a_branch_can_be_given_by_its_label(thesis):
    pose = random_motion(thesis, 1)[0][0]
    by_label = ExplicitModel(branch=str(thesis.branch))
    np.testing.assert_array_equal(by_label.rows(pose), thesis.rows(pose))


def test_the_printed_edition_fails_where_the_audit_says_so():
    printed, corrected = ExplicitModel(edition="printed"), ExplicitModel()
    pose, v, _ = random_motion(corrected, 4)
    rows = printed.rows(pose), corrected.rows(pose)
    np.testing.assert_allclose(rows[0][:, 0], rows[1][:, 0], atol=1e-9)  # k_2 holds, mended
    assert np.abs(rows[0][:, 1] - rows[1][:, 1]).max() > 0.1  # k_6 rests on (2.20)
    terms = zip(printed.terms(pose, v), corrected.terms(pose, v), strict=True)
    assert all(np.abs(a - b).max() > 1e-3 * np.abs(b).max() for a, b in terms)


def test_what_could_not_be_followed_is_listed():
    printed = ExplicitModel(edition="printed")
    assert "what follows from the rest" in printed.substituted["pollard:D:V_50"]
    assert "pollard:D:V_5" not in printed.substituted
    printed.rows(random_motion(printed, 1)[0])
    assert "can't be read" in printed.substituted["pollard:D:V_5"]
    corrected = ExplicitModel()
    corrected.terms(*random_motion(corrected, 1)[:2])
    assert corrected.substituted == {}


def test_where_the_tool_axis_lies_in_chain_0s_plane_the_formulas_divide_by_zero(thesis):
    """Not the mechanism: its own rates exist there."""
    pose = np.array([0.45, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert thesis.margin(pose) < 1e-12
    assert np.isfinite(thesis.robot.rates(pose, np.ones(6))).all()
    with pytest.raises(SingularPose, match=r"pose \[1\].*divide by cos θ1615"):
        thesis.rows([random_motion(thesis, 1)[0][0], pose])
    assert thesis.margin(random_motion(thesis, 10)[0]).min() > 0.05


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda m, x: ExplicitModel(edition="original"), UnknownName, "corrected"),
        (lambda m, x: ExplicitModel(inertia="exact"), UnknownName, "printed"),
        (lambda m, x: m.M(11, x), UnknownName, "10"),
        (lambda m, x: m.M(5, x, 1), UnknownName, "4"),
        (lambda m, x: m.N(3, x, 2), UnknownName, "2"),
        (lambda m, x: m.k(26, x), UnknownName, "25"),
        (lambda m, x: m.k(8, x, 1), UnknownName, "7"),
        (lambda m, x: m.N(1, x, 3), UnknownName, "None"),
        (lambda m, x: m.D(np.zeros(5)), WrongShape, "6"),
        (lambda m, x: m.V(x, np.zeros((2, 6))), WrongShape, "pose"),
        (lambda m, x: m.C(x * np.nan), NotFinite, "pose"),
        (lambda m, x: m.C(x + 5.0), Unreachable, ""),
        (lambda m, x: m.C([x] * 200 + [x + 5.0]), Unreachable, "pose [200]"),
        (lambda m, x: ExplicitModel(branch="+-"), BadInput, "seven signs"),
    ],
)
def test_bad_input_is_named(thesis, call, error, words):
    pose = random_motion(thesis, 1)[0][0]
    with pytest.raises(error) as caught:
        call(thesis, pose)
    assert words in str(caught.value)
