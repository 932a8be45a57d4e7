"""The mechanism in the axes of its links: what the closed form knows is what its angles say."""

import numpy as np
import pinocchio as pin
import pytest

from pollard_pin import ALL_BRANCHES, USEFUL_BRANCHES
from pollard_pin.kinematics.closed_form import ClosedForm
from pollard_pin.kinematics.inverse import ZERO
from pollard_pin.kinematics.linkage import Linkage, from_arm, in_arm, in_plane, on_forearm
from pollard_pin.kinematics.regular import serial_sines
from pollard_pin.kinematics.screws import Posture
from thesis_pin.numeric.elementwise import ARRAYS, FLOATS

from ..conftest import closed_motion


def numbers(known):
    """All numbers of a linkage, the sides' too."""
    *chain, tool, sides = known
    return np.array([*chain, *tool, *(one for side in sides for one in side)])


@pytest.mark.parametrize("branch", [*USEFUL_BRANCHES[::3], *ALL_BRANCHES[5::23]])
def test_the_closed_form_hands_on_the_linkage_of_its_angles(robot, rng, branch):
    poses, _, _, q, _, _ = closed_motion(robot, rng, 40, branch)
    expected = numbers(Linkage.of(robot.geometry, q.T))
    found = ClosedForm(ARRAYS, robot.geometry, poses.T, ZERO).solve(branch)
    np.testing.assert_allclose(numbers(found.linkage), expected, atol=1e-12)
    for k, pose in enumerate(poses.tolist()):
        one = ClosedForm(FLOATS, robot.geometry, pose, ZERO).solve(branch)
        np.testing.assert_allclose(numbers(one.linkage), expected[:, k], atol=1e-12)


def test_open_configurations_have_the_postures_vectors_and_sines(robot, rng):
    q = rng.uniform(-np.pi, np.pi, (50, 12))
    geometry, posture = robot.geometry, Posture.of(robot.geometry, q)
    known = Linkage.of(geometry, q.T)
    np.testing.assert_allclose(
        np.array(serial_sines(geometry, known)).T, posture.serial_sines, atol=1e-14
    )
    tool = on_forearm(known, in_plane(known, posture.tool_axes[0]))
    np.testing.assert_allclose(tool, known.tool, atol=1e-14)
    for i, side in enumerate(known.sides):
        lever = in_plane(known, posture.levers[i])
        np.testing.assert_allclose(lever[:2], [side.lever_p, side.lever_y], atol=1e-14)
        np.testing.assert_allclose(lever[2], geometry.anchors[i, 2], atol=1e-14)
        rod = from_arm(side, (side.along, side.across, side.up))
        np.testing.assert_allclose(rod, posture.rods[i], atol=1e-14)
        again = in_arm(known, side, in_plane(known, posture.rods[i]))
        np.testing.assert_allclose(again, [side.along, side.across, side.up], atol=1e-14)
        np.testing.assert_allclose(side.b, (posture.pitch_axes[i] * posture.rods[i]).sum(axis=0))


def test_pinocchio_places_the_rods_tip_where_the_linkage_says(robot, rng):
    data = robot.model.createData()
    for q in rng.uniform(-np.pi, np.pi, (20, 12)):
        pin.framesForwardKinematics(robot.model, data, q)
        known = Linkage.of(robot.geometry, q.tolist(), FLOATS)
        for i, side in enumerate(known.sides):
            numbers = robot.geometry.sides[i]
            x, y, z = from_arm(side, (numbers.arm + side.along, side.across, side.up))
            base = [0.0, numbers.y_10, robot.geometry.z_10 - numbers.drop]
            tip = data.oMf[robot.model.getFrameId(f"chain{i + 1}_rod_tip")].translation
            np.testing.assert_allclose(np.array([x, y, z]) + base, tip, atol=1e-13)
