"""Kinematics and dynamics of looped robots that aren't ours."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import BadInput, NoSolution, SingularPose, Unreachable
from thesis_pin.loops import dynamics as loop_dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.loading import load

DATA = Path(__file__).parent / "data"
STARTS = {"five_bar": [-1.9, 1.2, -1.2, -1.2], "four_bar": [0.2, -1.3, -1.8, -2.4]}


@pytest.fixture(scope="module", params=STARTS)
def robot(request):
    return load(DATA / f"{request.param}.urdf", DATA / f"{request.param}.yaml")


@pytest.fixture(scope="module")
def five_bar():
    return load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")


def motion_of(robot, count=12, speed=1.0):
    """A smooth closed motion of the motors around the start."""
    name = "five_bar" if len(robot.actuators) == 2 else "four_bar"
    start = loops.close(robot, np.array(STARTS[name]))
    t = np.linspace(0.0, 1.0, count)
    phase = np.arange(len(robot.actuators)) + speed * t[:, None]
    home = start[robot.actuated_q] - 0.2 * np.sin(phase[0])
    return loops.follow(
        robot,
        t,
        home + 0.2 * np.sin(phase),
        0.2 * speed * np.cos(phase),
        -0.2 * speed**2 * np.sin(phase),
        start,
    )


def numeric_jacobian(robot, q, step=1e-6):
    columns = []
    for unit in np.eye(robot.model.nv):
        ahead, behind = (pin.integrate(robot.model, q, s * step * unit) for s in (1, -1))
        columns.append((loops.residual(robot, ahead) - loops.residual(robot, behind)) / (2 * step))
    return np.stack(columns, axis=-1)


@pytest.mark.parametrize("name", ["five_bar", "four_bar", "rssr"])
def test_jacobian_is_plus_the_derivative_of_the_residual_where_the_loop_is_closed(name):
    robot = load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")
    rng = np.random.default_rng(3)
    closed = 0
    while closed < 3:
        guess = pin.integrate(robot.model, robot.q0, rng.uniform(-1.5, 1.5, robot.model.nv))
        try:
            q = loops.close(robot, guess)
        except Unreachable:
            continue
        closed += 1
        np.testing.assert_allclose(loops.jacobian(robot, q), numeric_jacobian(robot, q), atol=1e-8)


def test_jacobian_of_ball_joints_is_the_derivative_in_open_configurations_too(five_bar):
    rng = np.random.default_rng(4)
    for q in rng.uniform(-2, 2, (5, 4)):
        np.testing.assert_allclose(
            loops.jacobian(five_bar, q), numeric_jacobian(five_bar, q), atol=1e-8
        )


def test_jacobian_of_open_welds_is_the_relative_twist_not_the_derivative():
    """Teeth: d log6 differs from the twist, and residual_derivative() corrects for it."""
    robot = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml")
    q = np.array([0.3, 0.5, -0.4, 0.2])
    numeric, twist = numeric_jacobian(robot, q), loops.jacobian(robot, q)
    assert np.abs(twist - numeric).max() > 0.1
    np.testing.assert_allclose(loops.residual_derivative(robot, q), numeric, atol=1e-7)


@pytest.mark.parametrize(("name", "held"), [("five_bar", 2), ("four_bar", 1), ("rssr", 1)])
def test_what_the_motors_hold_is_what_locking_them_takes_away(name, held):
    """With all motors locked, the freedom by rank is what they don't hold."""
    robot = load(DATA / f"{name}.urdf", DATA / f"{name}.yaml")
    q = loops.close(robot, np.array(STARTS.get(name, [0.3] * robot.model.nq)))
    found = loops.mobility(robot, q)
    locked = np.vstack([loops.jacobian(robot, q), np.eye(robot.model.nv)[list(robot.actuated)]])
    left = robot.model.nv - np.linalg.matrix_rank(locked, tol=1e-9)
    assert found.held == held == found.freedom - left


def test_mobility_by_rank_sees_what_counting_misses(five_bar):
    """Planar linkages: 2 and 1 degrees of freedom, where counting in space says 1 and −2."""
    found = loops.mobility(five_bar, loops.close(five_bar, np.array(STARTS["five_bar"])))
    assert (found.freedom, found.independent, found.counted) == (2, 2, 1)
    four = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml")
    found = loops.mobility(four, loops.close(four, np.array(STARTS["four_bar"])))
    assert (found.freedom, found.independent, found.counted) == (1, 3, -2)


def test_closing_holds_the_motors_where_they_are_told(robot):
    start = motion_of(robot).q[0]
    motors = start[robot.actuated_q] + 0.01
    closed = loops.close(robot, start, motors)
    assert np.abs(loops.residual(robot, closed)).max() < 1e-12
    np.testing.assert_array_equal(closed[robot.actuated_q], motors)


def test_motors_that_cannot_be_closed_are_refused(five_bar):
    with pytest.raises(Unreachable, match="stay open"):
        loops.close(five_bar, np.zeros(4), [0.0, np.pi])


