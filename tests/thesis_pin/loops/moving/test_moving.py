"""One coordinate moves, the loops stay closed, and where they can't the robot stays."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from mechanisms import built, four_bar

from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.loading import load
from thesis_pin.loops.moving import moving
from thesis_pin.loops.moving.coordinates import coordinates
from thesis_pin.loops.moving.moving import move

NAMES = ("four_bar", "five_bar", "three_rrs", "delta", "bennett")


DATA = Path(__file__).parents[1] / "data"


def closed(name):
    """A mechanism and a closed configuration of it."""
    robot, guess = built(name)
    return robot, close(robot, guess)


def opening(robot, q):
    """The widest gap of a robot's loops [m], by Pinocchio's frames alone."""
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    ends = [[data.oMf[k].translation for k in loop.ids] for loop in robot.loops]
    return max(float(np.linalg.norm(one - two)) for one, two in ends)


@pytest.mark.parametrize("name", NAMES)
def test_loops_stay_closed_and_the_moved_joint_is_where_it_was_told(name):
    robot, q = closed(name)
    random = np.random.default_rng(5)
    every = coordinates(robot.model)
    reached = 0
    for _ in range(25):
        one = every[random.integers(len(every))]
        value = one.value(q) + random.uniform(-0.2, 0.2)
        found = move(robot, q, one, value)
        assert opening(robot, found.q) < 1e-9
        if found.reached:
            assert one.value(found.q) == pytest.approx(value, abs=1e-9)
            reached += 1
        else:
            assert found.why
        q = found.q
    assert reached > 8


def test_other_motors_stand_still_while_one_moves():
    robot, q = closed("five_bar")
    every = {one.name: one for one in coordinates(robot.model)}
    first, second = (every[name] for name in robot.actuators)
    found = move(robot, q, first, first.value(q) + 0.3)
    assert found.reached
    assert second.value(found.q) == pytest.approx(second.value(q), abs=1e-12)


def test_a_joint_without_motor_takes_the_motors_with_it():
    robot, q = closed("four_bar")
    every = {one.name: one for one in coordinates(robot.model)}
    passive = next(one for name, one in every.items() if name not in robot.actuators)
    found = move(robot, q, passive, passive.value(q) + 0.1)
    assert found.reached
    crank = every[robot.actuators[0]]
    assert abs(crank.value(found.q) - crank.value(q)) > 1e-3


def test_what_cannot_close_stops_at_the_last_pose_that_does_and_says_why():
    robot, q = closed("four_bar")
    one = next(c for c in coordinates(robot.model) if c.name.startswith("rocker"))
    found = move(robot, q, one, one.value(q) + 3.0)  # Grashof: the crank turns, the rocker swings
    assert not found.reached
    assert "open" in found.why or "assembly" in found.why
    assert opening(robot, found.q) < 1e-9
    assert abs(one.value(found.q) - one.value(q)) > 0.05  # it went as far as it could


@pytest.mark.parametrize("size", [0.01, 100.0])
def test_small_and_huge_robots_move_alike(size):
    tree, guess = four_bar(size=size)
    robot = tree.robot()
    q = close(robot, guess)
    one = next(c for c in coordinates(robot.model) if c.name == robot.actuators[0])
    found = move(robot, q, one, one.value(q) + 0.4)
    assert found.reached
    assert opening(robot, found.q) < 1e-9


def test_fingers_that_follow_each_other_do():
    robot = load("example:panda")
    one, two = (c for c in coordinates(robot.model) if "finger" in c.name)
    found = move(robot, robot.q0, one, 0.02)
    assert found.reached
    assert two.value(found.q) == pytest.approx(0.02, abs=1e-9)
    others = [c for c in coordinates(robot.model) if "finger" not in c.name]
    assert [c.value(found.q) for c in others] == [c.value(robot.q0) for c in others]


def test_a_free_root_moves_alone_and_carries_the_loops():
    free = pin.JointModelFreeFlyer()
    robot = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml", root_joint=free)
    q = assembly(robot).q
    height = next(c for c in coordinates(robot.model) if c.name.endswith(" z"))
    found = move(robot, q, height, 0.7)
    assert found.reached
    assert found.q[2] == 0.7
    np.testing.assert_allclose(found.q[7:], q[7:], atol=1e-12)
    assert opening(robot, found.q) < 1e-9


def test_a_step_that_closes_in_another_assembly_is_not_taken(monkeypatch):
    robot, q = closed("five_bar")
    other = close(robot, q * [1, -1, 1, -1] + [0.0, 0.6, 0.0, -0.6], q[robot.actuated_q])
    assert np.abs(other - q).max() > 0.6  # the elbows bend the other way
    true = moving.close_stack

    def leaping(robot, data, placed, *more):
        leapt = placed.copy()
        leapt[:, robot.passive] = other[robot.passive]
        return true(robot, data, leapt, *more)

    one = next(c for c in coordinates(robot.model) if c.name == robot.actuators[0])
    monkeypatch.setattr(moving, "close_stack", leaping)
    found = move(robot, q, one, one.value(q) + 0.3)
    assert not found.reached
    assert "another assembly" in found.why
    np.testing.assert_array_equal(found.q, q)
