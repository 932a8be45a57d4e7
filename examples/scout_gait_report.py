"""Can the thesis's gait walk? Can the one beside this file?

Run: python examples/scout_gait_report.py
"""

from pathlib import Path

import scout_pin

robot = scout_pin.load()
for name in ("thesis", Path(__file__).parent / "walk.toml"):
    report = scout_pin.gait_report(robot, scout_pin.load_gait(name))
    print(f"Gait {report.gait.name!r}")
    for sentence in report.verdict():
        print(f"  {sentence}")
    worst = report.actuators.peak_torque.argmax()
    print(
        f"  Largest torque: {report.actuators.peak_torque[worst]:.3f} N·m in "
        f"{report.actuators.names[worst]}"
    )