def test_following_gives_exact_derivatives(robot):
    fine = motion_of(robot, 2001)
    step = fine.time[1]
    numeric = (fine.q[2:] - fine.q[:-2]) / (2 * step)
    np.testing.assert_allclose(fine.v[1:-1], numeric, atol=1e-6)
    numeric = (fine.v[2:] - fine.v[:-2]) / (2 * step)
    np.testing.assert_allclose(fine.a[1:-1], numeric, atol=1e-5)


def closed_rssr():
    robot = load(DATA / "rssr.urdf", DATA / "rssr.yaml")
    rng = np.random.default_rng(0)
    while True:
        guess = pin.integrate(robot.model, robot.q0, rng.uniform(-1, 1, 5))
        found = loops.close_each(robot, guess)
        if found.closed:
            return robot, found.q


def test_a_rod_that_spins_about_itself_is_named_and_stays_at_rest():
    """The coupler of R-S-S-R spins about itself, whatever the crank does."""
    robot, q = closed_rssr()
    motor = q[robot.actuated_q][None]
    motion = loops.follow(robot, [0.0], motor, motor + 1.0, motor, q)
    spin = np.linalg.svd(loops.jacobian(robot, q)[:, robot.passive])[2][-1]
    assert abs(spin @ motion.v[0, robot.passive]) < 1e-12
    found = loop_dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
    assert found.freedom[0] == 2
    assert np.isinf(found.condition[0])
    (group,) = found.idle
    assert group.joints == ("ball",)
    assert group.freedoms == 1
    assert group.light
    assert found.unexplained[0] < 1e-12


def test_motors_that_leave_a_link_loose_are_refused(tmp_path):
    text = (DATA / "five_bar.yaml").read_text().replace("'motor_right', ", "")
    (tmp_path / "loops.yaml").write_text(text)
    robot = load(DATA / "five_bar.urdf", tmp_path / "loops.yaml")
    q = loops.close(robot, np.array(STARTS["five_bar"]))
    motor = q[robot.actuated_q][None]
    with pytest.raises(SingularPose, match="don't determine the other joints"):
        loops.follow(robot, [0.0], motor, motor, motor, q)


def test_torques_and_forces_satisfy_the_equations_of_motion(robot):
    """KKT residual with the constraint Jacobian built from frame Jacobians, not ours."""
    motion = motion_of(robot, speed=4.0)
    found = loop_dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
    assert found.residual.max() < 1e-10
    data = robot.model.createData()
    axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    for k in range(len(motion.q)):
        rest = pin.rnea(robot.model, data, motion.q[k], motion.v[k], motion.a[k])
        size = np.abs(rest).max()
        rest[robot.actuated] -= found.torque[k]
        pin.computeJointJacobians(robot.model, data, motion.q[k])
        pin.updateFramePlacements(robot.model, data)
        wrench = np.concatenate([found.force[k, 0], found.moment[k, 0]])
        for sign, frame in zip((1, -1), robot.loops[0].ids, strict=True):
            rest -= sign * pin.getFrameJacobian(robot.model, data, frame, axes).T @ wrench
        assert np.abs(rest).max() < 1e-10 * size


def test_constraint_dynamics_returns_the_accelerations(robot):
    motion = motion_of(robot, speed=4.0)
    torque = loop_dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a).torque
    again = loop_dynamics.forward_dynamics(robot, motion.q, motion.v, torque)
    assert np.abs(again - motion.a).max() < 1e-8 * np.abs(motion.a).max()


def test_motor_work_is_the_change_of_energy(robot):
    motion = motion_of(robot, 2001, speed=5.0)
    torque = loop_dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a).torque
    power = (torque * motion.v[:, robot.actuated]).sum(axis=1)

    def energy(k):
        data = robot.model.createData()
        return pin.computeKineticEnergy(
            robot.model, data, motion.q[k], motion.v[k]
        ) + pin.computePotentialEnergy(robot.model, data, motion.q[k])

    exchanged = np.trapezoid(np.abs(power), motion.time)
    work = np.trapezoid(power, motion.time)
    assert abs(work - (energy(-1) - energy(0))) < 1e-5 * exchanged


def test_a_static_five_bar_by_hand():
    """Moments about the left bar's and crank's pins, planar statics on paper."""
    robot = load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")
    q = loops.close(robot, np.array(STARTS["five_bar"]))
    found = loop_dynamics.inverse_dynamics(robot, q, np.zeros(4), np.zeros(4))
    force = found.force[0]
    assert abs(force[1]) < 1e-12
    # Angles turn about y, so a bar at angle θ points along (cos θ, −sin θ) in x and z.
    bar = q[0] + q[1]
    along = np.array([np.cos(bar), -np.sin(bar)])
    # Moment about the elbow: weight at mid-bar and the force at its tip cancel.
    moment = 0.15 * along[0] * -0.25 * 9.81 + 0.3 * (along[0] * force[2] - along[1] * force[0])
    assert moment == pytest.approx(0.0, abs=1e-12)


