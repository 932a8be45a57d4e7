"""Inverse and forward dynamics against Pinocchio, energy and the general solver."""

from dataclasses import replace

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pollard_pin
from pollard_pin import USEFUL_BRANCHES
from pollard_pin.dynamics.forces import loads
from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.dynamics.reactions import joint_reactions
from pollard_pin.dynamics.three_motors import three_torques
from pollard_pin.kinematics.linkage import Linkage
from pollard_pin.motion.curves import line
from pollard_pin.specification import ACTUATORS
from pollard_pin.urdf import JOINT_AXES
from thesis_pin.errors import BadInput, SingularPose
from thesis_pin.loops import dynamics as loop_dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.numeric.elementwise import ARRAYS, FLOATS

from ..conftest import closed_motion


@pytest.mark.parametrize("branch", USEFUL_BRANCHES[::3])
def test_torques_and_forces_satisfy_the_equations_of_motion(robot, rng, branch):
    """KKT: M a + h = B τ + Aᵀ λ, with A and the force's frame from Pinocchio."""
    _, _, _, q, v, a = closed_motion(robot, rng, 60, branch)
    found = inverse_dynamics_at(robot, q, v, a)
    data = robot.model.createData()
    for k in range(len(q)):
        tau = pin.rnea(robot.model, data, q[k], v[k], a[k])
        rest = tau.copy()
        rest[list(ACTUATORS)] -= found.torque[k]
        pin.computeJointJacobians(robot.model, data, q[k])
        pin.updateFramePlacements(robot.model, data)
        for i in (1, 2):
            for name, sign in ((f"forearm_anchor_{i}", 1), (f"chain{i}_rod_tip", -1)):
                jacobian = pin.getFrameJacobian(
                    robot.model,
                    data,
                    robot.model.getFrameId(name),
                    pin.ReferenceFrame.LOCAL_WORLD_ALIGNED,
                )
                rest -= sign * jacobian[:3].T @ found.loop_force[k, i - 1]
        size = np.abs(tau).max() + np.abs(found.loop_force[k]).max()
        assert np.abs(rest).max() < 1e-10 * max(size, 1.0)


def test_the_fast_solution_is_the_general_one(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 100)
    fast = inverse_dynamics_at(robot, q, v, a)
    general = loop_dynamics.inverse_dynamics(robot, q, v, a)
    size = 1 + np.abs(fast.loop_force).max(axis=(1, 2))
    assert (np.abs(fast.torque - general.torque).max(axis=1) / size).max() < 1e-11
    assert (np.abs(fast.loop_force - general.force).max(axis=(1, 2)) / size).max() < 1e-11
    assert general.residual.max() < 1e-10
    assert (general.freedom == 6).all()
    assert general.unique.all()
    assert general.determined.all()


def test_constraint_dynamics_returns_the_accelerations(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 60)
    torque = inverse_dynamics_at(robot, q, v, a).torque
    again = robot.forward_dynamics(q, v, torque)
    scale = np.abs(a).max(axis=1)
    assert (np.abs(again - a).max(axis=1) / scale).max() < 1e-8


def test_motor_power_is_the_rate_of_energy(robot, rng):
    """Whatever the loops do inside, they do no work."""
    poses, rate, acceleration, q, v, a = closed_motion(robot, rng, 50, away=0.3)
    power = (inverse_dynamics_at(robot, q, v, a).torque * v[:, ACTUATORS]).sum(axis=1)
    step = 1e-5

    def energy(t):
        there, now = poses + t * rate + t * t / 2 * acceleration, rate + t * acceleration
        q, v, _ = robot.joint_motion(there, now)
        return robot.energy(q, v)

    numeric = (energy(step) - energy(-step)) / (2 * step)
    assert (np.abs(numeric - power) / (1 + np.abs(power))).max() < 1e-5


def test_reactions_balance_every_link_and_carry_the_motor_torque(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 30)
    found = inverse_dynamics_at(robot, q, v, a)
    wrench = joint_reactions(robot, q, v, a, found.loop_force)
    axis = ["xyz".index(letter) for letter in JOINT_AXES]
    along = wrench[:, np.arange(12), [3 + k for k in axis]]
    expected = np.zeros((30, 12))
    expected[:, ACTUATORS] = found.torque
    size = 1 + np.abs(found.loop_force).max()
    np.testing.assert_allclose(along, expected, atol=1e-11 * size)


def test_base_reactions_carry_the_weight_at_rest(robot, rng):
    _, _, _, q, _, _ = closed_motion(robot, rng, 10)
    zero = np.zeros_like(q)
    found = inverse_dynamics_at(robot, q, zero, zero)
    wrench = joint_reactions(robot, q, zero, zero, found.loop_force)
    data = robot.model.createData()
    for k in range(10):
        pin.forwardKinematics(robot.model, data, q[k])
        total = sum(
            data.oMi[joint].rotation @ wrench[k, joint - 1, :3]
            for joint in (1, robot.model.getJointId("chain1_shoulder"), 10)
        )
        np.testing.assert_allclose(total, [0, 0, 9.81 * robot.mass], atol=1e-10)


