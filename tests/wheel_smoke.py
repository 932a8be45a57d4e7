"""Run in a clean virtual environment outside the checkout, with the wheel and no extra installed.

Usage: python wheel_smoke.py, in a folder that holds the repository's ``examples`` and ``urdf``.
"""

import json
import shlex
import subprocess
import sys
from importlib import import_module
from importlib.metadata import distribution
from importlib.util import find_spec
from pathlib import Path

import pollard_pin
import scout_pin
import thesis_pin

BIN = Path(sys.executable).parent


def ended(*words: str) -> "subprocess.CompletedProcess[str]":
    """An installed command, when it has ended."""
    return subprocess.run([BIN / words[0], *words[1:]], capture_output=True, text=True, check=False)


def output(*words: str) -> str:
    """Standard output of an installed command, which has to end with exit code 0."""
    done = ended(*words)
    assert done.returncode == 0, f"{shlex.join(words)}: exit {done.returncode}\n{done.stderr}"
    return done.stdout


for package in (thesis_pin, scout_pin, pollard_pin):
    here = Path(package.__file__).parent
    assert "site-packages" in here.parts, f"the checkout is imported, not the wheel: {here}"
    for name in ("py.typed", "__init__.pyi"):
        assert (here / name).is_file(), f"{here} lacks {name}"
    assert package.__version__ == distribution("thesis-pin").version
assert not (here.parent / "urdf").exists(), "site-packages got a folder called urdf"
for path in (scout_pin.URDF_PATH, pollard_pin.URDF_PATH, pollard_pin.CLOSURE_PATH):
    assert "site-packages" in path
    assert Path(path).is_file()
for name in ("mujoco", "pytest", "mypy"):
    assert find_spec(name) is None, f"{name} is here, so this isn't what a user has"
assert (scout_pin.load().model.nv, pollard_pin.load().model.nv) == (18, 12)

# Every verb of every command does its example, or says what to install for it.
for script in distribution("thesis-pin").entry_points.select(group="console_scripts"):
    for verb in import_module(script.module).COMMAND.verbs:
        words = (script.name, *shlex.split(verb.example))
        if verb.name == "simulate":
            done = ended(*words)
            assert done.returncode == 2, done.stderr
            assert "pip install 'thesis-pin[simulate]'" in done.stderr, done.stderr
        else:
            output(*words)
        print(f"{script.name} {verb.example}", flush=True)

walk = Path("examples/walk.toml").read_text(encoding="utf-8")
assert output("scout-pin", "new", "-", "--example", "walk.toml") == walk, "examples don't travel"
report = json.loads(output("scout-pin", "gait", "--json", "-"))
assert report["summary"]["can_walk"] is False
motors = json.loads(output("pollard-pin", "trajectory", "--json", "-"))["actuators"]
assert len(motors) == 6
for command, path in (("scout-pin", scout_pin.URDF_PATH), ("pollard-pin", pollard_pin.URDF_PATH)):
    assert output(command, "urdf") == Path(path).read_text(encoding="utf-8")
for words in ("scout-pin view", "scout-pin gait", "pollard-pin view", "pollard-pin trajectory"):
    assert output(*words.split(), "--html", "-").startswith("<!doctype html>"), words
print("the installed wheel works")
