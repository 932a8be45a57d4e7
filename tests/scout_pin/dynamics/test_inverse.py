"""Contact inverse dynamics, wrench cones, impacts and the zero-moment point."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.optimize import linprog

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.impact import impacts, touchdown_impact
from scout_pin.dynamics.inverse import inverse_dynamics, joint_friction
from scout_pin.dynamics.stability import (
    momentum,
    pressure_point,
    signed_margin,
    support_margin,
    zero_moment_point,
)
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES
from thesis_pin.contacts.stability import support_polygon
from thesis_pin.errors import NoSupportForce

from ..conftest import EXAMPLES


@pytest.fixture(scope="module", params=["thesis", "walk", "lopsided_walk"])
def case(request, scout, lopsided):
    """A robot, a gait on it, and its dynamics at 81 samples."""
    robot = lopsided if request.param.startswith("lopsided") else scout
    name = "thesis" if request.param == "thesis" else EXAMPLES / f"{request.param}.toml"
    gait = load_gait(name)
    motion = gait.sample(gait.sample_times(81))
    joints = joint_trajectory(robot, motion)
    return robot, motion, joints, inverse_dynamics(robot, motion, joints)


def sole_jacobians(robot, q):
    """Jacobians of both soles by Pinocchio, world axes at p_i, ``(2, 6, 18)``."""
    data = robot.model.createData()
    return np.stack(
        [
            pin.computeFrameJacobian(
                robot.model, data, q, robot.sole_frames[side], pin.LOCAL_WORLD_ALIGNED
            )
            for side in SIDES
        ]
    )


def test_equations_of_motion_hold_with_pinocchios_rnea_and_jacobians(case):
    robot, motion, joints, dynamics = case
    q, v, a = free_flyer_state(motion.torso, joints)
    free = dynamics.torque - joint_friction(robot, joints.v)
    data = robot.model.createData()
    for k in range(len(q)):
        required = pin.rnea(robot.model, data, q[k], v[k], a[k])
        supplied = np.concatenate([np.zeros(6), free[k]])
        for jacobian, wrench in zip(sole_jacobians(robot, q[k]), dynamics.wrench[k], strict=True):
            supplied += jacobian.T @ wrench
        np.testing.assert_allclose(supplied, required, atol=1e-10)


def test_planned_motion_is_what_pinocchios_kinematics_say(case):
    """The state handed to RNEA moves both soles as the gait asks."""
    robot, motion, joints, _ = case
    q, v, a = free_flyer_state(motion.torso, joints)
    data = robot.model.createData()
    for k in range(len(q)):
        pin.forwardKinematics(robot.model, data, q[k], v[k], a[k])
        pin.updateFramePlacements(robot.model, data)
        for side, foot in (("left", motion.left_foot), ("right", motion.right_foot)):
            frame = robot.sole_frames[side]
            velocity = pin.getFrameVelocity(robot.model, data, frame, pin.LOCAL_WORLD_ALIGNED)
            acceleration = pin.getFrameClassicalAcceleration(
                robot.model, data, frame, pin.LOCAL_WORLD_ALIGNED
            )
            np.testing.assert_allclose(data.oMf[frame].translation, foot.position[k], atol=1e-12)
            np.testing.assert_allclose(velocity.linear, foot.velocity[k], atol=1e-11)
            np.testing.assert_allclose(acceleration.linear, foot.acceleration[k], atol=1e-9)
            np.testing.assert_allclose(acceleration.angular, foot.alpha[k], atol=1e-9)


def test_newtons_and_eulers_laws_close_on_the_whole_robot(case):
    """Sum of the floor's wrenches and gravity is the rate of momentum."""
    robot, motion, joints, dynamics = case
    com, rate = momentum(robot, *free_flyer_state(motion.torso, joints))
    feet = np.stack([motion.left_foot.position, motion.right_foot.position], axis=1)
    force = dynamics.wrench[..., :3].sum(axis=1)
    moment = (dynamics.wrench[..., 3:] + np.cross(feet, dynamics.wrench[..., :3])).sum(axis=1)
    weight = np.array([0.0, 0.0, -robot.mass * 9.81])
    np.testing.assert_allclose(force + weight, rate[:, :3], atol=1e-10)
    np.testing.assert_allclose(moment + np.cross(com, weight), rate[:, 3:], atol=1e-10)


