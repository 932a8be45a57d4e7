"""How fast can Pollard's motors follow a path? And which law of 1 s loads them least?

Run: python examples/pollard_fast_path.py
"""

from pathlib import Path

import pollard_pin
from pollard_pin.study.timing.course import Course

robot = pollard_pin.load()
path = pollard_pin.load_path(Path(__file__).parent / "spray_arch.toml")
limits = pollard_pin.motor_limits(
    robot.specification, torque=[2.0, 2.0, 2.0, 0.05, 0.05, 0.05], speed=10.0
)
course = Course.of(robot, path)  # what all laws along this path share

fastest = pollard_pin.time_path(robot, course, limits)
print(f"{path.name} as written: {path.duration:.3f} s; at its fastest: {fastest.duration:.3f} s")
print(f"between the places of its grid it uses up to {fastest.solved.use.largest:.1%} of a limit")

gentle = pollard_pin.time_path(robot, course, limits, law="least-load", duration=1.0)
report = pollard_pin.trajectory_report(robot, gentle.path)
print(f"in 1 s no motor needs more than {gentle.largest_torque_share:.1%} of its torque limit:")
for name, peak in zip(report.actuators.names, report.actuators.peak_torque, strict=True):
    print(f"  {name:16} {peak:.3f} N·m")
