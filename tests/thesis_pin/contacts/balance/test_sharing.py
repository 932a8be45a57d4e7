"""Load sharing against an independent formulation: corner forces, by SciPy's SLSQP."""

import mechanisms
import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, minimize
from standing_robots import random_pose, random_states, standing

from thesis_pin.contacts import programme
from thesis_pin.contacts.balance.dynamics import foot_dynamics
from thesis_pin.contacts.balance.sharing import tolerance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.placing import stand

COS = np.cos(np.pi / 8)


def foot_jacobian(found, q, foot):
    """Of a foot's frame, world axes, as Pinocchio gives it at a pose."""
    model = found.robot.model
    frame = model.getFrameId(found.feet[foot].frame)
    return pin.computeFrameJacobian(model, model.createData(), q, frame, pin.LOCAL_WORLD_ALIGNED)


def corner_problem(found, sample, q, standing_feet):
    """Corner forces in the world: what they sum to, what they take off the motors, their limits.

    Friction pyramids of eight edges, written from corner forces, without wrenches or their cones.
    """
    robot, stance = found.robot, found.stance
    columns, takes, limits = [], [], []
    for k in standing_feet:
        axes = stance.turn[sample, k]
        for point in stance.corners[k][sample]:
            arm = point - stance.frames[sample, k]
            jacobian = foot_jacobian(found, q, k)
            moved = jacobian[:3] + np.array([np.cross(w, arm) for w in jacobian[3:].T]).T
            takes.append(moved.T[robot.actuated])
            cross = np.array([np.cross(point, axis) for axis in np.eye(3)]).T
            columns.append(np.concatenate([np.eye(3), cross]))
            angles = np.pi / 8 + np.pi / 4 * np.arange(8)
            level = np.outer(np.cos(angles), axes[:, 0]) + np.outer(np.sin(angles), axes[:, 1])
            limits.append(found.feet[k].friction * COS * axes[:, 2] - level)
    wide = np.zeros((8 * len(limits), 3 * len(limits)))
    for j, rows in enumerate(limits):
        wide[8 * j : 8 * j + 8, 3 * j : 3 * j + 3] = rows
    return np.concatenate(columns, axis=1), np.concatenate(takes, axis=1), wide


def slsqp(found, sample, q, feet):
    """Least sum of squared torques, and the torques, by another solver."""
    sums, takes, limits = corner_problem(found, sample, q, feet)
    without = found.loops.joint_force[sample][found.robot.actuated]
    # joint_force is what the tree needs beside the contact forces that were found: undo these.
    for k in range(len(found.feet)):
        wrench, stance = found.wrench[sample, k], found.stance
        arm = stance.origin[sample, k] - stance.frames[sample, k]
        moment = wrench[3:] + np.cross(arm, wrench[:3])
        push = np.concatenate([wrench[:3], moment])
        without = without + (foot_jacobian(found, q, k).T @ push)[found.robot.actuated]
    weight = np.abs(found.required[sample, :3]).max()
    total = found.required[sample] / weight
    scaled = without / weight
    start = np.linalg.lstsq(sums, total, rcond=None)[0]
    done = minimize(
        lambda f: float(((scaled - takes @ f) ** 2).sum()),
        start,
        jac=lambda f: -2 * takes.T @ (scaled - takes @ f),
        constraints=[
            {"type": "eq", "fun": lambda f: sums @ f - total, "jac": lambda f: sums},
            {"type": "ineq", "fun": lambda f: limits @ f, "jac": lambda f: limits},
        ],
        method="SLSQP",
        options={"ftol": 1e-16, "maxiter": 500},
    )
    return done.success, done.fun * weight**2, (scaled - takes @ done.x) * weight


@pytest.mark.parametrize(
    ("name", "feet"), [("anymal", (0, 1, 2, 3)), ("solo12", (0, 1, 2)), ("talos", (0, 1))]
)
def test_least_torques_are_those_another_solver_finds_from_corner_forces(name, feet):
    robot, every, _ = standing(name)
    rng = np.random.default_rng(11)
    q = np.array([random_pose(name, rng, Floor(), 0.03) for _ in range(40)])
    states = (q, *(0.1 * x for x in random_states(name, rng, 40, Floor())[1:]))
    support = np.isin(np.arange(len(every)), feet)
    found = foot_dynamics(robot, every, *states, support=support)
    compared = 0
    for k in np.flatnonzero(found.admissible)[:6]:
        done, cost, torque = slsqp(found, k, q[k], feet)
        if not done:
            continue
        compared += 1
        ours = (found.torque[k] ** 2).sum()
        assert ours == pytest.approx(cost, rel=1e-6)
        assert np.allclose(found.torque[k], torque, rtol=0, atol=1e-4 * np.abs(torque).max())
    assert compared >= 3