def test_zmp_by_6_1_is_the_centre_of_pressure_of_the_floors_wrenches(case):
    robot, motion, joints, dynamics = case
    zmp = zero_moment_point(robot.mass, *momentum(robot, *free_flyer_state(motion.torso, joints)))
    np.testing.assert_allclose(zmp, pressure_point(motion, dynamics.wrench), atol=1e-10)
    single = ~motion.support.all(axis=1)
    for k, foot in enumerate((motion.left_foot, motion.right_foot)):
        mine = single & motion.support[:, k]
        local = np.concatenate([dynamics.centre_of_pressure[:, k], np.zeros((len(zmp), 1))], axis=1)
        world = foot.position + np.einsum("nij,nj->ni", foot.rotation, local)
        np.testing.assert_allclose(world[mine, :2], zmp[mine], atol=1e-10)


def test_standing_still_puts_the_zmp_under_the_centre_of_mass(scout, rng):
    com = rng.normal(size=(5, 3))
    np.testing.assert_array_equal(zero_moment_point(0.9, com, np.zeros((5, 6))), com[:, :2])


def test_a_fall_faster_than_gravity_has_no_zmp():
    with pytest.raises(NoSupportForce, match="sample 1"):
        zero_moment_point(1.0, np.zeros((2, 3)), [[0] * 6, [0, 0, -20.0, 0, 0, 0]])


def test_swing_foot_feels_nothing(case):
    _, motion, _, dynamics = case
    assert (dynamics.wrench[~motion.support] == 0).all()
    assert np.isnan(dynamics.friction_used[~motion.support]).all()


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


def linear_programme_admits(contact, wrench):
    """Independent membership test: forces at the hull's corners by linear programming."""
    forces, columns = [], []
    for x, y in contact.hull:
        for k in range(8):
            angle = 2 * np.pi * k / 8
            force = np.array(
                [contact.friction * np.cos(angle), contact.friction * np.sin(angle), 1.0]
            )
            forces.append(force)
            columns.append(np.concatenate([force, np.cross([x, y, 0.0], force)]))
    matrix = np.array(columns).T
    return linprog(np.ones(matrix.shape[1]), A_eq=matrix, b_eq=wrench, method="highs").status == 0


@pytest.mark.parametrize("side", SIDES)
def test_wrench_cone_is_what_corner_forces_can_do(biped, side, rng):
    contact = biped.contacts[SIDES.index(side)]
    inside = 0
    for _ in range(150):
        wrench = rng.normal(size=6) * [0.3, 0.3, 0.3, 0.04, 0.04, 0.02] + [0, 0, 1, 0, 0, 0]
        margin = contact.margin(wrench)
        if abs(margin) < 1e-6:
            continue
        admitted = linear_programme_admits(contact, wrench)
        assert (margin > 0) == admitted
        assert (contact.violation(wrench)[0] < 1e-9) == admitted
        inside += admitted
    assert 10 < inside < 140


def test_least_violation_is_a_distance_and_repairs_the_wrench(scout, rng):
    contact = scout.contacts[0]
    for _ in range(50):
        wrench = rng.normal(size=6) * [3, 3, 3, 0.5, 0.5, 0.5]
        size, missing = contact.violation(wrench)
        assert size == pytest.approx(np.linalg.norm(contact.scale(missing)), abs=1e-9)
        assert contact.margin(wrench - missing) > -1e-9
        assert size >= -contact.margin(wrench) - 1e-9


def test_pulling_slipping_tipping_and_spinning_are_each_refused(scout):
    contact = scout.contacts[0]
    middle = contact.hull.mean(axis=0)

    def pressed(force, moment=(0.0, 0.0, 0.0), at=middle):
        return np.concatenate([force, np.cross([*at, 0.0], force) + moment])

    good = pressed([0.5, 0.3, 8.0])
    assert contact.margin(good) > 0
    assert contact.margin(pressed([0, 0, -1.0])) < 0
    assert contact.margin(pressed([0.61 * 8, 0, 8.0])) < 0
    assert contact.margin(pressed([0, 0, 8.0], at=(0.03, 0.0))) < 0
    # Full friction at the farthest corner bounds the yaw moment.
    assert contact.margin(pressed([0, 0, 8.0], moment=(0, 0, 8.0 * 0.6 * 0.1))) < 0
    assert contact.friction_used(pressed([2.4, 0, 8.0])) == pytest.approx(0.5)


