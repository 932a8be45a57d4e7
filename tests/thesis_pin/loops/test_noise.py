"""Files with finite digits: axes and origins that are off a little, against the exact mechanism."""

import mechanisms as m
import numpy as np
import pytest

from thesis_pin.errors import BadInput, ModelError, SingularPose, ThesisPinError
from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops

MOTION = {}


def motion_of(name):
    """Motor motion of the exact mechanism, its joints and torques by null-space projection."""
    if name not in MOTION:
        robot, guess = m.built(name)
        start = loops.close(robot, guess)
        time = np.linspace(0.0, 1.0, 4)
        home = start[robot.actuated_q]
        phase = np.arange(len(home)) + 2 * time[:, None]
        swing = home + 0.15 * (np.sin(phase) - np.sin(phase[0]))
        motors = (time, swing, 0.3 * np.cos(phase), -0.6 * np.sin(phase))
        motion = loops.follow(robot, *motors, start)
        rank = m.RANKS[name][1]
        samples = zip(motion.q, motion.v, motion.a, strict=True)
        torque = np.array([m.projected_torque(robot, rank, *sample) for sample in samples])
        MOTION[name] = robot, start, motors, motion, torque
    return MOTION[name]


def law(name, noise):
    return max(1e-12, 100 * noise**2) if name in m.PLANAR else max(1e-9, 50 * noise)


@pytest.mark.parametrize("noise", [0.0, 1e-9, 4e-8, 1e-6, 1e-5])
@pytest.mark.parametrize("name", m.EVERY)
def test_axes_off_by_up_to_1e_5_rad_are_answered_and_right(name, noise):
    _, start, motors, motion, torque = motion_of(name)
    for seed in range(1 if noise == 0.0 else 2):
        robot, _ = m.built(name, noise=noise, seed=seed)
        found = loops.follow(robot, *motors, start)
        got = dynamics.inverse_dynamics(robot, found.q, found.v, found.a)
        error = np.abs(got.torque - torque).max() / np.abs(torque).max()
        assert error <= law(name, noise)
        assert (robot.equations, robot.surveys[0][1].rank) == m.RANKS[name]
        assert got.unexplained.max() < 1e-6
        assert got.gaps.max() <= 30 * noise + 1e-12
        # Forward dynamics of the exact mechanism is held against Pinocchio's in test_forward.
        pushed = 0.3 * torque[-1]
        exact = dynamics.forward_dynamics(MOTION[name][0], motion.q[-1], motion.v[-1], pushed)
        moved = dynamics.forward_dynamics(robot, found.q[-1], found.v[-1], pushed)
        driven = robot.actuated
        error = np.abs(moved - exact)[driven].max() / np.abs(exact[driven]).max()
        assert error <= law(name, noise)


@pytest.mark.parametrize(("noise", "seed"), [(1e-5, 14), (3e-5, 2), (3e-5, 7), (3e-5, 8)])
def test_between_closed_poses_noise_may_look_real(noise, seed):
    """A step's curvature lifts the dependent equation of these above the cut on the way."""
    _, start, motors, _, torque = motion_of("bennett")
    robot, _ = m.built("bennett", noise=noise, seed=seed)
    found = loops.follow(robot, *motors, start)
    got = dynamics.inverse_dynamics(robot, found.q, found.v, found.a)
    assert np.abs(got.torque - torque).max() <= law("bennett", noise) * np.abs(torque).max()


