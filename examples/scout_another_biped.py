"""The same analysis for a robot that isn't Scout: other lengths, unequal legs.

Run: python examples/scout_another_biped.py
"""

from pathlib import Path

import numpy as np

import scout_pin

HERE = Path(__file__).parent
robot = scout_pin.load(HERE / "lopsided.toml")
print(f"{robot.specification.name}: {robot.mass:.3f} kg")
for side, foot in robot.neutral_feet().items():
    print(f"  neutral {side} sole at {np.round(foot[:3, 3] * 1e3, 2)} mm")

# Every branch of many random poses is reached: the closed form holds for any such leg.
rng = np.random.default_rng(0)
for side, leg in robot.legs.items():
    poses = robot.leg_forward_kinematics(side, rng.uniform(leg.lower, leg.upper, (10_000, 6)))
    solutions = robot.leg_inverse_kinematics(side, poses)
    print(
        f"  {side} leg: {solutions.reachable.sum()} branches of 10 000 poses, "
        f"worst error {np.nanmax(solutions.position_residual):.1e} m"
    )

report = scout_pin.gait_report(robot, scout_pin.load_gait(HERE / "lopsided_walk.toml"))
print("\n".join(report.verdict()))
