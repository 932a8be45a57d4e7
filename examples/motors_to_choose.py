"""How large motors have to be: Pollard's for a path in a time, Scout's for a gait at any speed."""

from pathlib import Path

import pollard_pin
import scout_pin
import thesis_pin

HERE = Path(__file__).parent

# Pollard: an arch that takes 5 s shall take 1.5 s; its law of time is free.
robot = pollard_pin.load()
path = pollard_pin.load_path(HERE / "spray_arch.toml")
report = pollard_pin.trajectory_report(robot, path, samples=1001)
answer = pollard_pin.smallest_motors(report, within=1.5)
print("\n".join(answer.verdict()))

# The report on the law that was found says the same.
confirmed = pollard_pin.trajectory_report(robot, answer.paths["least-torque"], samples=8001)
peaks = confirmed.actuators.peak_torque
print(f"by the report: {peaks[:3].max():.3f} N·m at the base, {peaks[3:].max():.4f} at the wrist")

# A list: which motor, at all six joints and with its own rotor, is in time?
servos = thesis_pin.read_catalogue(HERE / "servos.csv")
print(pollard_pin.time_with_motors(report, servos, within=1.5).verdict()[0])

# Scout: the smallest servos with which the walk can be walked at all, however slowly.
biped = scout_pin.load()
gait = scout_pin.gait_report(biped, scout_pin.load_gait(HERE / "walk.toml"), time_unit=0.05)
family = scout_pin.motor_family(biped, speed=5.0, armature=1e-3)
print("\n".join(scout_pin.smallest_motors(gait, family).verdict()))