def test_soles_of_two_sizes_share_what_another_solver_says_within_each_one_s_cone():
    robot, (left, right), _ = standing("talos")
    small = Foot.of(right.frame, 0.1 * right.corners, placement=right.placement)
    rng = np.random.default_rng(21)
    q = np.array([random_pose("talos", rng, Floor(), 0.02) for _ in range(8)])
    for feet in ((left, small), (small, left)):
        found = foot_dynamics(robot, feet, q)
        assert found.admissible.all()
        assert (found.contact_margin > -1e-9 * found.scale).all()
        assert (found.contact_margin < 1e-6 * found.scale).any()  # some limit holds
        for k in range(2):
            done, cost, _ = slsqp(found, k, q[k], (0, 1))
            assert done
            assert (found.torque[k] ** 2).sum() == pytest.approx(cost, rel=1e-6)


def test_no_admissible_forces_need_less_torque_or_less_force_than_those_that_were_chosen():
    robot, feet, _ = standing("anymal")
    q, v, a = random_states("anymal", np.random.default_rng(12), 20, Floor())
    by = {s: foot_dynamics(robot, feet, q, v, a, sharing=s) for s in ("torque", "force", "equal")}
    fine = by["torque"].admissible
    assert fine.any()
    for found in by.values():
        assert (found.admissible == fine).all()
        assert (found.contact_margin[fine] > -1e-9 * found.scale).all()

    def apart(found):
        return found.normal_force.var(axis=1)[fine]

    def torques(found):
        return (found.torque**2).sum(axis=1)[fine]

    def forces(found):
        return (found.wrench[..., :3] ** 2).sum(axis=(1, 2))[fine]

    for other in by.values():
        assert (torques(by["torque"]) <= torques(other) * (1 + 1e-9)).all()
        assert (forces(by["force"]) <= forces(other) * (1 + 1e-9)).all()
        assert (apart(by["equal"]) <= apart(other) * (1 + 1e-4)).all()


@pytest.mark.parametrize("name", ["anymal", "talos"])
@pytest.mark.parametrize("sharing", ["torque", "force", "equal"])
def test_along_a_motion_each_sample_has_the_forces_that_it_has_alone(name, sharing, monkeypatch):
    robot, feet, pose = standing(name)
    q = np.tile(stand(robot, feet, pose).q, (80, 1))
    a = np.zeros((80, robot.model.nv))
    push = {"anymal": 4.5, "talos": 0.8}[name]
    a[:, 0] = np.linspace(-push, push, 80)
    a[:, 1] = push * np.cos(np.linspace(0, 4, 80))
    asked, solver = [], programme.daqp.solve
    monkeypatch.setattr(programme.daqp, "solve", lambda *a, **k: asked.append(1) or solver(*a, **k))
    found = foot_dynamics(robot, feet, q, 0 * a, a, sharing=sharing)
    together = len(asked)
    alone = [foot_dynamics(robot, feet, *x, sharing=sharing) for x in zip(q, 0 * a, a, strict=True)]
    assert 0 < together < len(asked) - together  # what bound one sample served others
    size = np.abs(found.wrench).max()
    for k, one in enumerate(alone):
        assert np.allclose(found.wrench[k], one.wrench[0], rtol=0, atol=1e-8 * size)
        assert found.violation[k] == one.violation[0]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**31))
def test_what_the_floor_can_give_it_gives_within_every_cone_and_what_it_cannot_is_told(seed):
    rng = np.random.default_rng(seed)
    robot, feet, _ = standing("solo12")
    q, v, a = random_states("solo12", rng, 1, Floor())
    support = np.array([rng.permuted([True, True, True, rng.random() < 0.5])])
    found = foot_dynamics(robot, feet, q, v, 3 * a, support=support)
    inside = np.nan_to_num(found.contact_margin[0], nan=0.0).min()
    if found.admissible[0]:
        assert inside >= -tolerance(found.scale)
        assert np.abs(found.loops.base).max() < 1e-6 * found.scale
    else:
        assert inside < 0 or np.abs(found.loops.base).max() > tolerance(found.scale)


