"""Where should appendix B's curve stand? Least torque, and where singularities are far.

Run it from the repository: python examples/pollard_placement.py
"""

import numpy as np

import pollard_pin

robot = pollard_pin.load()
printed = pollard_pin.appendix_b(placement=[0.0, 0.0, 0.0])
now = pollard_pin.Placement((0.45, 0.0, 0.0))  # where the specification puts it
x, z = np.linspace(0.35, 0.55, 5), np.linspace(0.0, 0.15, 4)

for objective in ("torque", "clearance"):
    places = pollard_pin.evaluate_placements(
        robot, printed, x=x, z=z, objective=objective, samples=201, start=now
    )
    best, start = places.best[0], places.start
    print(f"\nFor {objective}: {places.feasible} of {places.choices.count} placements are possible")
    for name, one in (("now", start), ("best", best)):
        position = ", ".join(f"{value:.4f}" for value in one.placement.position)
        print(
            f"{name:>5} ({position}) m: peak torque {one.torque.max():.3f} N·m, condition number "
            f"{one.condition:.1f}, least sine of a singularity {one.clearance:.3f}"
        )

# The report at a placement is that of the path put there.
path = pollard_pin.place_path(printed, pollard_pin.Placement((0.5, 0.0, 0.15)))
report = pollard_pin.trajectory_report(robot, path)
print(f"\nAt (0.5, 0, 0.15) m the motors peak at {np.abs(report.torque).max():.3f} N·m")
