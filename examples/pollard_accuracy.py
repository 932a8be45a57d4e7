"""Which parts of Pollard have to be made well, for a spray tip that stays within half a millimetre.

Source: Pollard thesis, 5 (is the machine viable for its job?), loop equation (2.89).
"""

from pathlib import Path

import pollard_pin

EXAMPLES = Path(__file__).parent

robot = pollard_pin.load()
path = pollard_pin.load_path(EXAMPLES / "spray_arch.toml")
allowed = pollard_pin.read_tolerances(EXAMPLES / "tolerances.toml")

study = pollard_pin.path_accuracy(robot, path, allowed, draws=100, within=0.5e-3)
for sentence in study.verdict():
    print(sentence)

print("\nEqual tolerances of one kind, everything else exact:")
for one in study.within.equal:
    print(f"  {one.of:13} ±{one.worst:.3f} {one.unit} at worst, ±{one.root:.3f} by root sum square")