def test_load_that_follows_from_the_motion_needs_no_choice():
    robot, feet, pose = standing("talos")
    one = foot_dynamics(robot, feet, pose, support=np.array([True, False]))
    assert one.freedoms.tolist() == [0]
    for sharing in ("force", "equal"):
        other = foot_dynamics(robot, feet, pose, support=np.array([True, False]), sharing=sharing)
        assert np.allclose(other.wrench, one.wrench, rtol=0, atol=1e-9 * one.scale)
    both = foot_dynamics(robot, feet, pose)
    assert both.freedoms.tolist() == [6]


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**31), st.sampled_from([0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5]))
def test_near_the_border_forces_stay_in_their_cones_whenever_the_floor_can_give_the_load(seed, off):
    """A talos whose zero-moment point is a hair [m] inside or outside an edge of its soles."""
    rng = np.random.default_rng(seed)
    robot, feet, _ = standing("talos")
    q = random_pose("talos", rng, Floor(), 0.02)
    still = np.zeros((1, robot.model.nv))

    def pushed(size):
        a = still.copy()
        a[0, :2] = size * np.array([np.cos(seed), np.sin(seed)])
        return foot_dynamics(robot, feet, q, still, a)

    wanted = off * rng.choice([-1, 1])
    # The push along the floor [m/s²] at which the margin is off, or −off.
    found = pushed(brentq(lambda size: pushed(size).margin[0] - wanted, 0.0, 8.0, xtol=1e-15))
    assert found.margin[0] == pytest.approx(wanted, abs=1e-12)
    if found.admissible[0]:
        worst = np.nan_to_num(found.contact_margin[0], nan=1.0).min()
        assert worst > -1e-4 * found.scale
    else:
        assert found.violation[0] > 0
    if found.level[0] < 1e-12 and abs(wanted) > 1e-8 and found.friction_used[0].max() < 0.9:
        assert found.admissible[0] == (wanted > 0)


def test_what_may_be_missing_leaves_forces_in_their_cones_and_the_rest_at_the_root():
    robot, feet, pose = standing("talos")
    still = np.zeros((1, robot.model.nv))
    a = still.copy()
    at = foot_dynamics(robot, feet, stand(robot, feet, pose).q)
    a[0, 1] = 9.81 * at.margin[0] / at.stance.com[0, 2]
    q = stand(robot, feet, pose).q
    while foot_dynamics(robot, feet, q, still, a).margin[0] > -5e-4:
        a[0, 1] *= 1.001
    glued = foot_dynamics(robot, feet, q, still, a)
    eased = foot_dynamics(robot, feet, q, still, a, slack=2.0 * glued.violation[0])
    assert not eased.admissible[0]
    assert eased.violation[0] == pytest.approx(glued.violation[0])
    assert np.nan_to_num(glued.contact_margin[0], nan=1.0).min() < -1e-4 * glued.scale
    assert np.nan_to_num(eased.contact_margin[0], nan=1.0).min() > -1e-5 * eased.scale
    left = eased.loops.base[0] * np.repeat([eased.length, 1.0], 3)
    arm = eased.stance.root[0] - eased.stance.origin[0].mean(axis=0)
    left[3:] += np.cross(arm, eased.loops.base[0, :3])
    assert np.linalg.norm(left) == pytest.approx(eased.violation[0], rel=1e-4)


def test_forces_of_sliding_motors_count_as_moments_at_the_robot_s_length():
    t = mechanisms.Tree()
    t.links[0] = (
        '<link name="ground"><inertial><origin xyz="0.03 0.02 0.1"/><mass value="8"/>'
        '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>'
    )
    feet, corners = [], [(0.1, 0.05), (-0.1, 0.05), (-0.1, -0.05), (0.1, -0.05)]
    for name, y in (("left", 0.1), ("right", -0.1)):
        t.link(f"{name}_hip", "ground", (1, 0, 0), (0, y, 0), bar=(0, 0, -0.1), motor=True)
        t.link(
            f"{name}_shin",
            f"{name}_hip",
            (0, 0, 1),
            (0, 0, -0.1),
            bar=(0, 0, -0.1),
            motor=True,
            type="prismatic",
        )
        t.link(f"{name}_foot", f"{name}_shin", (0, 1, 0), (0, 0, -0.1), motor=True)
        feet.append(Foot.of(f"{name}_foot", corners))
    robot = t.robot(root_joint=pin.JointModelFreeFlyer())
    q = stand(robot, feet, robot.q0).q
    by = {s: foot_dynamics(robot, feet, q, sharing=s) for s in ("torque", "force", "equal")}
    best = by["torque"]
    assert best.admissible.all()
    assert (best.contact_margin > 1e-3 * best.scale).all()  # no limit holds: the cost is level
    slides = np.array(["shin" in name for name in robot.actuators])
    weight = np.where(slides, robot.scale.length, 1.0) ** 2
    assert abs(robot.scale.length - 1.0) > 0.2
    for other in ("force", "equal"):
        apart = by[other].torque[0] - best.torque[0]
        assert np.abs(apart).max() > 1e-3
        slope = (weight * best.torque[0]) @ apart
        assert abs(slope) < 1e-9 * (weight * np.abs(best.torque[0])) @ np.abs(apart)
