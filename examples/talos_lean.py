"""TALOS on its left foot: how far can it lean before it tips, slips or asks too much of an ankle?

It stands with its centre of mass above the sole, then turns about its ankle to the side.
Run it with ``python examples/talos_lean.py``.
"""

import numpy as np
import pinocchio as pin

import thesis_pin
from thesis_pin.contacts.standing.references import reference_poses
from thesis_pin.loops.joints import singles

robot = thesis_pin.load("example:talos_reduced_box", root_joint=pin.JointModelFreeFlyer())
pose = reference_poses(robot)["half_sitting"]
feet = thesis_pin.find_feet(robot, ["leg_left_6_link"], pose=pose)
roll = singles(robot.model)["leg_left_6_joint"]


def leaning(degrees):
    """The report of a pose that leans to the side by an angle of the ankle."""
    q = pose.copy()
    q[roll.q] += np.radians(degrees)
    return thesis_pin.balance_report(robot, pose=q, feet=feet)


angles = np.arange(-2.0, 16.1, 0.5)
reports = [leaning(angle) for angle in angles]
for angle, report in zip(angles[::4], reports[::4], strict=True):
    margin, torque = report.found.margin[0] * 1e3, report.motors.effort_use.max()
    print(f"{angle:5.1f}°  margin {margin:6.1f} mm  largest share of a torque limit {torque:4.0%}")

stands = [angle for angle, report in zip(angles, reports, strict=True) if report.balanced]
holds = [angle for angle, report in zip(angles, reports, strict=True) if report.within_limits]
print(f"It stands from {stands[0]:.1f}° to {stands[-1]:.1f}° of its ankle.")
if holds:
    print(f"Its motors hold it from {holds[0]:.1f}° to {holds[-1]:.1f}°.")
print(reports[0].verdict()[0])
