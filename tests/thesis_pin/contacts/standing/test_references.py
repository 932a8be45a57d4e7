"""Poses of SRDF files beside descriptions."""

import pinocchio as pin

import thesis_pin
from thesis_pin.contacts.standing.references import preferred, reference_poses


def test_a_robot_s_srdf_pose_is_the_one_pinocchio_reads():
    robot = thesis_pin.load("example:solo12", root_joint=pin.JointModelFreeFlyer())
    poses = reference_poses(robot)
    assert list(poses) == ["standing", "straight_standing"]
    folder = robot.description.mesh_folders[0]
    pin.loadReferenceConfigurations(robot.model, f"{folder}/../srdf/solo.srdf", False)
    theirs = robot.model.referenceConfigurations["standing"]
    assert (poses["standing"][7:] == theirs[7:]).all()
    assert preferred(list(poses)) == "standing"


def test_a_robot_without_such_a_file_has_none(tmp_path):
    robot = thesis_pin.load("example:g1_29dof_rev_1_0", root_joint=pin.JointModelFreeFlyer())
    assert reference_poses(robot) == {}
    assert preferred([]) is None
    assert preferred(["crouch"]) == "crouch"
