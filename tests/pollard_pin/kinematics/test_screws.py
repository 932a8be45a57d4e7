"""Points, axes and sines of a posture, against Pinocchio's Jacobians."""

import numpy as np
import pinocchio as pin
import pytest

from pollard_pin import ALL_BRANCHES
from pollard_pin.kinematics.screws import Posture

from ..conftest import random_poses


def point_jacobian(robot, q, frame):
    """Jacobian of a frame's origin, world axes, ``(3, 12)``, and its rotation's."""
    data = robot.model.createData()
    number = robot.model.getFrameId(frame)
    full = pin.computeFrameJacobian(robot.model, data, q, number, pin.LOCAL_WORLD_ALIGNED)
    return full[:3], full[3:]


def test_serial_sines_are_factors_of_pinocchios_determinants(robot, rng):
    """Each chain's own joints, moving its own point: where a sine vanishes, rank is lost."""
    geometry = robot.geometry
    angles = rng.uniform(-np.pi, np.pi, (50, 12))
    sines = Posture.of(geometry, angles).serial_sines
    for q, sine in zip(angles, sines, strict=True):
        _, turn = point_jacobian(robot, q, "tool_tip")
        assert abs(np.linalg.det(turn[:, 3:6])) == pytest.approx(abs(sine[2]), abs=1e-12)
        for i in (0, 1):
            tip, _ = point_jacobian(robot, q, f"chain{i + 1}_rod_tip")
            size = geometry.x_43[i] * geometry.x_87[i] ** 2
            found = abs(np.linalg.det(tip[:, 6 + 3 * i : 9 + 3 * i])) / size
            expected = abs(sine[3 + 2 * i] * sine[4 + 2 * i])
            assert found == pytest.approx(expected, abs=1e-12)
            # θ65i alone moves the tip by the rod's length times cos θ76i.
            assert np.linalg.norm(tip[:, 7 + 3 * i]) == pytest.approx(
                geometry.x_87[i] * abs(sine[4 + 2 * i]), abs=1e-12
            )


def test_shoulder_and_elbow_sines_are_factors_of_the_wrist_centres_determinant(robot, rng):
    """The wrist centre is where the axes of the three wrist joints meet."""
    geometry = robot.geometry
    for q in rng.uniform(-np.pi, np.pi, (50, 12)):
        sine = Posture.of(geometry, q[None]).serial_sines[0]
        data = robot.model.createData()
        pin.computeJointJacobians(robot.model, data, q)
        joint = robot.model.joints[5].id  # θ1716, whose origin is the wrist centre
        full = pin.getJointJacobian(robot.model, data, joint, pin.LOCAL_WORLD_ALIGNED)
        size = geometry.x_32 * geometry.forearm**2
        found = abs(np.linalg.det(full[:3, :3])) / size
        assert found == pytest.approx(abs(sine[0]) * sine[1] ** 2, abs=1e-12)


def test_the_elbows_label_says_on_which_side_of_the_wrists_line_it_is(robot, rng):
    """From Pinocchio's joint centres, wrists everywhere about the shoulder."""
    poses = random_poses(rng, 400)
    poses[:, :3] = rng.uniform([-0.7, -0.3, -0.7], [0.7, 0.3, 0.7], (400, 3))
    found = robot.inverse_kinematics(poses, "all")
    seen = set()
    for row, column in np.argwhere(found.reachable)[::37]:
        q = found.angles[row, column]
        label = robot.branch_of(q)
        assert label == ALL_BRANCHES[column]
        data = robot.model.createData()
        pin.forwardKinematics(robot.model, data, q)
        shoulder = np.array([0.0, 0.0, robot.geometry.z_10])
        elbow, wrist = data.oMi[2].translation - shoulder, data.oMi[5].translation - shoulder
        assert np.sign(np.cross(wrist, elbow)[1]) == label.e0
        seen.add((label.e0, bool(wrist[2] > 0), bool(wrist[0] > 0)))
    assert len(seen) >= 6
