"""Stacks: what can be closed and followed is, and the rest says why."""

import mechanisms as m
import numpy as np
import pytest

from thesis_pin.errors import BadInput, SingularPose, Unreachable
from thesis_pin.loops import dynamics
from thesis_pin.loops import kinematics as loops


def test_a_stack_says_which_configurations_do_not_close_and_by_how_much():
    robot, guess = m.built("four_bar")
    found = loops.close_each(robot, guess, [[0.8], [0.9]])
    assert found.closed.all()
    assert found.reasons == ("", "")
    assert found.gaps.max() < 1e-12
    robot, guess = m.built("five_bar")
    far = [[2.2, 0.9], [np.pi, 0.0]]  # both cranks flat and outwards: elbows 0.6 apart
    tree, _ = m.five_bar()
    tree.joints[2] = tree.joints[2].replace('xyz="0.2 0.0 0.0"', 'xyz="0.25 0.0 0.0"')
    wide = tree.robot()
    found = loops.close_each(wide, guess, far)
    np.testing.assert_array_equal(found.closed, [True, False])
    assert "'left_tip' and 'right_tip'" in found.reasons[1]
    assert found.gaps[1, 0, 0] == pytest.approx(0.05, rel=0.2)  # 0.65 between, rods 0.6
    with pytest.raises(Unreachable, match="sample 1"):
        loops.close(wide, guess, far)


def test_a_motion_goes_on_after_samples_that_can_not_be_reached():
    tree, guess = m.five_bar()
    tree.joints[2] = tree.joints[2].replace('xyz="0.2 0.0 0.0"', 'xyz="0.25 0.0 0.0"')
    robot = tree.robot()
    motors = np.array([[2.2, 0.9], [np.pi, 0.0], [2.2, 0.9]])
    still = np.zeros((3, 2))
    found = loops.follow_each(robot, [0, 1, 2], motors, still, still, guess)
    np.testing.assert_array_equal(found.valid, [True, False, True])
    assert np.isnan(found.motion.v[1]).all()
    np.testing.assert_allclose(found.motion.q[2], found.motion.q[0], atol=1e-9)
    with pytest.raises(Unreachable, match="sample 1"):
        loops.follow(robot, [0, 1, 2], motors, still, still, guess)


def test_redundant_motors_that_fight_are_refused():
    robot, guess = m.built("four_bar")
    tree, _ = m.four_bar()
    tree.motors.append("rocker_joint")
    both = tree.robot()
    q = loops.close(robot, guess)
    ratio = -np.linalg.svd(loops.jacobian(robot, q))[2][-1]
    rates = np.array([[1.0, ratio[2] / ratio[0]]])
    still = np.zeros((1, 2))
    motion = loops.follow(robot, [0.0], q[None, :1], rates[:, :1], still[:, :1], q)
    loops.follow(both, [0.0], q[None, [0, 2]], rates, motion.a[:, [0, 2]], q)
    with pytest.raises(SingularPose, match="forbid the motors' rates"):
        loops.follow(both, [0.0], q[None, [0, 2]], [[1.0, 3.0]], still, q)


def test_every_rod_of_a_delta_is_its_own_idle_group():
    robot, q = m.built("delta")
    q = loops.close(robot, q)
    found = dynamics.inverse_dynamics(robot, q, np.zeros(24), np.zeros(24))
    assert found.freedom == 9
    assert sum(group.freedoms for group in found.idle) == 6
    names = {group.joints[0] for group in found.idle}
    rods = {f"rod_{k}_{side}_joint" for k in range(3) for side in (-1, 1)}
    assert len(names & rods) >= 5
    assert all(group.light for group in found.idle)
    assert found.idle_load.max() < 1e-2
    assert found.unexplained < 1e-9


def test_legs_that_do_not_touch_are_solved_apart_and_alike():
    """Two five-bars on one ground carry what each carries alone."""
    alone, guess = m.built("five_bar")
    tree, _ = m.five_bar()
    second, _ = m.five_bar()
    for part in ("links", "joints"):
        for text in getattr(second, part):
            if '"ground"/>' in text and text.startswith("<link"):
                continue
            for name in ("left", "right"):
                text = text.replace(f'"{name}', f'"other_{name}')
            getattr(tree, part).append(text)
    tree.motors += ["other_left_joint", "other_right_joint"]
    tree.loop("other_left_tip", "other_right_tip")
    pair = tree.robot()
    q = loops.close(alone, guess)
    zero = np.zeros(4)
    one = dynamics.inverse_dynamics(alone, q, zero, zero)
    order = [pair.model.getJointId(name) for name in list(pair.model.names)[1:]]
    both = np.empty(8)
    for name, joint in zip(list(pair.model.names)[1:], order, strict=True):
        own = alone.model.getJointId(name.removeprefix("other_"))
        both[pair.model.joints[joint].idx_q] = q[alone.model.joints[own].idx_q]
    found = dynamics.inverse_dynamics(pair, both, np.zeros(8), np.zeros(8))
    assert len(pair.surveys[0][1].blocks) == 2
    np.testing.assert_allclose(found.torque, np.tile(one.torque, 2), rtol=1e-12)
    np.testing.assert_allclose(found.force, np.tile(one.force, (2, 1)), atol=1e-12)


def test_a_base_is_only_given_to_what_flies():
    robot, guess = m.built("four_bar")
    with pytest.raises(BadInput, match="stands fixed"):
        loops.follow(
            robot, [0.0], [[0.8]], [[0.0]], [[0.0]], guess, base=([[0] * 7], [[0] * 6], [[0] * 6])
        )


def test_forward_dynamics_is_that_of_pinocchio_where_all_equations_are_independent():
    import pinocchio as pin

    for name in ("three_rrs", "delta"):
        robot, q = m.built(name)
        q = loops.close(robot, q)
        random = np.random.default_rng(1)
        matrix = loops.jacobian(robot, q)
        v = random.normal(size=robot.model.nv)
        v -= np.linalg.pinv(matrix) @ matrix @ v
        torque = random.normal(size=3)
        models, datas = robot.rigid_constraint_models(), pin.StdVec_RigidConstraintData()
        for one in models:
            datas.append(one.createData())
        data, tau = robot.model.createData(), np.zeros(robot.model.nv)
        tau[robot.actuated] = torque
        pin.initConstraintDynamics(robot.model, data, models, datas)
        settings = pin.ProximalSettings(1e-14, 1e-10, 100)
        theirs = pin.constraintDynamics(robot.model, data, q, v, tau, models, datas, settings)
        solver = dynamics.ForwardDynamics(robot)
        solver._simple = False  # the reduced equations, which Pinocchio's own stands in for
        ours = solver(q, v, torque)
        quick = dynamics.forward_dynamics(robot, q, v, torque)
        np.testing.assert_allclose(ours, quick, atol=1e-7 * np.abs(quick).max())
        np.testing.assert_allclose(ours, theirs, atol=1e-7 * np.abs(theirs).max())
