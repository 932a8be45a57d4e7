"""Every example runs, stays short, and prints what it promises."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
SCRIPTS = sorted(EXAMPLES.glob("*.py"))

SAYS = {
    "anymal_trot": "The robot keeps its balance.",
    "talos_lean": "It stands from 1.5° to 11.0° of its ankle.",
    "any_robot_torques": "the closest is chain1_shoulder with 8%",
    "delta_workspace": "No motor exceeds its limits; the closest is motor_1",
    "meshcat_viewer": "its tool has moved by 100 mm, its loops stayed closed",
    "scout_explicit_model": "8.81468 N stay unbalanced",
    "scout_inverse_kinematics": "reach the target to",
    "scout_gait_report": "Scout can walk this gait",
    "scout_another_biped": "Lopsided can walk this gait",
    "pollard_closed_loop_torques": "five_bar: 2 degrees of freedom",
    "pollard_explicit_model": "printed: generalized force differs from Pinocchio by 3.9e+00",
    "pollard_kinematics": "16 of 16 useful branches reach the pose",
    "pollard_accuracy": "What moves it most: encoder.chain1_shoulder",
    "pollard_placement": "the motors peak at 0.929 N·m",
    "sweep_arms": "9 of 9 designs keep every limit (within_limits).",
    "sweep_walking_speed": "Nearest to the wish is design 3: servos.*.stall_torque = 0.432",
    "motors_to_choose": "by the report: 0.851 N·m at the base",
    "pollard_fast_path": "at its fastest: 0.558 s",
    "pollard_spray_path": "the path crosses a singularity of the actuation",
}


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_example_runs_from_anywhere(script, tmp_path):
    done = subprocess.run(
        [sys.executable, str(script)],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(EXAMPLES.parent)},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert SAYS[script.stem] in done.stdout
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_example_is_under_60_lines(script):
    assert len(script.read_text().splitlines()) < 60


def test_scenes_and_single_configurations_go_to_meshcat_as_documented():
    text = (EXAMPLES.parent / "docs" / "viewer.md").read_text(encoding="utf-8")
    section = text.split("## In meshcat")[1]
    code = "".join(part.split("```")[0] for part in section.split("```python")[1:3])
    code += "assert len(page) > 500_000\nprint(len(viewer.static_html()))"
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": str(EXAMPLES.parent)},
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout.splitlines()[-1]) > 100_000
