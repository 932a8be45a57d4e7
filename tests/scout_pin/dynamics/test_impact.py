"""Landings: momentum, energy, and what the floor can give."""

import numpy as np
import pinocchio as pin
import pytest
from corner_forces import linear_programme_admits

from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.impact import impacts, touchdown_impact
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import SIDES

from ..conftest import EXAMPLES, sole_jacobians


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
        # Carnot: what stops dead loses the energy of the velocity that it loses.
        carnot = 0.5 * (v - after) @ mass @ (v - after)
        assert impact.energy_lost == pytest.approx(carnot, rel=1e-9)
        assert impact.energy_lost > 0
        foot = motion.left_foot if side == "left" else motion.right_foot
        planned = np.concatenate([foot.velocity[0], foot.omega[0]])
        assert np.abs(planned).max() > 1e-3
        np.testing.assert_allclose(impact.foot_velocity, planned, atol=1e-12)
        assert (impact.impulse[:, 2] > 0).all()
        # The foot that was let go leaves the floor, it isn't pressed into it.
        for other in set(SIDES) - set(impact.held):
            assert (jacobians[other] @ after)[2] >= 0


def test_a_landing_at_rest_costs_nothing(scout):
    gait = load_gait(EXAMPLES / "walk.toml")
    joints = joint_trajectory(scout, gait.sample(gait.sample_times(41)))
    found = impacts(scout, gait, joints)
    assert [impact.side for impact in found] == ["right", "left"]
    for impact in found:
        assert set(impact.held) == set(SIDES)  # rounding's sign lets no foot go
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


@pytest.mark.parametrize(("speed", "judged"), [(1e-8, False), (1e-3, False), (0.1, True)])
def test_a_landing_as_gentle_as_the_weights_own_push_is_not_judged(scout, speed, judged):
    """Sliding sideways with next to no push no cone admits; 1e-8 of it is nobody's slip."""
    q, v = scout.q0.copy(), np.zeros(18)
    v[0], v[2] = speed, -1e-3 * speed
    impact = touchdown_impact(scout, q, v, "left")
    local = [
        linear_programme_admits(scout.contacts[SIDES.index(side)], impulse / speed)
        for side, impulse in zip(impact.held, impact.impulse, strict=True)
    ]
    assert not all(local)  # the cone alone refuses it at any speed
    assert impact.admissible != judged
