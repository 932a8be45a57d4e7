"""Torques of any robot with loops, from its files and a CSV of its motors' motion."""

from pathlib import Path

import thesis_pin

root = Path(__file__).parents[1]
robot = thesis_pin.load(
    root / "urdf/pollard/pollard.urdf", root / "urdf/pollard/pollard.closures.yaml"
)
motion = thesis_pin.read_motion(robot, root / "examples/pollard_motors.csv")
report = thesis_pin.torque_report(robot, motion)

for name, peak, unit in zip(report.names, report.actuators.peak_torque, report.units, strict=True):
    print(f"{name:16} {peak:8.4f} {unit}")
for loop, force in zip(robot.loops, report.loop_force_size.max(axis=0), strict=True):
    print(f"{loop.name:16} {force:8.3f} N")
print(*report.verdict(), sep="\n")