def test_thesis_gait_needs_glue_as_the_hand_calculation_says(scout):
    """Weight times the lateral offset of the hip: the sole can't give that moment."""
    gait = load_gait()
    motion = gait.sample(gait.sample_times(401))
    dynamics = inverse_dynamics(scout, motion)
    single = ~motion.support.all(axis=1)
    needed = np.abs(dynamics.wrench[single][..., 4]).max()
    assert needed == pytest.approx(0.898540 * 9.81 * 0.0445, abs=2e-3)  # about 0.39 N·m
    available = 0.898540 * 9.81 * 28.18e-3  # inner edge of the sole
    assert available == pytest.approx(0.248, abs=1e-3)
    assert not dynamics.admissible[single].any()
    worst = int(np.argmin(np.where(dynamics.support, dynamics.contact_margin, 0).min(axis=1)))
    size, missing = dynamics.least_violation(worst)
    assert 0.1 < size < needed - available + 1e-3
    assert abs(missing[4]) > 0.1


def test_joint_friction_opposes_motion_and_is_nothing_at_rest(lopsided):
    v = np.array([0.0, 2.0, -3.0] + [0.0] * 9)
    torque = joint_friction(lopsided, v)
    np.testing.assert_allclose(torque[:3], [0.0, 0.005 * 2 + 0.01, -0.005 * 3 - 0.01])


def test_impact_stops_the_landing_foot_and_keeps_momentum(scout):
    """Momentum changes by the impulses; the held soles are at rest afterwards."""
    gait = load_gait()
    for t, side in gait.touchdowns():
        motion = gait.sample(np.array([np.nextafter(t, -np.inf)]))
        joints = joint_trajectory(scout, motion)
        q, v, _ = (part[0] for part in free_flyer_state(motion.torso, joints))
        impact = touchdown_impact(scout, q, v, side, t)
        jacobians = dict(zip(SIDES, sole_jacobians(scout, q), strict=True))
        mass = pin.crba(scout.model, scout.data, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        impulse = sum(jacobians[s].T @ p for s, p in zip(impact.held, impact.impulse, strict=True))
        after = v + np.linalg.solve(mass, impulse)
        np.testing.assert_allclose(after[6:] - v[6:], impact.velocity_jump, atol=1e-10)
        for held in impact.held:
            np.testing.assert_allclose(jacobians[held] @ after, 0.0, atol=1e-10)
        lost = 0.5 * (v @ mass @ v - after @ mass @ after)
        assert impact.energy_lost == pytest.approx(lost, abs=1e-12)
        assert impact.energy_lost > 0
        assert (impact.impulse[:, 2] > 0).all()
        # The foot that was let go leaves the floor, it isn't pressed into it.
        for other in set(SIDES) - set(impact.held):
            assert (jacobians[other] @ after)[2] >= 0


def test_a_landing_at_rest_costs_nothing(scout):
    gait = load_gait(EXAMPLES / "walk.toml")
    found = impacts(scout, gait)
    assert [impact.side for impact in found] == ["right", "left"]
    for impact in found:
        assert np.abs(impact.impulse).max() < 1e-9
        assert impact.energy_lost < 1e-12
        assert impact.admissible


def test_an_impact_the_floor_cannot_give_is_called_so(scout, lopsided):
    """A foot that lands sliding sideways needs more friction than there is."""
    for robot in (scout, lopsided):
        q = robot.q0.copy()
        falling, sliding = np.zeros((2, 18))
        falling[2] = sliding[2] = -0.1
        sliding[0] = 5.0
        assert not touchdown_impact(robot, q, sliding, "left").admissible
        straight = touchdown_impact(robot, q, falling, "left")
        # The soles are level in the neutral pose, so world axes are theirs.
        by_hand = [
            linear_programme_admits(robot.contacts[SIDES.index(side)], impulse)
            for side, impulse in zip(straight.held, straight.impulse, strict=True)
        ]
        assert straight.admissible == all(by_hand)


def test_support_polygon_and_margin_of_known_shapes():
    square = np.array([[0, 0], [2, 0], [2, 1], [0, 1], [1, 0.5]])
    polygon = support_polygon(square)
    assert len(polygon) == 4
    points = np.array([[1, 0.5], [1, 0.9], [3, 0.5], [3, 2.0], [1.0, 1.0]])
    expected = [0.5, 0.1, -1.0, -np.sqrt(2), 0.0]
    np.testing.assert_allclose(signed_margin(polygon, points), expected, atol=1e-12)


def test_margins_follow_the_feet_that_stand(scout):
    gait = load_gait(EXAMPLES / "walk.toml")
    motion = gait.sample(np.array([0.0, 8.0, 15.0, 22.0]))
    between = np.zeros((4, 2))
    margin = support_margin(scout, motion, between)
    # x = 0 lies between the soles: inside only while both stand (gap 2 × 1.82 mm).
    assert margin[0] > 0.02
    assert margin[1] == pytest.approx(-(30 - 28.18) * 1e-3, abs=1e-6)
    assert margin[2] > 0
    assert margin[3] < 0
