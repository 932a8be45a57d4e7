"""Robots put on floors: all corners touch where they can, and nothing else moves."""

import numpy as np
import pinocchio as pin
import pytest
from standing_robots import FLOORS, ROBOTS, random_pose, standing

from thesis_pin.contacts.balance.stance import stance
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.standing.placing import stand


@pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)
@pytest.mark.parametrize("name", ROBOTS)
def test_the_standing_pose_has_its_feet_on_the_floor_and_its_joints_unmoved(name, floor):
    robot, feet, pose = standing(name)
    placed = stand(robot, feet, pose, floor)
    corners = np.concatenate([c[0] for c in stance(robot, feet, floor, placed.q[None]).corners])
    assert np.abs(floor.above(corners)).max() == pytest.approx(placed.gap, abs=1e-12)
    assert placed.gap < 1e-4
    assert (placed.q[7:] == pose[7:]).all()
    again = stand(robot, feet, placed.q, floor)
    assert np.allclose(again.q, placed.q, rtol=0, atol=1e-9)


def test_a_robot_keeps_its_heading_and_on_one_point_its_attitude():
    robot, feet, pose = standing("anymal")
    turned = pose.copy()
    turned[3:7] = pin.Quaternion(pin.exp3(np.array([0, 0, 1.0]))).coeffs()
    placed = stand(robot, feet, turned)
    ahead = pin.Quaternion(*placed.q[[6, 3, 4, 5]]).toRotationMatrix()[:, 0]
    assert np.arctan2(ahead[1], ahead[0]) == pytest.approx(1.0, abs=1e-6)
    one = stand(robot, feet[:1], turned, Floor(0.5, 0.3))
    assert np.allclose(one.q[3:7], turned[3:7])


def test_feet_that_don_t_fit_one_plane_say_by_how_much_and_which():
    robot, feet, pose = standing("anymal")
    bent = pose.copy()
    bent[9] += 0.3
    placed = stand(robot, feet, bent)
    assert placed.gap > 1e-3
    assert placed.worst in [foot.name for foot in feet]


def test_random_poses_stand_as_near_as_their_feet_allow():
    rng = np.random.default_rng(0)
    robot, feet, _ = standing("solo12")
    for _ in range(5):
        q = random_pose("solo12", rng, Floor(0.1, 0.2, 1.0))
        corners = np.concatenate(
            [c[0] for c in stance(robot, feet, Floor(0.1, 0.2, 1.0), q[None]).corners]
        )
        heights = Floor(0.1, 0.2, 1.0).above(corners)
        assert heights.mean() == pytest.approx(0.0, abs=1e-12)


def test_balls_touch_a_slope_below_their_centres_along_its_normal():
    robot, feet, pose = standing("anymal")
    floor = Floor(0.1, np.radians(25), 0.4)
    q = stand(robot, feet, pose, floor).q
    data = robot.model.createData()
    pin.framesForwardKinematics(robot.model, data, q)
    for foot, corners in zip(feet, stance(robot, feet, floor, q[None]).corners, strict=True):
        place = data.oMf[robot.model.getFrameId(foot.frame)]
        centre = place.act(foot.placement[:3, 3] + np.append(foot.corners[0], 0.0))
        assert foot.radius > 0.02
        assert floor.above(centre) == pytest.approx(foot.radius, abs=1e-4)
        assert corners[0, 0] == pytest.approx(centre - foot.radius * floor.normal, abs=1e-12)
