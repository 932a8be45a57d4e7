"""Robots of example-robot-data on their feet, and random states of them."""

from functools import cache

import numpy as np
import pinocchio as pin

import thesis_pin
from thesis_pin.contacts.floor import Floor
from thesis_pin.contacts.soles.finding import find_feet
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.contacts.standing.references import preferred, reference_poses
from thesis_pin.loops.checking.poses import in_range

ROBOTS = {
    "talos": "talos_reduced_box",
    "bolt": "bolt",
    "anymal": "anymal_c_simple_description/anymal",
    "solo12": "solo12",
    "g1": "g1_29dof_rev_1_0",
}
FLOORS = {"flat": Floor(), "slope": Floor(0.2, np.radians(10), 0.7)}


@cache
def standing(name):
    """A robot, its feet and the pose it stands in; not to be changed."""
    robot = thesis_pin.load(f"example:{ROBOTS[name]}", root_joint=pin.JointModelFreeFlyer())
    poses = reference_poses(robot)
    pose = poses.get(preferred(list(poses)), robot.q0)
    return robot, find_feet(robot, pose=pose), pose


def random_pose(name, rng, floor, size=0.1):
    """A pose near the standing one, with its feet on the floor as well as they fit."""
    robot, feet, pose = standing(name)
    step = rng.normal(size=robot.model.nv) * size
    step[:6] = 0.0
    moved = in_range(robot, pin.integrate(robot.model, pose, step))
    return stand(robot, feet, moved, floor).q


def random_states(name, rng, count, floor):
    """Poses near the standing one with any rates and accelerations: ``q, v, a``."""
    robot, _, _ = standing(name)
    q = np.array([random_pose(name, rng, floor) for _ in range(count)])
    return q, rng.normal(size=(count, robot.model.nv)), rng.normal(size=(count, robot.model.nv))


def at_rest(robot, frame, q, rng):
    """Random rates and accelerations during which a frame rests: ``v, a``."""
    model, data = robot.model, robot.model.createData()
    v, a = rng.normal(size=model.nv), rng.normal(size=model.nv)
    jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL)
    v[:6] = -np.linalg.solve(jacobian[:, :6], jacobian[:, 6:] @ v[6:])
    a[:6] = 0.0
    pin.forwardKinematics(model, data, q, v, a)
    drift = pin.getFrameAcceleration(model, data, frame, pin.LOCAL).vector
    a[:6] = -np.linalg.solve(jacobian[:, :6], drift)
    return v, a
