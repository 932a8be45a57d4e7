"""Which servo walks how fast? A walk is planned for each, at each speed (Scout thesis, 6.1).

Longer legs, too, and more of everything: docs/sweep.md has the command and what it finds.
"""

import scout_pin
import thesis_pin

if __name__ == "__main__":  # processes of a sweep begin by reading this file again
    study = scout_pin.plan_study(steps=1)
    varied = ["servos.*.stall_torque=0.2,0.432", "plan.speed=0.03,0.06"]
    designs = thesis_pin.make_designs(study, varied)
    sweep = thesis_pin.sweep_designs(study, designs, jobs=2)

    for row, met in zip(sweep.rows, sweep.feasible, strict=True):
        torque, speed = row.values
        print(f"{torque:5.3f} N·m, {speed * 1e3:3.0f} mm/s: {'walks' if met else 'no walk found'}")
    choice = thesis_pin.Choice.of(sweep, "speed,min:servos.*.stall_torque", "speed>0.05")
    print(*choice.sentences(), sep="\n")
