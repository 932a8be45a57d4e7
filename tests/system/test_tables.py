"""Tables as people have them, through all three commands."""

import json
from pathlib import Path
from types import SimpleNamespace

import commands
import numpy as np
import pytest

import scout_pin
from pollard_pin.motion.files import load_path
from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES
from thesis_pin.report.writers import csv_bytes

ROOT = Path(__file__).parents[2]


@pytest.fixture
def run(capfd, monkeypatch):
    """A command called in this process."""
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(ROOT)

    def call(command, *arguments):
        code, out, err = commands.run(command, list(map(str, arguments)), capfd)
        return SimpleNamespace(returncode=code, stdout=out, stderr=err)

    return call


def gait():
    made = scout_pin.load_gait(ROOT / "examples" / "walk.toml")
    t = np.linspace(made.start, made.end, 121)
    columns = {"t": t * made.time_unit, "support": made.sample(t).phase}
    for body in BODIES:
        for name, curve in zip(POSE_NAMES, made.curves[body], strict=True):
            columns[f"{body}_{name}"] = np.asarray(curve(t)).round(6) + 0.0
    return "scout-pin", ["gait", "--gait"], columns


def path():
    made = load_path(ROOT / "examples" / "spray_arch.toml").sample(101)
    names = ("x", "y", "z", "psi", "theta", "phi")
    return (
        "pollard-pin",
        ["trajectory", "--path"],
        {
            "t": made.time,
            # So fine that the samples count as exact, of which there is nothing to say.
            **dict(zip(names, made.pose.T.round(9) + 0.0, strict=True)),
        },
    )


def motors():
    files = [ROOT / "urdf" / "pollard" / f"pollard.{end}" for end in ("urdf", "closures.yaml")]
    lines = (ROOT / "examples" / "pollard_motors.csv").read_text().splitlines()
    names = lines[1].split(",")
    values = np.array([list(map(float, line.split(","))) for line in lines[2:]])
    angles = {
        name: column
        for name, column in zip(names, values.T, strict=True)
        if not name.endswith(("_rate", "_acceleration"))
    }
    return "thesis-pin", ["torque", *files], angles


@pytest.mark.parametrize("motion", [gait, path, motors])
def test_a_spreadsheet_s_table_gives_the_same_numbers_and_says_so(run, motion, tmp_path):
    command, words, columns = motion()
    plain = csv_bytes(columns).decode()
    continental = "sep=;\n" + plain.replace(",", ";").replace(".", ",").replace("\n", ";;\r\n")
    (tmp_path / "a.csv").write_text(plain)
    (tmp_path / "b.csv").write_text("\ufeff" + continental, newline="")
    found = []
    for name in ("a", "b"):
        out = tmp_path / f"{name}.json"
        done = run(command, *words, tmp_path / f"{name}.csv", "--json", out)
        assert done.returncode == 0, done.stderr
        found.append(json.loads(out.read_text()))
    assert found[0]["notes"] == []
    assert "semicolons" in found[1]["notes"][0]
    assert "decimal commas" in " ".join(done.stdout.split())
    for key in ("time", "torque"):
        assert found[0][key] == found[1][key]


@pytest.mark.parametrize("motion", [gait, path, motors])
def test_milliseconds_in_t_are_doubted_before_the_verdict(run, motion, tmp_path):
    command, words, columns = motion()
    (time,) = {"t", "time", "time_s"} & columns.keys()
    scaled = {name if name != time else "t": values for name, values in columns.items()}
    scaled["t"] = columns[time] * 1e3
    (tmp_path / "a.csv").write_bytes(csv_bytes(scaled))
    done = run(command, *words, tmp_path / "a.csv", "--json", tmp_path / "a.json")
    assert done.returncode == 0, done.stderr
    text = " ".join(done.stdout.split())
    document = json.loads((tmp_path / "a.json").read_text())
    (doubt,) = document["summary"]["doubts"]
    assert "Is its time in milliseconds?" in doubt
    assert text.index("in milliseconds?") < text.index(document["summary"]["verdict"][0][:20])
    assert "in milliseconds?" in done.stderr
    renamed = {name if name != "t" else "t_ms": values for name, values in scaled.items()}
    (tmp_path / "b.csv").write_bytes(csv_bytes(renamed))
    done = run(command, *words, tmp_path / "b.csv", "--json", tmp_path / "b.json")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "b.json").read_text())["summary"]["doubts"] == []
    assert done.stderr.startswith("wrote ")


@pytest.mark.parametrize("motion", [gait, path, motors])
@pytest.mark.parametrize("lines", [0, 1, 2])
def test_a_table_of_hardly_any_rows_is_refused_in_one_line(run, motion, lines, tmp_path):
    command, words, columns = motion()
    kept = csv_bytes(columns).splitlines(keepends=True)[:lines]
    (tmp_path / "short.csv").write_bytes(b"".join(kept))
    done = run(command, *words, tmp_path / "short.csv")
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert "short.csv" in done.stderr
