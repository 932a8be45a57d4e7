"""The thesis's own equations against Pinocchio, corrected and as printed."""

import numpy as np
import pinocchio as pin

import scout_pin
from scout_pin.thesis import ExplicitModel
from thesis_pin.errors import NoSolution

robot = scout_pin.load(root="thesis")  # q is the thesis's vector (4.2)
generator = np.random.default_rng(1)
q, v, a = generator.uniform(-1, 1, (3, 18))

expected = pin.rnea(robot.model, robot.data, q, v, a)
for edition in ("corrected", "printed"):
    model = ExplicitModel(edition=edition)
    force = model.generalized_force(q, v, a)  # D q̈ + V q̇ + C
    error = np.abs(force - expected).max() / np.abs(expected).max()
    print(f"{edition}: differs from Pinocchio by {error:.1e}")
    if model.substituted:
        print(f"  {len(model.substituted)} printed lines can't be computed and were replaced")

standing, still = np.zeros(18), np.zeros(18)
standing[1:3] = 38.5e-3, 234.37e-3
torque = ExplicitModel().solve(standing, still, still, 1).torque
print(f"(4.23) corrected, on the left foot: up to {np.abs(torque).max():.3f} N·m")
try:
    ExplicitModel(edition="printed").solve(standing, still, still, 1)
except NoSolution as error:
    print(error)