ANGLE, RATE = st.floats(-0.3, 0.3), st.floats(-2, 2)


@settings(max_examples=40, deadline=None)
@given(
    st.tuples(st.floats(0.38, 0.52), st.floats(-0.1, 0.1), st.floats(-0.05, 0.1)),
    st.tuples(ANGLE, ANGLE, ANGLE),
    st.tuples(*[RATE] * 6),
    st.tuples(*[RATE] * 6),
)
def test_torques_are_the_same_backwards_in_time_and_linear_in_acceleration(
    place, turn, rate, acceleration
):
    robot = pollard_pin.load()
    pose, rate, acceleration = map(np.array, ((*place, *turn), rate, acceleration))
    q, v, a = robot.joint_motion(pose, rate, acceleration)
    _, back, same = robot.joint_motion(pose, -rate, acceleration)
    np.testing.assert_allclose(back, -v, atol=1e-12)
    np.testing.assert_allclose(same, a, atol=1e-9 * (1 + np.abs(a).max()))
    forth = inverse_dynamics_at(robot, q, v, a).torque
    size = 1 + np.abs(forth).max()
    np.testing.assert_allclose(inverse_dynamics_at(robot, q, -v, a).torque, forth, atol=1e-9 * size)
    # Torques with no, half and whole tool acceleration lie on a line.
    torques = [
        inverse_dynamics_at(robot, *robot.joint_motion(pose, rate, k * acceleration)).torque
        for k in (0.0, 0.5, 1.0)
    ]
    np.testing.assert_allclose(torques[1], (torques[0] + torques[2]) / 2, atol=1e-9 * size)


def test_a_mirrored_motion_mirrors_the_torques():
    """Symmetric about y = 0 but for the forearm's printed product of −5.176 kg·mm²."""
    data = pollard_pin.Specification.read().model_dump()
    forearm = data["assumptions"]["replaced_inertias"][0]
    forearm["inertia"] = tuple(tuple(row) for row in np.diag(np.diag(forearm["inertia"])).tolist())
    pollard = pollard_pin.load(pollard_pin.Specification.model_validate(data))
    pose = np.array([0.45, 0.08, 0.03, 0.2, 0.1, -0.3])
    mirror = np.array([1, -1, 1, 1, -1, -1])
    q, v, a = pollard.joint_motion(pose, np.zeros(6), np.ones(6) * 0.5)
    other = pollard.joint_motion(pose * mirror, np.zeros(6), np.ones(6) * 0.5 * mirror)
    one, two = inverse_dynamics_at(pollard, q, v, a), inverse_dynamics_at(pollard, *other)
    assert one.torque[0] == pytest.approx(two.torque[0], abs=1e-12)
    assert one.torque[1] == pytest.approx(-two.torque[2], abs=1e-12)
    assert one.torque[2] == pytest.approx(-two.torque[1], abs=1e-12)


def test_three_motors_leave_part_of_the_load_unexplained(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 30)
    found = inverse_dynamics_at(robot, q, v, a)
    three = three_torques(robot.rate_jacobian(q), found.joint_force)
    assert three.torque.shape == (30, 3)
    # Six motors explain everything: J_actᵀ τ is the whole generalized force.
    rows = robot.rate_jacobian(q)[:, list(ACTUATORS)]
    explained = np.einsum("nji,nj->ni", rows, found.torque)
    scale = np.abs(three.generalized_force).max(axis=1, keepdims=True)
    assert (np.abs(explained - three.generalized_force) / scale).max() < 1e-9
    # The least-squares residual is orthogonal to what three motors can do.
    product = np.einsum("nij,nj->ni", rows[:, :3], three.missing)
    assert (np.abs(product) / (scale * np.abs(rows).max())).max() < 1e-9
    assert (three.share > 0).all()
    assert np.median(three.share) > 1e-3


def test_the_length_weighs_forces_against_moments(pollard, rng):
    """Least squares over (F ℓ, M), solved here by NumPy's own routine."""
    _, _, _, q, v, a = closed_motion(pollard, rng, 5)
    force = inverse_dynamics_at(pollard, q, v, a).joint_force
    jacobian = pollard.rate_jacobian(q)
    found = three_torques(jacobian, force, length=0.2)
    scale = np.array([0.2] * 3 + [1.0] * 3)
    for k in range(5):
        rows = jacobian[k, list(ACTUATORS[:3])].T * scale[:, None]
        load = jacobian[k].T @ force[k] * scale
        torque, rest, *_ = np.linalg.lstsq(rows, load)
        np.testing.assert_allclose(found.torque[k], torque, rtol=1e-8)
        assert found.share[k] == pytest.approx(np.sqrt(rest[0]) / np.linalg.norm(load), rel=1e-6)


