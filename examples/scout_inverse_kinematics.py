"""All joint angles that put Scout's left foot somewhere, and which of them are usable.

Run: python examples/scout_inverse_kinematics.py
"""

import numpy as np
import pinocchio as pin

import scout_pin

robot = scout_pin.load()

# The neutral foot, raised by 30 mm, 20 mm forward, toes out by 10°.
neutral = pin.SE3(robot.neutral_feet()["left"])
target = pin.SE3(pin.utils.rotate("z", np.radians(10)), np.array([0.0, 0.02, 0.03]))
target = pin.SE3(target.rotation, neutral.translation + target.translation)

solutions = robot.leg_inverse_kinematics("left", target)
print(solutions.explain())
for signs, angles, valid in zip(scout_pin.BRANCHES, solutions.angles, solutions.valid, strict=True):
    degrees = " ".join(f"{value:8.2f}" for value in np.degrees(angles))
    print(f"{signs!s:12} {degrees}  {'valid' if valid else ''}")

# Pinocchio agrees: its q is the torso's place and the angles of all twelve joints.
angles = np.zeros(12)
angles[:6] = solutions.angles[solutions.valid][0]
q = robot.configuration(np.eye(4), angles)
pin.framesForwardKinematics(robot.model, robot.data, q)
reached = robot.data.oMf[robot.sole_frames["left"]]
error = np.abs(reached.homogeneous - target.homogeneous).max()
print(f"Pinocchio's forward kinematics reach the target to {error:.1e}")
