"""A URDF and a closure file are enough: torques of any looped robot.

The ten lines of torques() are all it takes; shown for a planar five-bar
and for Pollard itself.
"""

from pathlib import Path

import numpy as np

import pollard_pin
from thesis_pin.loops.dynamics import inverse_dynamics
from thesis_pin.loops.kinematics import close, follow
from thesis_pin.loops.loading import load


def torques(urdf, closures, guess):
    """Swing every motor by 0.1 rad and ask for torques and loop forces."""
    robot = load(urdf, closures)
    start = close(robot, np.asarray(guess))
    time = np.linspace(0.0, 2.0, 201)[:, None]
    phase = np.pi * time + np.zeros(len(robot.actuators))
    home = start[robot.actuated_q]
    swing = home + 0.05 * (1 - np.cos(phase))
    rates, accelerations = 0.05 * np.pi * np.sin(phase), 0.05 * np.pi**2 * np.cos(phase)
    motion = follow(robot, time[:, 0], swing, rates, accelerations, start)
    return robot, inverse_dynamics(robot, motion.q, motion.v, motion.a)


def show(robot, found):
    print(f"{robot.model.name}: {int(found.freedom[0])} degrees of freedom")
    for name, peak in zip(robot.actuators, np.abs(found.torque).max(axis=0), strict=True):
        print(f"  {name:18s} peak {peak:8.4f} N·m")
    for loop, force in zip(robot.loops, np.moveaxis(found.force, -2, 0), strict=True):
        print(f"  {loop.name:18s} peak {np.linalg.norm(force, axis=-1).max():8.4f} N")
    print(f"  equations of motion met to {found.residual.max():.0e}")


data = Path(__file__).parents[1] / "tests" / "thesis_pin" / "loops" / "data"
show(*torques(data / "five_bar.urdf", data / "five_bar.yaml", [-1.9, 1.2, -1.2, -1.2]))

guess = pollard_pin.load().inverse_kinematics([0.45, 0.05, 0.0, 0.1, 0.1, 0.1]).angles
show(*torques(pollard_pin.URDF_PATH, pollard_pin.CLOSURE_PATH, guess))
