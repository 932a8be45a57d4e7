"""Which foot carries what in double support, and what is missing where none can."""

import numpy as np
import pytest
from scipy.optimize import nnls

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import inverse_dynamics, joint_friction
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES
from thesis_pin.contacts.dynamics import ContactDynamics

from ..conftest import EXAMPLES, sole_jacobians


def test_double_support_torque_is_least_among_admissible_wrenches(case):
    """No random admissible change of the two wrenches lowers the sum of squares."""
    robot, motion, joints, dynamics = case
    q, _, _ = free_flyer_state(motion.torso, joints)
    free = dynamics.torque - joint_friction(robot, joints.v)
    rng = np.random.default_rng(5)
    samples = np.flatnonzero(motion.support.all(axis=1) & (dynamics.double_violation == 0))[::7]
    assert samples.size
    for k in samples:
        jacobians = sole_jacobians(robot, q[k])
        left_foot, right_foot = motion.left_foot.position[k], motion.right_foot.position[k]
        tried = 0
        for size in (0.02, 0.002) * 100:
            change = rng.normal(size=6) * [1, 1, 1, 0.05, 0.05, 0.05] * size * 10
            opposite = -change.copy()  # same total: carried over to the right foot
            opposite[3:] -= np.cross(left_foot - right_foot, change[:3])
            wrenches = dynamics.sole_wrench[k].copy()
            for side, (foot, delta) in enumerate(
                ((motion.left_foot, change), (motion.right_foot, opposite))
            ):
                turn = foot.rotation[k].T
                wrenches[side] += np.concatenate([turn @ delta[:3], turn @ delta[3:]])
            if any(c.margin(w) < 0 for c, w in zip(dynamics.contacts, wrenches, strict=True)):
                continue
            tried += 1
            torque = free[k] - (jacobians[0].T @ change + jacobians[1].T @ opposite)[6:]
            assert (torque**2).sum() >= (free[k] ** 2).sum() * (1 - 1e-9)
        assert tried > 5


def test_admissible_double_support_wrenches_lie_in_their_cones(case):
    _, motion, _, dynamics = case
    double = motion.support.all(axis=1) & (dynamics.double_violation == 0)
    assert double.any()
    assert dynamics.contact_margin[double].min() > -1e-7
    assert dynamics.admissible[double].all()


def least_missing(robot, motion, dynamics, k):
    """Least wrench two soles can't give, about the left one: corner forces in world axes."""
    feet, columns = (motion.left_foot, motion.right_foot), []
    origin, axes = feet[0].position[k], feet[0].rotation[k]
    length = np.linalg.norm(np.ptp(dynamics.contacts[0].outline, axis=0)) / 2
    for side, foot, contact in zip(SIDES, feet, dynamics.contacts, strict=True):
        for corner in robot.sole_vertices(side, foot.placement[k]):
            for angle in 2 * np.pi * np.arange(8) / 8:
                tilt = contact.friction * np.array([np.cos(angle), np.sin(angle)])
                force = foot.rotation[k] @ np.append(tilt, 1.0)
                moment = np.cross(corner - origin, force)
                columns.append(np.concatenate([axes.T @ force * length, axes.T @ moment]))
    wanted = np.zeros(6)
    for foot, wrench in zip(feet, dynamics.wrench[k], strict=True):
        arm = foot.position[k] - origin
        wanted[:3] += axes.T @ wrench[:3] * length
        wanted[3:] += axes.T @ (wrench[3:] + np.cross(arm, wrench[:3]))
    return nnls(np.array(columns).T, wanted)[1]


@pytest.mark.parametrize(("name", "slower"), [("walk", 0.15), ("lopsided_walk", 0.1)])
def test_what_two_feet_cant_give_is_the_least_over_forces_at_their_corners(request, name, slower):
    """A gait run so fast that two feet can't carry it: the glue has to supply the rest."""
    robot = request.getfixturevalue("lopsided" if name.startswith("lopsided") else "scout")
    gait = load_gait(EXAMPLES / f"{name}.toml")
    motion = gait.sample(gait.sample_times(61), gait.time_unit * slower)
    dynamics = inverse_dynamics(robot, motion)
    asked = np.flatnonzero(dynamics.double_violation > 1e-3)
    assert asked.size >= 3
    for k in asked[:: max(1, len(asked) // 6)]:
        expected = least_missing(robot, motion, dynamics, k)
        assert dynamics.double_violation[k] == pytest.approx(expected, rel=1e-4)


def test_torques_of_glued_feet_are_the_least_of_all(scout):
    """Where no admissible pair exists the rule holds without the cones: normal equations."""
    gait = load_gait(EXAMPLES / "walk.toml")
    motion = gait.sample(gait.sample_times(61), gait.time_unit * 0.15)
    joints = joint_trajectory(scout, motion)
    dynamics = inverse_dynamics(scout, motion, joints)
    q, _, _ = free_flyer_state(motion.torso, joints)
    free = dynamics.torque - joint_friction(scout, joints.v)
    for k in np.flatnonzero(dynamics.double_violation > 1e-3)[:5]:
        left, right = sole_jacobians(scout, q[k])
        arm = motion.left_foot.position[k] - motion.right_foot.position[k]
        for unit in np.eye(6):  # a unit on the left foot, taken back by the right one
            back = -np.concatenate([unit[:3], unit[3:] + np.cross(arm, unit[:3])])
            change = (left.T @ unit + right.T @ back)[6:]
            assert abs(free[k] @ change) < 1e-9 * np.linalg.norm(change)


@pytest.mark.parametrize(
    ("beside", "expected"), [(-1e-8, True), (-1e-6, False), (1e-6, True), (-1e-3, False)]
)
def test_a_wrench_beyond_its_cone_by_a_micronewtonmetre_is_refused(scout, beside, expected):
    """On one foot, by the nearest facet; rounding on the border is let through."""
    contact = scout.contacts[0]
    pressed = np.array([0.0, 0.0, 8.0, *np.cross([*contact.hull.mean(axis=0), 0], [0, 0, 8.0])])
    facet = contact.facets[np.argmax(contact.facets @ contact.scale(pressed))]
    unit = np.repeat([contact.length, 1.0], 3)
    wrench = pressed + (float(contact.margin(pressed)) - beside) * facet / unit
    sole = np.zeros((1, 2, 6))
    sole[0, 0] = wrench
    single = ContactDynamics(
        np.zeros((1, 12)),
        sole,
        sole,
        scout.contacts,
        np.array([[True, False]]),
        np.zeros((1, 6)),
        np.array([np.nan]),
    )
    assert single.contact_margin[0, 0] == pytest.approx(beside, abs=1e-12)
    assert single.admissible[0] == expected


@pytest.mark.parametrize(("missing", "expected"), [(0.0, True), (1e-8, True), (1e-6, False)])
def test_two_feet_that_miss_a_micronewtonmetre_are_refused(scout, missing, expected):
    sole = np.zeros((1, 2, 6))
    double = ContactDynamics(
        np.zeros((1, 12)),
        sole,
        sole,
        scout.contacts,
        np.array([[True, True]]),
        np.zeros((1, 6)),
        np.array([missing]),
    )
    assert double.admissible[0] == expected
