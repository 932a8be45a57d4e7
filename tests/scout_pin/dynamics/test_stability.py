"""Support polygons of a motion, and the margins of its zero-moment points."""

import dataclasses

import numpy as np
import pinocchio as pin
import pytest

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.stability import momentum, polygons, pressure_point, support_margin
from scout_pin.motion.files import load_gait
from thesis_pin.errors import NoSupportForce, WrongShape

from ..conftest import EXAMPLES


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


def shifted(motion, by):
    """The same motion, each sample moved along the floor by its own amount, ``(n, 2)``."""
    step = np.column_stack([by, np.zeros(len(by))])
    bodies = {
        name: dataclasses.replace(
            getattr(motion, name), position=getattr(motion, name).position + step
        )
        for name in ("torso", "left_foot", "right_foot")
    }
    return dataclasses.replace(motion, **bodies)


@pytest.mark.parametrize("axis", [0, 1])
def test_margins_dont_depend_on_where_on_the_floor_a_stance_is(scout, axis, rng):
    """Feet that stand elsewhere at each sample: every sample has its own polygon."""
    motion = load_gait(EXAMPLES / "walk.toml").sample(np.linspace(0.0, 30.0, 30))
    points = rng.uniform(-0.05, 0.05, (30, 2))
    by = np.zeros((30, 2))
    by[:, axis] = rng.uniform(-0.5, 0.5, 30)
    moved = support_margin(scout, shifted(motion, by), points + by)
    np.testing.assert_allclose(moved, support_margin(scout, motion, points), atol=1e-12)


def test_margins_are_distances_to_the_soles_corners_by_hand(scout):
    """One foot, level and unturned: its sole is the outline moved to the foot."""
    motion = load_gait(EXAMPLES / "walk.toml").sample(np.array([8.0]))
    side, foot = (
        ("left", motion.left_foot) if motion.support[0, 0] else ("right", motion.right_foot)
    )
    outline = np.array(scout.specification.leg(side).sole) + foot.position[0, :2]
    low, high = outline.min(axis=0), outline.max(axis=0)
    inside = (low + high) / 2
    for point in (inside, [high[0] + 0.01, inside[1]], [inside[0], low[1] - 0.02]):
        point = np.array(point)
        beyond = np.maximum(low - point, point - high)
        expected = -beyond.max()
        assert support_margin(scout, motion, point[None])[0] == pytest.approx(expected, abs=2e-3)


def test_every_sample_has_one_polygon_and_its_corners_are_the_soles(case):
    robot, motion, *_ = case
    feet = {"left": motion.left_foot.placement, "right": motion.right_foot.placement}
    seen = np.concatenate([samples for samples, _ in polygons(robot, motion)])
    np.testing.assert_array_equal(np.sort(seen), np.arange(len(motion.t)))
    for samples, polygon in polygons(robot, motion):
        k = samples[0]
        corners = np.concatenate(
            [
                robot.sole_vertices(side, feet[side][k])[:, :2]
                for j, side in enumerate(("left", "right"))
                if motion.support[k, j]
            ]
        )
        assert {tuple(c) for c in polygon.round(9)} <= {tuple(c) for c in corners.round(9)}
        np.testing.assert_allclose(polygon.min(axis=0), corners.min(axis=0), atol=1e-9)
        np.testing.assert_allclose(polygon.max(axis=0), corners.max(axis=0), atol=1e-9)


def test_momentum_rate_is_the_derivative_of_pinocchios_momentum(case):
    """Central differences of the momentum about the world's origin."""
    robot, motion, joints, _ = case
    q, v, a = free_flyer_state(motion.torso, joints)
    com, rate = momentum(robot, q, v, a)
    data, step = robot.model.createData(), 1e-6

    def about_origin(k, dt):
        place = pin.integrate(robot.model, q[k], v[k] * dt + a[k] * (dt * dt / 2))
        pin.computeCentroidalMomentum(robot.model, data, place, v[k] + a[k] * dt)
        linear, angular = data.hg.linear, data.hg.angular
        return np.concatenate([linear, angular + np.cross(data.com[0], linear)])

    for k in range(0, len(q), 10):
        slope = (about_origin(k, step) - about_origin(k, -step)) / (2 * step)
        np.testing.assert_allclose(rate[k], slope, atol=1e-6)
        np.testing.assert_allclose(com[k], pin.centerOfMass(robot.model, data, q[k]), atol=1e-12)


def test_a_floor_that_pulls_and_points_of_another_motion_are_refused(scout):
    motion = load_gait(EXAMPLES / "walk.toml").sample(np.linspace(0.0, 30.0, 5))
    wrench = np.zeros((5, 2, 6))
    wrench[:, 0, 2] = 1.0
    wrench[3, 0, 2] = -1.0
    with pytest.raises(NoSupportForce, match="sample 3"):
        pressure_point(motion, wrench)
    with pytest.raises(WrongShape, match="points"):
        support_margin(scout, motion, np.zeros((4, 2)))
