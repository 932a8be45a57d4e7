"""What commands on the shipped robots don't import: it takes longer than all they do."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HEAVY = {
    *("pydantic", "scipy", "rich", "yaml", "matplotlib", "shapely", "yourdfpy", "trimesh"),
    *("lxml", "meshcat", "numpy.ma", "plotly", "jinja2", "urllib.request", "tomllib"),
    *("multiprocessing", "html", "thesis_pin.report.figures", "thesis_pin.report.curves"),
    *("thesis_pin.smoothing.noise", "thesis_pin.smoothing.resolution"),
}
IK = ("ik", "left", "--position", "-0.0445", "-0.02", "-0.22")
TOOL = ("ik", "0.45", "0", "0.05", "0", "10", "0")
LOPSIDED = str(ROOT / "examples" / "lopsided.toml")
WALK = str(ROOT / "examples" / "walk.toml")


def imported(package, *words, cwd):
    """Heavy modules that a command has imported when it ends."""
    code = (
        "import json, sys\n"
        f"from {package}.cli import main\n"
        f"code = main({list(words)!r})\n"
        f"found = sorted({HEAVY!r} & set(sys.modules))\n"
        "print(json.dumps([int(code), found]), file=sys.stderr)\n"
    )
    command = [sys.executable, "-c", code]
    ran = subprocess.run(command, capture_output=True, text=True, cwd=cwd, check=False)
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout
    return json.loads(ran.stderr.splitlines()[-1])


@pytest.mark.parametrize(
    ("package", "words"),
    [
        ("scout_pin", ("gait", "--samples", "41")),
        ("scout_pin", ("gait", "--samples", "41", "--gait", "thesis-program")),
        ("scout_pin", ("info",)),
        ("scout_pin", IK),
        ("pollard_pin", ("trajectory", "--samples", "41")),
        ("pollard_pin", TOOL),
    ],
    ids=["gait", "program's gait", "info", "ik", "trajectory", "Pollard's ik"],
)
def test_commands_on_what_ships_import_nothing_heavy(tmp_path, package, words):
    assert imported(package, *words, cwd=tmp_path) == [0, []]


def test_json_of_a_shipped_gait_imports_nothing_heavy(tmp_path):
    assert imported("scout_pin", "gait", "--samples", "41", "--json", "-", cwd=tmp_path) == [0, []]


def test_files_of_ones_own_that_are_right_need_only_a_reader_of_toml(tmp_path):
    gait = imported("scout_pin", "gait", "--gait", WALK, "--samples", "41", cwd=tmp_path)
    info = imported("scout_pin", "info", "--specification", LOPSIDED, cwd=tmp_path)
    assert gait == info == [0, ["tomllib"]]


def test_pollards_info_with_its_mobility_imports_nothing_heavy(tmp_path):
    code, found = imported("pollard_pin", "info", cwd=tmp_path)
    assert code == 0
    assert found == []
