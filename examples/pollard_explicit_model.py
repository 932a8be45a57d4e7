"""The Pollard thesis's own equations against Pinocchio, corrected and as printed."""

import numpy as np
import pinocchio as pin

import pollard_pin
from pollard_pin.specification import ACTUATOR_SYMBOLS, ACTUATORS
from pollard_pin.thesis import ExplicitModel

robot = pollard_pin.load()
pose = np.array([0.42, 0.08, 0.05, 0.1, -0.2, 0.3])  # x, y, z [m], ψ, θ, φ [rad]
rate = np.array([0.1, -0.2, 0.15, 0.4, -0.3, 0.5])
acceleration = np.array([0.5, 0.2, -0.4, 1.0, 0.8, -0.6])

# Pinocchio's tree, projected on the closed mechanism: Q = Jᵀ rnea(θ, θ̇, θ̈).
q, v, a = robot.joint_motion(pose, rate, acceleration)
expected = robot.rate_jacobian(q).T @ pin.rnea(robot.model, robot.model.createData(), q, v, a)
motors = robot.rate_jacobian(q)[list(ACTUATORS)].T

for edition in ("corrected", "printed"):
    model = ExplicitModel(edition=edition)
    rows = model.rows(pose)  # k_2, k_6, k_7, k_12, k_18, k_25, then the side chains'
    force = model.generalized_force(pose, rate, acceleration)  # D q̈ + V q̇ + C
    error = np.abs(force - expected).max() / np.abs(expected).max()
    print(f"{edition}: generalized force differs from Pinocchio by {error:.1e}")
    torque = np.linalg.solve(motors, force)
    texts = (f"{name} {one:+.3f}" for name, one in zip(ACTUATOR_SYMBOLS, torque, strict=True))
    print(f"  motors would need {', '.join(texts)} N·m")
    lost = [line for line, why in model.substituted.items() if "follows from the rest" in why]
    if lost:
        print(f"  {len(lost)} lines are lost in the text; what follows from the rest stands in")
    replaced = len(model.substituted) - len(lost)
    if replaced:
        print(f"  {replaced} printed lines can't be computed; their corrections stand in")

middle = np.array([0.45, 0.0, 0.0, 0.0, 0.0, 0.0])
print(f"On appendix B's curve at y = 0 the formulas divide by {ExplicitModel().margin(middle):.0e}")
