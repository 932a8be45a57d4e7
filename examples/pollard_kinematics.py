"""Every way to reach a pose, and every way to assemble the robot on six motor angles."""

import numpy as np

import pollard_pin
from pollard_pin.specification import ACTUATORS

robot = pollard_pin.load()
pose = np.array([0.45, 0.05, 0.05, *np.radians([10, -5, 20])])  # x, y, z, ψ, θ, φ

found = robot.inverse_kinematics(pose, "useful")
print(f"{int(found.valid.sum())} of {len(found.branches)} useful branches reach the pose;")
print(
    f"tip within {found.position_residual.max():.0e} m, "
    f"loops within {found.loop_residual.max():.0e} m"
)

best = robot.inverse_kinematics(pose)  # elbows up and outwards
names = zip(pollard_pin.JOINT_SYMBOLS, np.degrees(best.angles), strict=True)
print(", ".join(f"{name} {angle:.1f}°" for name, angle in names))
print(f"margin {best.margin:.3f}, ball joints turned by {np.degrees(best.rod_angles).round(1)}")

modes = robot.forward_kinematics(best.angles[list(ACTUATORS)])
print(f"the same motor angles fit {int(modes.count)} assembly modes, tips at")
for k in range(int(modes.count)):
    label = robot.branch_of(modes.angles[k])
    print(f"  {label}  {modes.pose[k, :3].round(4)}  closed to {modes.residual[k]:.0e} m")

rates = robot.rates(pose, [0.1, 0, 0, 0, 0, 0])
print(f"at 0.1 m/s along x the fastest joint turns at {np.abs(rates).max():.3f} rad/s")
print(robot.inverse_kinematics([0.1, 0.0, 0.05, 0, 0, 0]).explain())