@pytest.mark.parametrize("noise", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("name", m.EVERY)
def test_axes_off_by_more_are_right_or_refused_never_silently_wrong(name, noise):
    _, start, motors, _, torque = motion_of(name)
    for seed in range(2):
        robot, _ = m.built(name, noise=noise, seed=seed)
        try:
            found = loops.follow(robot, *motors, start)
            got = dynamics.inverse_dynamics(robot, found.q, found.v, found.a)
        except ThesisPinError:
            continue
        assert np.abs(got.torque - torque).max() <= law(name, noise) * np.abs(torque).max()


@pytest.mark.parametrize("name", [*m.PLANAR, "bennett", "sarrus"])
def test_origins_off_by_a_micrometre_are_answered_within_the_reported_uncertainty(name):
    _, start, motors, _, torque = motion_of(name)
    for seed in range(3):
        robot, _ = m.built(name, origin_noise=1e-6, seed=seed)
        found = loops.follow(robot, *motors, start)
        got = dynamics.inverse_dynamics(robot, found.q, found.v, found.a)
        error = np.abs(got.torque - torque).max(axis=1) / np.abs(torque).max(axis=1)
        assert (error < 1e-3).all()
        # A Sarrus linkage's dependent equation doesn't feel where its axes stand.
        assert name == "sarrus" or (error <= got.uncertainty).all()


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_robots_size_changes_nothing(size):
    for noise in (0.0, 1e-6):
        tree, guess = m.four_bar(size=size, noise=noise)
        robot = tree.robot()
        loops.close(robot, guess)
        found = robot.surveys[0][1]
        assert (found.rank, found.freedom, found.moves) == (2, 1, True)
        assert found.weakest == pytest.approx(0.33, rel=0.05)
        assert found.noise == pytest.approx(max(noise, 1e-11), rel=2.0)


@pytest.mark.parametrize("noise", [0.0, 1e-6])
def test_a_structure_moves_not_at_all(noise):
    tree, guess = m.triangle(noise=noise)
    robot = tree.robot()
    q = loops.close(robot, guess)
    found = loops.mobility(robot, q)
    assert (found.freedom, found.held) == (0, 0)
    with pytest.raises(BadInput, match="moves not at all"):
        dynamics.inverse_dynamics(robot, q, [1e-3, -1e-3], np.zeros(2))


def test_bars_in_one_line_move_only_infinitesimally():
    """The Jacobian alone would say one degree of freedom."""
    tree, guess = m.flat_two_bar()
    robot = tree.robot()
    q = loops.close(robot, guess)
    matrix = loops.jacobian(robot, q)
    assert np.linalg.matrix_rank(matrix, tol=1e-9) == 1
    found = loops.mobility(robot, q)
    assert (found.freedom, found.moves) == (0, False)
    motion = np.linalg.svd(matrix)[2][-1]
    with pytest.raises(BadInput, match="moves only infinitesimally"):
        dynamics.inverse_dynamics(robot, q, motion, np.zeros(2))
    with pytest.raises(SingularPose, match="only infinitesimally"):
        dynamics.forward_dynamics(robot, q, np.zeros(2), [0.1])


def tilted(angle):
    """A four-bar whose rocker pivot leans by an angle."""
    tree, guess = m.four_bar()
    lean = f'<axis xyz="{np.sin(angle)!r} 0.0 {np.cos(angle)!r}"/>'.replace("np.float64(", "")
    parts = tree.joints[2].split('<axis xyz="0.0 0.0 1.0"/>')
    assert len(parts) == 2
    tree.joints[2] = lean.replace(")", "").join(parts)
    return tree.robot(), guess


def test_a_small_tilt_counts_as_none_and_says_so():
    robot, guess = tilted(5e-5)
    found = loops.mobility(robot, loops.close(robot, guess))
    assert found.freedom == 1
    assert found.by_tolerance
    assert found.noise == pytest.approx(5e-5, rel=0.6)


def test_precision_zero_takes_every_equation_as_real():
    robot, guess = tilted(5e-5)
    motion = loops.follow(robot, [0.0], [[0.8]], [[1.0]], [[0.0]], guess)
    dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
    with pytest.raises(BadInput, match=r"moves not at all|stay open"):
        dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a, precision=0)


def test_what_nobody_can_tell_is_refused_until_precision_decides():
    robot, guess = m.built("five_bar", noise=1e-3)
    with pytest.raises(ModelError, match="nearly dependent") as caught:
        loops.close(robot, guess)
    assert f"precision: 0 if every equation is real, {caught.value.precision:.0e} if" in (
        caught.value.remedy
    )
    q = loops.close(robot, guess, precision=5e-3)
    assert loops.mobility(robot, q, precision=5e-3).freedom == 2


@pytest.mark.parametrize("angle", [1e-3, 5e-3, 5e-2])
def test_a_pivot_that_leans_by_a_milliradian_is_refused(angle):
    robot, guess = tilted(angle)
    with pytest.raises(BadInput, match=r"stay open|nearly dependent"):
        loops.close(robot, guess)


@pytest.mark.parametrize("wrong", [1e-3, 1e-2, 0.1])
def test_a_bennett_linkage_with_a_wrong_twist_is_refused(wrong):
    tree, guess = m.bennett(wrong=wrong)
    robot = tree.robot()
    with pytest.raises(BadInput):
        loops.follow(robot, [0.0], [guess[:1]], [[0.5]], [[0.0]], guess)


