"""The thesis's own equations, corrected, are Pinocchio's dynamics."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import Specification
from scout_pin.thesis import ExplicitModel
from thesis_pin.errors import BadInput, NoSolution, UnknownName

STATES = 200
"""The audit, of which every row is tested, holds the same law at a thousand."""


@pytest.fixture(scope="module", params=["physical", "printed"])
def pair(request):
    """The explicit model and Pinocchio's, under one inertia reading."""
    robot = scout_pin.load(root="thesis", inertia=request.param)
    return ExplicitModel(inertia=request.param), robot


def mass_matrix(robot, data, q):
    upper = np.triu(pin.crba(robot.model, data, q))
    return upper + np.triu(upper, 1).T


def test_corrected_D_V_C_equal_crba_coriolis_and_gravity_at_random_states(pair):
    model, robot = pair
    rng = np.random.default_rng(1)
    q, v = rng.uniform(-1.4, 1.4, (STATES, 18)), rng.uniform(-3, 3, (STATES, 18))
    D, V, C = model.terms(q, v)
    Vv = (V @ v[..., None])[..., 0]
    data = robot.model.createData()
    for k in range(STATES):
        M = mass_matrix(robot, data, q[k])
        g = pin.computeGeneralizedGravity(robot.model, data, q[k]).copy()
        bias = pin.nonLinearEffects(robot.model, data, q[k], v[k]) - g
        assert np.abs(D[k] - M).max() < 1e-10 * np.abs(M).max()
        assert np.abs(Vv[k] - bias).max() < 1e-10 * np.abs(bias).max()
        assert np.abs(C[k] - g).max() < 1e-10 * np.abs(g).max()


def test_the_rate_of_D_is_the_coriolis_matrix_plus_its_transpose(pair):
    model, robot = pair
    rng = np.random.default_rng(2)
    q, v = rng.uniform(-1.2, 1.2, (5, 18)), rng.uniform(-2, 2, (5, 18))

    rate = model.references(q, v, np.zeros_like(q)).terms.rate
    data = robot.model.createData()
    for k in range(5):
        coriolis = pin.computeCoriolisMatrix(robot.model, data, q[k], v[k])
        np.testing.assert_allclose(rate[k], coriolis + coriolis.T, atol=1e-13)


def test_the_model_serves_another_biped_with_unequal_legs(lopsided):
    specification = lopsided.specification
    model, robot = ExplicitModel(specification), scout_pin.load(specification, root="thesis")
    rng = np.random.default_rng(3)
    q, v, a = (rng.uniform(-1, 1, 18) for _ in range(3))
    expected = pin.rnea(robot.model, robot.model.createData(), q, v, a)
    np.testing.assert_allclose(model.generalized_force(q, v, a), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("interval", "sides", "rank", "printed_rank"),
    [
        (1, ("left",), 6, 4),
        (2, ("left", "right"), 12, 8),
        (3, ("right",), 6, 4),
    ],
)
def test_stance_jacobians_have_full_rank_corrected_and_lack_a_third_as_printed(
    scout_thesis, interval, sides, rank, printed_rank
):
    rng = np.random.default_rng(4)
    q = rng.uniform(-1.2, 1.2, (8, 18))
    corrected = ExplicitModel().dPhi_dq(q, interval)
    printed = ExplicitModel(edition="printed").dPhi_dq(q, interval)
    data = scout_thesis.model.createData()
    for k in range(len(q)):
        truth = [
            pin.computeFrameJacobian(
                scout_thesis.model,
                data,
                q[k],
                scout_thesis.sole_frames[side],
                pin.LOCAL_WORLD_ALIGNED,
            )
            for side in sides
        ]
        np.testing.assert_allclose(corrected[k], np.vstack(truth), atol=1e-12)
        assert np.linalg.matrix_rank(corrected[k]) == rank
        assert np.linalg.matrix_rank(printed[k]) == printed_rank
        np.testing.assert_allclose(printed[k][:, :3], 0, atol=1e-15)


