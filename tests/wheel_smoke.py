"""Run in a clean virtual environment outside the checkout, with the wheel installed.

Usage: python wheel_smoke.py BIN, the folder of the installed commands.
"""

import json
import subprocess
import sys
from pathlib import Path

import pollard_pin
import scout_pin

here = Path(scout_pin.__file__).parent
assert "site-packages" in str(here), f"the checkout is imported, not the wheel: {here}"
assert "site-packages" in scout_pin.URDF_PATH
assert Path(scout_pin.URDF_PATH).is_file()
assert not (here.parent / "urdf").exists(), "site-packages got a folder called urdf"
assert scout_pin.load().model.nv == 18
for path in (pollard_pin.URDF_PATH, pollard_pin.CLOSURE_PATH):
    assert "site-packages" in path
    assert Path(path).is_file()
assert pollard_pin.load().model.nv == 12

bin_folder = Path(sys.argv[1])


def output(*words: str) -> str:
    """Standard output of an installed command."""
    command = [str(bin_folder / words[0]), *words[1:]]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


report = json.loads(output("scout-pin", "gait", "--json", "-"))
assert report["summary"]["can_walk"] is False
assert output("scout-pin", "urdf") == Path(scout_pin.URDF_PATH).read_text()
assert "scout" in output("scout-pin", "info")
assert "misprint" in output("scout-pin", "audit", "--equation", "scout:4.4.2:dr_0i/dq_j")
assert "wrong" in output("pollard-pin", "audit", "--equation", "pollard:3.2.5:k_8")
motors = json.loads(output("pollard-pin", "trajectory", "--json", "-"))["actuators"]
assert len(motors) == 6
assert output("pollard-pin", "urdf") == Path(pollard_pin.URDF_PATH).read_text()
found = output("thesis-pin", "check", pollard_pin.URDF_PATH, pollard_pin.CLOSURE_PATH)
assert "6 by rank" in found
for words in ("scout-pin view", "scout-pin gait", "pollard-pin view", "pollard-pin trajectory"):
    assert output(*words.split(), "--html", "-").startswith("<!doctype html>"), words
print("the installed wheel works")
