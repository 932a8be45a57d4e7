"""A spray path of one's own: up an arch and back along a line, and what it asks of the motors."""

import pollard_pin
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.specification import SKEWED_PATH
from thesis_pin.errors import ThesisPinError

robot = pollard_pin.load()
left, right = [0.45, -0.15, 0.0, 0, 0, 0], [0.45, 0.15, 0.0, 0, 0, 0]
path = joined([arc(left, [0.5, 0.0, 0.12], right, 3.0), line(right, left, 2.0)], name="arch")

report = pollard_pin.trajectory_report(robot, path, samples=1001)
summary = report.summary()
for name, peak, work in zip(
    pollard_pin.ACTUATOR_NAMES, summary["peak_torque"], summary["net_work"], strict=True
):
    print(f"{name:16s} peak {peak:7.4f} N·m, net work {work * 1e3:8.3f} mJ")
energy = summary["energy"]
print(f"a closed path: energy balances to {energy['relative_error']:.0e} of what is exchanged")
print(f"pins of the ball joints carry up to {summary['peak_loop_force'].round(2)} N")

# What can't be done is said before anything moves.
into_the_base = line(left, [0.2, 0.0, -0.1, 0, 0, 0], 2.0)
try:
    pollard_pin.trajectory_report(robot, into_the_base)
except ThesisPinError as error:
    print(f"{type(error).__name__}: {error}")

# Another robot of the same kind is another file.
other = pollard_pin.trajectory_report(pollard_pin.load(SKEWED_PATH), path)
print(f"skewed would need {other.summary()['peak_torque'][:3].round(3)} N·m at its base")