def near_straight(distance, **noise):
    """A five-bar whose rods are a small angle from one line, and its motion there."""
    span = 0.6 * np.cos(distance / 2)
    lift = np.arccos((span - 0.2) / 0.4)
    motors = np.array([np.pi - lift, lift])
    tilt = distance / 2
    guess = np.array([motors[0], tilt - motors[0], motors[1], np.pi - tilt - motors[1]])
    robot, _ = m.built("five_bar", **noise)
    rates = np.array([[0.3, -0.2]]) * distance
    motion = loops.follow(robot, [0.0], motors[None], rates, 0 * rates, guess)
    return robot, (motion.q[0], motion.v[0], motion.a[0])


@pytest.mark.parametrize("distance", [0.3, 3e-2, 3e-3, 1e-4])
@pytest.mark.parametrize("kind", ["noise", "origin_noise"])
def test_near_a_singularity_the_error_is_within_the_uncertainty_or_refused(kind, distance):
    robot, state = near_straight(distance)
    torque = m.projected_torque(robot, 2, *state)
    for noise in (1e-9, 1e-7, 1e-5):
        for seed in range(3):
            try:
                other, moved = near_straight(distance, **{kind: noise, "seed": seed})
                got = dynamics.inverse_dynamics(other, *moved)
            except ThesisPinError:
                continue
            error = np.abs(got.torque - torque).max() / np.abs(torque).max()
            assert error <= got.uncertainty


def test_a_true_singularity_stays_one():
    tree, _ = m.parallelogram()
    robot = tree.robot()
    flat = loops.close(robot, [0.5, -0.5, 0.5, 0.5], [0.0])
    with pytest.raises(SingularPose):
        dynamics.inverse_dynamics(robot, flat, np.zeros(4), np.zeros(4))
    instant = dynamics.inverse_dynamics(robot, flat, np.zeros(4), np.zeros(4), check=False)
    assert instant.freedom > 1


def slider(size=1.0, **noise):
    """A crank on the ground pushed by a sliding motor: metres beside radians."""
    tree = m.Tree(**noise)
    tree.link(
        "slide",
        "ground",
        (1, 0, 0),
        turn=m.UPRIGHT,
        bar=(0.05 * size,) * 3,
        type="prismatic",
        motor=True,
    )
    tree.link("rod", "slide", (0, 0, 1), bar=(0.3 * size, 0, 0))
    tree.link("crank", "ground", (0, 0, 1), (0.5 * size, 0, 0), m.UPRIGHT, bar=(0.2 * size, 0, 0))
    tree.frame("rod_tip", "rod", (0.3 * size, 0, 0))
    tree.frame("crank_tip", "crank", (0.2 * size, 0, 0))
    tree.loop("rod_tip", "crank_tip")
    return tree.robot(), [2.4, 0.15 * size, 0.5]


def test_scaled_equations_know_no_size():
    matrices = []
    for size in (1e-3, 1.0, 1e3):
        robot, q = slider(size)
        matrix = loops.jacobian(robot, q)
        matrices.append(robot.scale.rows[:, None] * matrix * robot.scale.columns)
    np.testing.assert_allclose(matrices[0], matrices[1], atol=1e-12)
    np.testing.assert_allclose(matrices[2], matrices[1], atol=1e-12)
    assert np.abs(matrices[1]).max() == pytest.approx(1.0, abs=0.5)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_sliding_motors_are_right_at_every_size(size):
    robot, guess = slider(size)
    motion = loops.follow(robot, [0.0], [[guess[1]]], [[0.2 * size]], [[0.1 * size]], guess)
    state = motion.q[0], motion.v[0], motion.a[0]
    exact = m.projected_torque(robot, 2, *state)
    np.testing.assert_allclose(dynamics.inverse_dynamics(robot, *state).torque, exact, rtol=1e-10)
    other, _ = slider(size, noise=1e-6)
    motion = loops.follow(other, [0.0], [[guess[1]]], [[0.2 * size]], [[0.1 * size]], guess)
    got = dynamics.inverse_dynamics(other, motion.q[0], motion.v[0], motion.a[0]).torque
    np.testing.assert_allclose(got, exact, rtol=5e-5)
    assert [one.surveys[0][1].rank for one in (robot, other)] == [2, 2]
    assert 0.1 < other.surveys[0][1].weakest < 1.0
    again = dynamics.forward_dynamics(robot, *state[:2], exact)
    np.testing.assert_allclose(again, state[2], rtol=1e-8, atol=1e-9 * size)
