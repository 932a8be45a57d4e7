"""When feet are on the floor, told from motions in which it is known."""

import numpy as np
import pinocchio as pin
import pytest
from commands import ROOT
from standing_robots import standing

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.contacts.balance.stance import stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.phases import _with_hysteresis, detect, lowest_point
from thesis_pin.contacts.standing.placing import stand


@pytest.mark.parametrize("noise", [0.0, 2e-4])
def test_scout_s_walk_is_on_the_feet_that_its_plan_says_but_for_the_edges(noise):
    robot = scout_pin.load()
    plan = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    motion = plan.sample(plan.sample_times(401))
    q, v, _ = free_flyer_state(motion.torso, joint_trajectory(robot, motion))
    feet = [
        Foot.of(robot.model.frames[robot.sole_frames[side]].name, contact.outline)
        for side, contact in zip(("left", "right"), robot.contacts, strict=True)
    ]
    q[:, 2] += noise * np.random.default_rng(0).normal(size=len(q))
    places = stance(robot, feet, Floor(), q, v)
    found = detect(Floor(), places)
    assert (found | ~motion.support).all()  # none that stands is missed
    early = (found & ~motion.support).mean()
    assert early < 0.08
    assert abs(lowest_point(Floor(), places)) < 1e-9 + 5 * noise


def test_hysteresis_joins_what_never_left_and_drops_what_never_landed():
    use = np.array([3, 1.5, 0.5, 1.5, 0.9, 2.5, 1.2, 1.8, 2.5, 1.0])
    expected = [False, True, True, True, True, False, False, False, False, True]
    assert _with_hysteresis(use).tolist() == expected


def test_a_sole_that_rests_on_an_edge_only_is_not_on_the_floor():
    robot, feet, pose = standing("talos")
    q = stand(robot, feet, pose).q
    tilted = q.copy()
    tilted[3:7] = pin.Quaternion(pin.rpy.rpyToMatrix(0.0, 0.2, 0.0)).coeffs()
    tilted[2] -= lowest_point(Floor(), stance(robot, feet, Floor(), tilted[None]))
    for state, rests in ((q, True), (tilted, False)):
        places = stance(robot, feet, Floor(), state[None])
        assert abs(lowest_point(Floor(), places)) < 1e-9
        assert detect(Floor(), places).all() == rests
        assert detect(Floor(), places).any() == rests
