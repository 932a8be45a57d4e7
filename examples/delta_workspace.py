"""A delta's workspace: where its tool can go, how well three motors hold it there, what it takes.

Its description is examples/delta.urdf, and what a URDF can't say, the ball joints of its rods and
what closes its five loops, examples/delta.yaml. Nothing here is about deltas: any robot goes like
this.
"""

from pathlib import Path

import numpy as np

import thesis_pin

examples = Path(__file__).parent
robot = thesis_pin.load(examples / "delta.urdf", examples / "delta.yaml")

# Where can the tool go? Inverse kinematics of every cell, from one cell to the next.
x, z = np.linspace(-0.3, 0.3, 31), np.linspace(-0.55, -0.15, 21)
space = thesis_pin.evaluate_workspace(robot, {"x": x, "z": z}, at={"y": 0.0}, frame="tool")
letters = {"reachable": ".", "limit": "L", "open": "#", "cut off": " "}
print("x from -0.3 to 0.3 m, z from -0.15 m down to -0.55 m; L: a joint leaves its range")
for row in reversed(range(len(z))):
    print("  " + "".join(letters.get(space.words[k], "?") for k in space.state[:, row]))
print(f"{space.reachable.mean():.0%} is reachable")
best = np.unravel_index(np.nanargmin(space.condition), space.condition.shape)
print(f"best held at x = {x[best[0]]:.2f} m, z = {z[best[1]]:.2f} m: {space.condition[best]:.2f}")

# What does picking a part ask of the motors? The table leads the tool, not the motors.
motion = thesis_pin.read_motion(robot, examples / "delta_pick.csv", frame="tool")
report = thesis_pin.torque_report(robot, motion)
for name, peak, speed in zip(
    report.names, report.actuators.peak_torque, report.actuators.peak_speed, strict=True
):
    print(f"{name}: {peak:.3f} N·m at most, up to {speed:.2f} rad/s")
print(report.verdict()[0])

# Which servos of a list would do?
sizing = thesis_pin.size_motors(report, thesis_pin.read_catalogue(examples / "servos.csv"))
print(sizing.verdict()[0])
