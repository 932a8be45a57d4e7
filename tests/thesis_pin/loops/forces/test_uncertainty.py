"""Noise of a file's directions near singular poses where no equation depends on others."""

import mechanisms as m
import numpy as np
import pinocchio as pin
import pytest

from thesis_pin.errors import SingularPose, ThesisPinError
from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.model.formats.rounding import rounding
from thesis_pin.model.formats.urdf.reading import read_urdf


def weakest(robot, q):
    matrix = robot.scale.rows[:, None] * loops.jacobian(robot, q) * robot.scale.columns
    return np.linalg.svd(matrix[:, robot.passive], compute_uv=False)[-1]


@pytest.fixture(scope="module")
def towards_singular():
    """States of the 3-RRS nearer and nearer to a pose where its motors lose control."""
    robot, guess = m.built("three_rrs")
    q = loops.close(robot, guess)
    random, step, states = np.random.default_rng(1), 0.1, []
    value = weakest(robot, q)
    targets = [3e-2, 3e-3, 1e-3, 3e-4]
    for _ in range(600):
        if not targets:
            break
        way = step * random.normal(size=3)
        try:
            tried = loops.close(robot, q, q[robot.actuated_q] + way)
        except ThesisPinError:
            continue
        if np.abs(tried - q).max() < 1.0 and (lower := weakest(robot, tried)) < value:
            q, value = tried, lower
        else:
            step = max(0.9 * step, 0.3 * value)
        if value < 1.3 * targets[0]:
            targets.pop(0)
            states.append((value, q))
    assert not targets
    rates = 1e-3 * random.normal(size=(1, 3))
    motions = [
        loops.follow(robot, [0.0], q[None, robot.actuated_q], rates, 0 * rates, q)
        for _, q in states
    ]
    torques = [
        m.projected_torque(robot, 6, motion.q[0], motion.v[0], motion.a[0]) for motion in motions
    ]
    return [(value, q, rates, torque) for (value, q), torque in zip(states, torques, strict=True)]


@pytest.mark.parametrize("noise", [1e-9, 1e-7, 1e-5])
def test_the_error_is_within_the_uncertainty_or_refused(towards_singular, noise):
    answers = refusals = 0
    for _, q, rates, torque in towards_singular:
        for seed in range(4):
            robot, _ = m.built("three_rrs", noise=noise, seed=seed)
            try:
                motion = loops.follow(robot, [0.0], q[None, robot.actuated_q], rates, 0 * rates, q)
                got = dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
            except ThesisPinError:
                refusals += 1
                continue
            error = np.abs(got.torque[0] - torque).max() / np.abs(torque).max()
            assert error <= got.uncertainty[0]
            assert got.uncertainty[0] <= max(10 * error, 1e-3)
            assert got.digits[0].startswith("axis of")
            answers += 1
    assert answers >= 8
    assert bool(refusals) == (noise > 1e-8)


def test_what_is_refused_names_the_directions(towards_singular):
    _, q, rates, _ = towards_singular[-1]
    robot, _ = m.built("three_rrs", noise=1e-5)
    guess = loops.close(robot, q)
    motion = loops.follow(robot, [0.0], guess[None, robot.actuated_q], rates, 0 * rates, guess)
    with pytest.raises(SingularPose, match=r"nearly round in the file: axis of \w+, off by"):
        dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)


def test_an_exact_robot_is_answered_there(towards_singular):
    robot, _ = m.built("three_rrs")
    assert robot.rounding is None
    for value, q, rates, torque in towards_singular:
        motion = loops.follow(robot, [0.0], q[None, robot.actuated_q], rates, 0 * rates, q)
        got = dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
        np.testing.assert_allclose(got.torque[0], torque, atol=1e-9 / value**2)
        assert got.uncertainty[0] < 1e-2
        assert got.digits == ()


def test_a_turn_of_the_whole_robot_does_no_harm_near_a_singular_pose(towards_singular):
    """Gravity leans by as much; nothing is amplified."""
    tree, _ = m.three_rrs()
    tree.links.insert(0, '<link name="floor"/>')
    tree.joints.append(
        '<joint name="lean" type="fixed"><parent link="floor"/><child link="ground"/>'
        '<origin xyz="0 0 0" rpy="0.0005 0 0"/></joint>'
    )
    robot = tree.robot()
    assert robot.rounding.noise == pytest.approx(5e-4, rel=1e-3)
    for value, q, rates, _ in towards_singular:
        motion = loops.follow(robot, [0.0], q[None, robot.actuated_q], rates, 0 * rates, q)
        got = dynamics.inverse_dynamics(robot, motion.q, motion.v, motion.a)
        assert got.uncertainty[0] < 1e-2
        assert value > 0.02 or 5 * robot.rounding.noise / value**2 > 10


def urdf(axis="0 0 1", rpy="0 0 0"):
    entries = 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"'
    inertial = f'<inertial><mass value="1"/><inertia {entries}/></inertial>'
    return read_urdf(
        f'<robot name="r"><link name="a"/><link name="b">{inertial}</link>'
        '<joint name="j" type="continuous"><parent link="a"/><child link="b"/>'
        f'<origin xyz="0 0 0" rpy="{rpy}"/><axis xyz="{axis}"/></joint></robot>'
    )


@pytest.mark.parametrize(
    ("given", "off", "axis"),
    [
        ("1e-5 0 1", 1e-5, (0, 0, 1)),
        ("0 -1 3e-8", 3e-8, (0, -1, 0)),
        ("0.7071 0.70711 0", 7e-6, (0.5**0.5, 0.5**0.5, 0)),
        ("-0.8660 0.5 0", 1.3e-5, (-(0.75**0.5), 0.5, 0)),
        ("2e-9 0 -2", 1e-9, (0, 0, -1)),
    ],
)
def test_axes_a_little_off_a_multiple_of_15_degrees_are_made_round(given, off, axis):
    found = rounding(urdf(axis=given))
    assert found.noise == pytest.approx(off, rel=0.1)
    np.testing.assert_allclose(found.description.joints["j"].axis, axis, atol=1e-15)


@pytest.mark.parametrize("given", ["0 0 1", "0.6 0 0.8", "1e-12 0 1", "0.002 0 1", "1 1 1"])
def test_axes_that_are_round_or_meant_are_left_alone(given):
    assert rounding(urdf(axis=given)) is None


@pytest.mark.parametrize(
    ("rpy", "off", "angles"),
    [
        ("1.5708 0 0", 3.673e-6, (np.pi / 2, 0, 0)),
        ("0.3 0 -2.0944", 4.9e-6, (0.3, 0, -2 * np.pi / 3)),
        ("0.3 1.57079 0.3", 6.3e-6, (0.0, np.pi / 2, 0)),
    ],
)
def test_turns_a_little_off_a_multiple_of_15_degrees_are_made_round(rpy, off, angles):
    found = rounding(urdf(rpy=rpy))
    assert found.noise == pytest.approx(off, rel=0.1)
    turn = found.description.joints["j"].placement[:3, :3]
    np.testing.assert_allclose(turn, pin.rpy.rpyToMatrix(*angles), atol=1e-12)


@pytest.mark.parametrize("rpy", ["0.3 0.2 0.1", "1.5707963267948966 0 0", "1.5688 0 0"])
def test_turns_that_are_round_or_meant_are_left_alone(rpy):
    assert rounding(urdf(rpy=rpy)) is None
