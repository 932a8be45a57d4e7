"""docs/rounding.md: what it promises, and that a few of its cells come out again."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "rounding.md").read_text(encoding="utf-8")
ROW = re.compile(r"^\| [\d.]+ Hz \| .* \|$", re.MULTILINE)


def test_the_truth_lies_inside_and_no_verdict_is_wrong():
    head = " ".join(PAGE.split("Cells:")[0].split())
    count, inside, wrong = re.search(
        r"(\d+) cells: .* in (\d+) \([\d.]+%\); (\d+) wrong verdicts", head
    ).groups()
    assert len(ROW.findall(PAGE)) >= int(count) >= 200
    assert int(inside) >= 0.98 * int(count)
    assert int(wrong) == 0
    fine, useless = re.search(
        r"Of the (\d+) cells at 0.01 mm or finer (\d+) have no", head
    ).groups()
    assert 4 * int(useless) <= int(fine)


@pytest.mark.parametrize(
    ("name", "rate", "how"), [("walk", 60.0, 4), ("squat", 25.0, 1e-4), ("stride", 100.0, 5)]
)
def test_cells_come_out_again(name, rate, how):
    script = runpy.run_path(str(ROOT / "docs" / "rounding.py"))
    truth = next(one for one in script["truths"]() if one.name == name)
    place = [*script["DECIMALS"], *script["NOISES"]].index(how)
    random = np.random.default_rng(script["seeds"](truth.name, rate, place))
    found = script["cell"](truth, rate, how, random)
    assert found.inside
    assert not found.wrong
    line = f"| {rate:g} Hz | {found.how} | {script['bounds'](found.margin, 1e3, 2)} |"
    assert line in PAGE.replace("**", "")


def test_cells_of_paths_come_out_again():
    script = runpy.run_path(str(ROOT / "docs" / "rounding_paths.py"))
    name, path = next(one for one in script["paths"]() if one[0] == "nod")
    place = [*script["DECIMALS"], *script["NOISES"]].index(4)
    random = np.random.default_rng(script["seeds"](name, 60, place))
    robot = script["pollard_pin"].load()
    true = script["trajectory_report"](robot, path, samples=4001).actuators.peak_torque
    found = script["cell"](robot, path, 60, 4, random, true)
    assert not found.outside
    assert f" {script['told'](found)} |" in PAGE
    assert len(re.findall("42 cells; in 42 the true peaks", PAGE)) == 2