def test_angles_that_open_a_loop_are_refused(pollard):
    q = pollard.inverse_kinematics([0.45, 0, 0.05, 0, 0.1, 0]).angles
    q[1] += 1e-4
    with pytest.raises(BadInput, match="opens a ball joint by"):
        inverse_dynamics_at(pollard, q, np.zeros(12), np.zeros(12))


def test_simulation_keeps_the_loops_closed_and_balances_energy(robot):
    start = robot.inverse_kinematics([0.45, 0.02, 0.05, 0.1, 0.1, 0.1]).angles
    hold = inverse_dynamics_at(robot, start, np.zeros(12), np.zeros(12)).torque

    def torque(t, q, v):
        # Damp the base only: the tool's own inertia is 1e-6 kg·m², too stiff for this step.
        return 0.9 * hold - [0.01, 0.01, 0.01, 0, 0, 0] * v[list(ACTUATORS)]

    motion = robot.simulate(start, np.zeros(12), torque, 0.2, 2e-3)
    assert np.abs(loops.residual(robot, motion.q)).max() < 1e-9
    drift = np.einsum("nij,nj->ni", loops.jacobian(robot, motion.q), motion.v)
    assert np.abs(drift).max() < 1e-9
    applied = np.array([torque(0, q, v) for q, v in zip(motion.q, motion.v, strict=True)])
    power = (applied * motion.v[:, ACTUATORS]).sum(axis=1)
    work = np.trapezoid(power, motion.time)
    change = np.diff(robot.energy(motion.q[[0, -1]], motion.v[[0, -1]]))[0]
    exchanged = np.trapezoid(np.abs(power), motion.time)
    assert abs(work - change) < 1e-4 * exchanged
    assert np.abs(motion.v[-1]).max() > 0.05


def test_simulation_follows_an_inverse_dynamics_feedforward(pollard):
    """Torques of a planned motion, played open loop, give the planned motion."""
    path = line([0.42, -0.03, 0.02, 0, 0, 0], [0.48, 0.04, 0.06, 0.1, 0.2, 0.1], 0.2)

    def planned(t):
        motion = path.at(min(t, path.duration))
        return pollard.joint_motion(motion.pose[0], motion.rate[0], motion.acceleration[0])

    q, v, _ = planned(0.0)
    motion = pollard.simulate(
        q, v, lambda t, *_: inverse_dynamics_at(pollard, *planned(t)).torque, path.duration, 2e-3
    )
    np.testing.assert_allclose(motion.q[-1], planned(path.duration)[0], atol=1e-6)


def test_forces_that_are_not_determined_are_refused(pollard, rng):
    """Two rods that pull in one direction can't be told apart."""
    _, _, _, q, _, _ = closed_motion(pollard, rng, 1)
    geometry, known = pollard.geometry, Linkage.of(pollard.geometry, q.T)
    twins = replace(geometry, anchors=geometry.anchors[[0, 0]])
    same = known._replace(sides=(known.sides[0], known.sides[0]))
    one = Linkage.of(pollard.geometry, q[0].tolist(), FLOATS)
    with pytest.raises(SingularPose, match="one direction"):
        loads(ARRAYS, twins, same, np.ones((12, 1)))
    with pytest.raises(SingularPose, match="one direction"):
        loads(FLOATS, twins, one._replace(sides=(one.sides[0],) * 2), [1.0] * 12)


def test_rates_that_open_a_ball_joint_are_refused(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 20)
    inverse_dynamics_at(robot, q, v, a)  # closed motions pass
    v[7] += 1e-3 * rng.normal(size=12)
    with pytest.raises(BadInput, match="sample 7: the rates open ball joint"):
        inverse_dynamics_at(robot, q, v, a)


def test_accelerations_that_open_a_ball_joint_are_refused(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 10)
    inverse_dynamics_at(robot, q, v, a)
    for joint in (1, 2, 7, 8, 10, 11):
        bent = a.copy()
        bent[6, joint] += 1e-3 * (1 + np.abs(a[6]).max() + np.abs(v[6]).max() ** 2)
        with pytest.raises(BadInput, match="sample 6: the accelerations open ball joint"):
            inverse_dynamics_at(robot, q, v, bent)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("count", [1, 40])
def test_rates_beyond_all_measure_are_refused(pollard, rng, count):
    """Their squares overflow, and what isn't a number isn't closed."""
    _, _, _, q, v, a = closed_motion(pollard, rng, count)
    v[0] *= 1e200
    with pytest.raises(BadInput, match="sample 0: the"):
        inverse_dynamics_at(pollard, q, v, a)


def test_a_single_motion_that_opens_a_ball_joint_is_refused_as_in_a_stack(robot, rng):
    _, _, _, q, v, a = closed_motion(robot, rng, 20)
    inverse_dynamics_at(robot, q[0], v[0], a[0])
    for name, state in (("rates", (q, v + 1e-3, a)), ("accelerations", (q, v, a + 1.0))):
        for some in (0, slice(None)):
            with pytest.raises(BadInput, match=f"sample 0: the {name} open ball joint"):
                inverse_dynamics_at(robot, *(one[some] for one in state))