@pytest.mark.parametrize("edition", ["corrected", "printed"])
def test_the_constraint_jacobian_is_the_derivative_of_the_constraints(edition):
    model = ExplicitModel(edition=edition)
    rng = np.random.default_rng(5)
    q = standing() + 0.05 * rng.uniform(-1, 1, 18)
    place = None
    if edition == "corrected":  # near its own pose a rotation vector's rate is ω
        robot = scout_pin.load()
        feet = robot.forward_kinematics(q[6:], torso(q))
        place = [feet["left"], feet["right"]]
    for interval in (1, 2, 3):
        chosen = (
            place if interval == 2 or place is None else place[interval // 2 : interval // 2 + 1]
        )
        h = 1e-6
        columns = [
            (model.Phi(q + h * e, interval, chosen) - model.Phi(q - h * e, interval, chosen))
            / (2 * h)
            for e in np.eye(18)
        ]
        np.testing.assert_allclose(
            np.stack(columns, axis=-1), model.dPhi_dq(q, interval), atol=1e-8
        )


def standing():
    q = np.zeros(18)
    q[1:3] = 38.5e-3, 234.37e-3
    return q


def torso(q):
    from thesis_pin.numeric.rotations import rotation, transform

    return transform(rotation("x", q[3]) @ rotation("y", q[4]) @ rotation("z", q[5]), q[:3])


def test_the_actuation_matrix_is_zero_over_one_corrected_and_not_as_printed():
    q = standing()
    right = np.vstack([np.zeros((6, 12)), np.eye(12)])
    np.testing.assert_allclose(ExplicitModel().A_tau(q), right, atol=1e-15)
    printed = ExplicitModel(edition="printed").A_tau(q)
    assert np.linalg.cond(printed[6:]) == pytest.approx(4, abs=0.2)
    assert np.abs(printed[3:6]).max() > 0.9
    np.testing.assert_allclose(np.triu(printed[6:]), printed[6:], atol=1e-15)


def test_corrected_4_23_gives_the_torques_of_the_gait(scout):
    motion = load_gait("thesis").sample(np.array([0.5, 7.0, 19.0, 20.5, 30.0, 39.0]))
    joints = joint_trajectory(scout, motion)
    q, v, a = scout.to_thesis(*free_flyer_state(motion.torso, joints))
    expected = inverse_dynamics(scout, motion, joints)
    model = ExplicitModel()
    for interval, foot in ((1, 0), (3, 1)):
        mine = motion.support[:, foot]
        solution = model.solve(q[mine], v[mine], a[mine], interval)
        np.testing.assert_allclose(solution.torque, expected.torque[mine], atol=1e-12)
        np.testing.assert_allclose(solution.multipliers, expected.wrench[mine, foot], atol=1e-12)


def test_double_support_balances_and_no_other_solution_has_less_torque():
    q, still, model = standing(), np.zeros(18), ExplicitModel()
    solution = model.solve(q, still, still, 2)
    right = model.A_tau(q) @ solution.torque + model.Gamma(q, solution.multipliers, 2)
    np.testing.assert_allclose(right, model.C(q), atol=1e-12)
    jacobian = model.dPhi_dq(q, 2)
    nothing = np.linalg.svd(jacobian[:, :6].T)[2][6:]  # λ that leave the torso rows alone
    for direction in nothing:
        change = -jacobian[:, 6:].T @ direction
        assert abs(change @ solution.torque) < 1e-10


def test_printed_4_23_has_no_solution_and_says_by_how_much():
    still = np.zeros(18)
    model = ExplicitModel(edition="printed")
    for interval in (1, 2, 3):
        with pytest.raises(NoSolution, match=r"8\.814.* N stay unbalanced") as caught:
            model.solve(standing(), still, still, interval)
        assert caught.value.residual == pytest.approx(Specification.read().mass * 9.81)
        assert isinstance(caught.value, BadInput)


def test_the_printed_edition_differs_and_lists_the_lines_that_can_not_be_followed():
    q, v = standing() + 0.1, np.full(18, 0.3)
    printed, corrected = ExplicitModel(edition="printed"), ExplicitModel()
    assert np.abs(printed.V(q, v) - corrected.V(q, v)).max() > 1e-4
    assert np.abs(printed.D(q) - corrected.D(q)).max() > 1e-2
    assert "scout:4.1:omega_62" in printed.substituted
    assert "17" in printed.substituted["scout:4.1:omega_62"]
    corrected.D(q)
    assert corrected.substituted == {}


def test_one_state_and_a_batch_give_the_same():
    rng = np.random.default_rng(6)
    q, v = rng.uniform(-1, 1, (2, 3, 18)), rng.uniform(-1, 1, (2, 3, 18))
    model = ExplicitModel()
    assert model.D(q).shape == (2, 3, 18, 18)
    assert model.C(q).shape == (2, 3, 18)
    np.testing.assert_allclose(model.V(q, v)[1, 2], model.V(q[1, 2], v[1, 2]), atol=1e-14)
    np.testing.assert_allclose(model.A_tau(q)[0, 1], model.A_tau(q[0, 1]), atol=1e-14)
    assert model.Phi(q, 2).shape == (2, 3, 12)


def test_bad_requests_are_refused():
    with pytest.raises(UnknownName):
        ExplicitModel(edition="draft")
    with pytest.raises(UnknownName):
        ExplicitModel(inertia="guessed")
    with pytest.raises(UnknownName):
        ExplicitModel().dPhi_dq(standing(), 4)
    with pytest.raises(BadInput):
        ExplicitModel().D(np.zeros(17))
