"""Servos for any robot: the same numbers as the torques of a robot that has these servos."""

import mechanisms
import numpy as np
import pytest

import thesis_pin
from thesis_pin.errors import BadInput
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.configurations.closing import close
from thesis_pin.loops.motion.told import JointMotion
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.report.torque.document import torque_report
from thesis_pin.sizing.actuator import Actuator
from thesis_pin.sizing.catalogue import Catalogue

SERVO = Actuator("servo", 8.0, 12.0, rotor_inertia=2e-6, gear_ratio=100.0)
TIME = np.linspace(0, 1, 101)
POSE = [2.2, -1.3, 0.9, 1.2]


def five_bar(extra=""):
    tree, _ = mechanisms.five_bar()
    return tree.robot(extra)


def report_of(robot, joints=("left_joint", "right_joint"), pose=POSE):
    start = close(robot, np.array(pose, float))
    wave, slope = 2 * np.pi * TIME[:, None], np.ones(len(joints))
    at = start[[robot.model.joints[robot.model.getJointId(name)].idx_q for name in joints]]
    motion = JointMotion(
        "swing",
        TIME,
        tuple(joints),
        at + 0.2 * np.sin(wave) * slope,
        0.4 * np.pi * np.cos(wave) * slope,
        -0.8 * np.pi**2 * np.sin(wave) * slope,
    )
    return torque_report(robot, motion, pose=start)


def test_torques_are_those_of_a_robot_with_the_servo():
    inertia = SERVO.armature
    own = report_of(
        five_bar(f"thesis_pin: {{armature: {{left_joint: {inertia}, right_joint: {inertia}}}}}\n")
    )
    bare = report_of(five_bar("thesis_pin: {armature: {left_joint: 0.003}}\n"))
    sizing = thesis_pin.size_motors(bare, Catalogue((SERVO,)))
    np.testing.assert_allclose(sizing.fits.peak[0], own.actuators.peak_torque, rtol=1e-9)
    np.testing.assert_allclose(sizing.fits.rms[0], own.actuators.rms_torque, rtol=1e-9)
    use = np.abs(own.dynamics.torque) / 8.0 + np.abs(own.speed) / 12.0
    np.testing.assert_allclose(sizing.fits.use[0], use.max(axis=0), rtol=1e-9)
    document = sizing.document("thesis-pin")
    assert document["schema"] == "thesis-pin/size"
    assert document["joints"] == ["left_joint", "right_joint"]
    assert any("own rotors" in note for note in document["notes"])


def test_motors_that_slide_are_left_out_and_named():
    t = mechanisms.Tree()
    t.link("cart", "ground", (1, 0, 0), bar=(0.1, 0, 0), type="prismatic", motor=True)
    t.link("arm", "cart", (0, 1, 0), bar=(0.3, 0, 0), motor=True)
    report = report_of(t.robot(), ("cart_joint", "arm_joint"), [0.1, 0.2])
    sizing = thesis_pin.size_motors(report, Catalogue((SERVO,)))
    assert sizing.loads.joints == ("arm_joint",)
    np.testing.assert_allclose(sizing.loads.torque[:, 0], report.dynamics.torque[:, 1])
    assert "Left out, for they slide: cart_joint." in sizing.notes()


def test_a_robot_without_motors_that_turn_is_refused():
    t = mechanisms.Tree()
    t.link("cart", "ground", (1, 0, 0), bar=(0.1, 0, 0), type="prismatic", motor=True)
    report = report_of(t.robot(), ("cart_joint",), [0.1])
    with pytest.raises(BadInput, match="no motor turns"):
        thesis_pin.size_motors(report, Catalogue((SERVO,)))


def test_more_motors_than_freedoms_are_said():
    tree, _ = mechanisms.five_bar()
    text = tree.yaml.replace("'right_joint'", "'right_joint', 'left_rod_joint'")
    extra = ClosedRobot(tree.urdf, ClosureFile.parse(text))
    joints = report_of(five_bar()).joints
    three = [extra.model.joints[extra.model.getJointId(name)].idx_q for name in extra.actuators]
    motion = JointMotion(
        "swing", TIME, extra.actuators, joints.q[:, three], joints.v[:, three], joints.a[:, three]
    )
    report = torque_report(extra, motion, pose=joints.q[0])
    sizing = thesis_pin.size_motors(report, Catalogue((SERVO,)))
    assert len(sizing.loads.joints) == 3
    assert any("more motors than freedoms" in note for note in sizing.notes())


def test_the_smallest_motors_are_what_torques_of_a_robot_with_them_use_wholly():
    joint = "{left_joint: 0.02, right_joint: 0.02}"
    own = report_of(five_bar(f"thesis_pin: {{armature: {joint}}}\n"))
    bare = report_of(five_bar())
    family = thesis_pin.motor_family(bare, speed=12.0, armature=0.02, bound="line")
    (case,) = thesis_pin.smallest_motors(bare, family).cases
    use = np.abs(own.dynamics.torque) / case.once + np.abs(own.speed) / 12.0
    np.testing.assert_allclose(use.max(axis=0), 1.0, rtol=1e-6)
    long = np.sqrt(np.trapezoid(own.dynamics.torque**2, own.joints.time, axis=0) / 1.0) / 0.5
    np.testing.assert_allclose(case.long, np.maximum(case.once, long), rtol=1e-6)
    (alike,) = thesis_pin.smallest_motors(bare, family, per="robot").cases
    np.testing.assert_allclose(alike.once, case.once.max())


def test_motors_of_any_size_have_the_description_s_speeds_and_rotors():
    robot = five_bar("thesis_pin: {armature: {left_joint: 0.003}}\n")
    report = report_of(robot)
    family = thesis_pin.motor_family(report)
    np.testing.assert_allclose(family.armature, [0.003, 0.0])
    limits = robot.model.velocityLimit[robot.actuated]
    known = np.isfinite(limits) & (limits > 0) & (limits < 1e6)
    np.testing.assert_allclose(family.speed, np.where(known, limits, np.inf))
    (case,) = thesis_pin.smallest_motors(report).cases
    np.testing.assert_allclose(case.once, report.actuators.peak_torque, rtol=1e-9)
