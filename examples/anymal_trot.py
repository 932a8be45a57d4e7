"""ANYmal trots: forces on its feet and torques, from a table of its joints, base and contacts.

Run it with ``python examples/anymal_trot.py``.
"""

from pathlib import Path

import numpy as np
import pinocchio as pin

import thesis_pin
from thesis_pin.contacts.standing.told import headings_of, told_contacts

TABLE = Path(__file__).with_name("anymal_trot.csv")

free = pin.JointModelFreeFlyer()
robot = thesis_pin.load("example:anymal_c_simple_description/anymal", root_joint=free)
feet = thesis_pin.find_feet(robot)
names = [foot.name for foot in feet]
motion = thesis_pin.read_motion(robot, TABLE, beside=headings_of(names))
support = told_contacts(TABLE, names)

for sharing in ("torque", "force", "equal"):
    report = thesis_pin.balance_report(robot, motion, feet=feet, support=support, sharing=sharing)
    torque, force = np.abs(report.found.torque).max(), report.found.normal_force.max()
    used = max(report.peak_friction)
    print(f"{sharing:>6}: up to {torque:5.1f} N·m, {force:4.0f} N a foot, {used:4.0%} of friction")
print(report.verdict()[0])
