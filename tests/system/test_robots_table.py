"""The README's table of robots no one here made, as far as example-robot-data carries them."""

import json
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
STORED = json.loads((ROOT / "docs" / "robots.json").read_text(encoding="utf-8"))


def test_rows_of_example_robot_data_are_found_again_and_torques_agree():
    pytest.importorskip("mujoco")
    found = list(runpy.run_path(str(ROOT / "docs" / "robots.py"))["examples"]())
    stored = [one for one in STORED if one["source"] == "example-robot-data"]
    assert len(found) == len(stored) >= 5
    for new, old in zip(found, stored, strict=True):
        same = set(old) - {"difference", "microseconds"}
        assert {key: new[key] for key in same} == {key: old[key] for key in same}
        assert new["difference"] < (1e-12 if new["against"] == "MuJoCo" else 1e-8)


def test_no_stored_row_is_further_off_than_central_differences_are():
    assert all(one["difference"] < 1e-8 for one in STORED if "difference" in one)
    assert sum("difference" in one for one in STORED) >= 15