def test_redundant_motors_share_the_load_and_say_so(tmp_path):
    text = (
        (DATA / "five_bar.yaml").read_text().replace("'motor_left'", "'motor_left', 'elbow_left'")
    )
    (tmp_path / "loops.yaml").write_text(text)
    robot = load(DATA / "five_bar.urdf", tmp_path / "loops.yaml")
    q = loops.close(robot, np.array(STARTS["five_bar"]))
    zero = np.zeros(4)
    found = loop_dynamics.inverse_dynamics(robot, q, zero, zero)
    assert not found.unique
    assert found.residual < 1e-10
    plain = load(DATA / "five_bar.urdf", DATA / "five_bar.yaml")
    two = loop_dynamics.inverse_dynamics(plain, q, zero, zero)
    assert two.unique
    assert np.linalg.norm(found.torque) < np.linalg.norm(two.torque)


def test_a_structure_needs_no_torque_and_says_that_motors_are_not_determined(tmp_path):
    """With both elbows fixed the five-bar is a triangle."""
    text = (DATA / "five_bar.yaml").read_text()
    text += "joint_name: ['elbow_left', 'elbow_right']\njoint_type: ['FIXED', 'FIXED']\n"
    (tmp_path / "loops.yaml").write_text(text)
    robot = load(DATA / "five_bar.urdf", tmp_path / "loops.yaml")
    assert robot.model.nv == 2
    q = loops.close(robot, np.array([-1.4, -1.8]))
    found = loop_dynamics.inverse_dynamics(robot, q, np.zeros(2), np.zeros(2))
    assert found.freedom == 0
    assert not found.unique
    assert np.abs(found.torque).max() == 0.0
    assert found.residual < 1e-10


def test_too_few_motors_are_refused_with_the_load_they_leave(tmp_path):
    text = (DATA / "five_bar.yaml").read_text().replace("'motor_right', ", "")
    (tmp_path / "loops.yaml").write_text(text)
    robot = load(DATA / "five_bar.urdf", tmp_path / "loops.yaml")
    q = loops.close(robot, np.array(STARTS["five_bar"]))
    with pytest.raises(NoSolution, match="1 motors for 2 freedoms"):
        loop_dynamics.inverse_dynamics(robot, q, np.zeros(4), np.zeros(4))
    found = loop_dynamics.inverse_dynamics(robot, q, np.zeros(4), np.zeros(4), check=False)
    assert found.residual > 1e-2
    assert found.unexplained == found.residual
    assert np.isinf(found.condition)


@pytest.mark.parametrize(
    ("part", "says"), [(0, "opening is"), (1, "opening rate is"), (2, "opening acceleration is")]
)
def test_a_motion_that_opens_the_loop_is_refused(five_bar, part, says):
    motion = motion_of(five_bar, 2)
    state = [motion.q.copy(), motion.v.copy(), motion.a.copy()]
    state[part][1, 1] += 1e-3
    with pytest.raises(BadInput, match=f"sample 1: .*{says}"):
        loop_dynamics.inverse_dynamics(five_bar, *state)
    loop_dynamics.inverse_dynamics(five_bar, *state, check=False)


def test_falling_freely_the_loop_stays_closed_and_energy_is_kept(robot):
    start = motion_of(robot, 2)
    free = np.zeros(len(robot.actuators))
    motions = [
        loop_dynamics.simulate(robot, start.q[0], start.v[0], lambda *_: free, 0.2, step)
        for step in (4e-3, 2e-3)
    ]

    def drift(motion):
        data = robot.model.createData()
        values = [
            pin.computeKineticEnergy(robot.model, data, q, v)
            + pin.computePotentialEnergy(robot.model, data, q)
            for q, v in zip(motion.q[[0, -1]], motion.v[[0, -1]], strict=True)
        ]
        return abs(values[1] - values[0])

    for motion in motions:
        assert np.abs(loops.residual(robot, motion.q)).max() < 1e-9
        rate = np.einsum("nij,nj->ni", loops.jacobian(robot, motion.q), motion.v)
        assert np.abs(rate).max() < 1e-9
        assert motion.time[-1] == 0.2
    assert np.abs(motions[0].v[-1]).max() > 0.5
    # Order four: halving the step takes the error down at least eightfold.
    assert drift(motions[1]) < max(drift(motions[0]) / 8, 1e-12)


@pytest.mark.parametrize(("duration", "step"), [(0.0, 1e-3), (1.0, 0.0), (np.inf, 1e-3)])
def test_a_simulation_without_end_or_step_is_refused(five_bar, duration, step):
    q = loops.close(five_bar, np.array(STARTS["five_bar"]))
    with pytest.raises(BadInput, match=r"(duration|step) is"):
        loop_dynamics.simulate(five_bar, q, np.zeros(4), lambda *_: np.zeros(2), duration, step)


def test_a_simulation_from_an_open_configuration_is_refused(five_bar):
    with pytest.raises(BadInput, match="loops are open"):
        loop_dynamics.simulate(five_bar, np.zeros(4), np.zeros(4), lambda *_: np.zeros(2), 1.0)
