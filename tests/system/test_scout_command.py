"""The command scout-pin: in a process of its own where that matters, else called directly."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"


def process(*arguments, code="import sys; from scout_pin.cli import main; sys.exit(main())"):
    """Run the command as a user does."""
    environment = os.environ | {"COLUMNS": "80", "PYTHONPATH": str(EXAMPLES.parent)}
    return subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        capture_output=True,
        text=True,
        env=environment,
        check=False,
    )


def test_default_report_says_plainly_that_the_thesis_gait_cannot_walk():
    done = process("gait")
    assert done.returncode == 0
    assert done.stderr == ""
    text = " ".join(done.stdout.split())
    assert "Scout can't walk this gait" in text
    assert "17.0 mm in 418 of 421 samples" in text
    assert "tip onto the foot it means to lift" in text
    assert "feet glued to the floor" in text
    assert "left_hip_yaw θ_11" in text
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_report_numbers_are_those_worked_out_by_hand_and_by_prototype(scout_pin):
    summary = json.loads(scout_pin("gait", "--json", "-", "--samples", "2001").stdout)["summary"]
    peaks = np.array(summary["peak_torque"])
    # Largest of both legs, joints 2 to 6; joint 1 depends on the double-support rule.
    largest = peaks.reshape(2, 6).max(axis=0)[1:]
    np.testing.assert_allclose(largest, [0.390, 0.113, 0.377, 0.263, 0.388], atol=1e-3)
    assert max(summary["peak_speed"]) == pytest.approx(1.46, abs=5e-3)
    fastest = summary["fastest_time_unit"]
    assert fastest["speed"] == pytest.approx(0.0321, abs=1e-4)
    assert fastest["torque"] == pytest.approx(0.0183, abs=1e-4)
    assert fastest["line"] > fastest["speed"]


@pytest.mark.parametrize("gait", ["thesis", "walk", "squat", "lopsided_walk"])
def test_a_gait_at_its_fastest_time_unit_just_meets_the_line(scout_pin, gait):
    # The last robot has joint friction, which doesn't scale like gravity or inertia;
    # the squat stands on two feet throughout.
    words = ["gait", "--json", "-"]
    words += ["--gait", gait if gait == "thesis" else EXAMPLES / f"{gait}.toml"]
    if gait == "lopsided_walk":
        words += ["--specification", EXAMPLES / "lopsided.toml"]
    first = json.loads(scout_pin(*words).stdout)["summary"]
    unit = first["fastest_time_unit"]["line"]
    second = json.loads(scout_pin(*words, "--time-unit", unit).stdout)["summary"]
    assert max(second["servo_use"]) == pytest.approx(1.0, abs=2e-4)
    assert unit >= first["fastest_time_unit"]["speed"]


def test_a_swinging_sole_that_dips_into_the_floor_breaks_a_limit(scout_pin, tmp_path):
    text = (EXAMPLES / "walk.toml").read_text()
    assert "value = [0, 10, 0]" in text
    (tmp_path / "dip.toml").write_text(text.replace("value = [0, 10, 0]", "value = [0, -2, 0]"))
    done = scout_pin("gait", "--gait", "dip.toml", "--strict", cwd=tmp_path)
    assert done.returncode == 1
    assert "A swinging sole goes 2.0 mm into the floor." in " ".join(done.stdout.split())


def test_json_has_every_documented_field_and_shape(scout_pin):
    document = json.loads(scout_pin("gait", "--json", "-", "--samples", "11").stdout)
    # Eleven evenly spaced samples, and those beside every change.
    count = len(document["time"])
    assert 11 < count == document["parameters"]["samples"]
    assert (document["schema"], document["version"]) == ("scout-pin/gait-report", 2)
    shapes = {
        "time": (count,),
        "theta": (count, 12),
        "theta_rate": (count, 12),
        "theta_acceleration": (count, 12),
        "torque": (count, 12),
        "left_wrench": (count, 6),
        "right_wrench": (count, 6),
        "com": (count, 3),
        "zmp": (count, 2),
        "margin": (count,),
    }
    for name, shape in shapes.items():
        assert np.shape(document[name]) == shape, name
    assert len(document["joints"]) == 12
    assert set(document["phase"]) == {"left", "right", "double"}
    assert document["parameters"]["time_unit"] == 0.1
    assert {a["name"] for a in document["assumptions"]} >= {"joint_range", "floor_friction"}


def test_out_writes_report_table_and_figures(scout_pin, tmp_path):
    done = scout_pin("gait", "--out", tmp_path / "report", "--gait", EXAMPLES / "walk.toml")
    assert done.returncode == 0
    names = {path.name for path in (tmp_path / "report").iterdir()}
    assert {"report.json", "samples.csv", "torques.png", "stability.svg"} <= names
    header, *rows = (tmp_path / "report/samples.csv").read_text().splitlines()
    assert len(rows) > 401
    assert "torque_left_hip_roll_Nm" in header.split(",")
    assert (tmp_path / "report/torques.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("gait", "specification"),
    [("walk.toml", None), ("lopsided_walk.toml", "lopsided.toml")],
)
def test_a_gait_that_walks_passes_strict(scout_pin, gait, specification):
    arguments = ["--gait", EXAMPLES / gait, "--strict"]
    if specification:
        arguments += ["--specification", EXAMPLES / specification]
    done = scout_pin("gait", *arguments)
    assert done.returncode == 0, done.stdout
    assert "can walk this gait" in done.stdout


@pytest.mark.parametrize("samples", ["2", "3"])
def test_few_samples_do_not_hide_that_the_thesis_gait_tips(scout_pin, samples):
    done = scout_pin("gait", "--samples", samples, "--strict")
    assert done.returncode == 1
    assert "can't walk this gait" in done.stdout


def test_a_gait_whose_rates_jump_cannot_be_walked(scout_pin):
    done = scout_pin(
        "gait", "--gait", EXAMPLES / "walk.toml", "--interpolation", "linear", "--strict"
    )
    assert done.returncode == 1
    assert "A planned rate jumps" in done.stdout


def test_strict_exits_1_when_the_gait_breaks_a_limit(scout_pin):
    assert scout_pin("gait", "--strict").returncode == 1


def test_printed_inertias_change_the_torques_by_a_thousandth(scout_pin):
    physical, printed = (
        np.array(json.loads(scout_pin("gait", "--json", "-", "--inertia", i).stdout)["torque"])
        for i in ("physical", "printed")
    )
    change = np.abs(physical - printed).max() / np.abs(physical).max()
    assert 1e-5 < change < 5e-3


BAD = {
    "missing gait": (["gait", "--gait", "no.toml"], "no.toml"),
    "unknown gait": (["gait", "--gait", "moonwalk"], "thesis-program"),
    "zero time unit": (["gait", "--time-unit", "0"], "positive"),
    "NaN time unit": (["gait", "--time-unit", "nan"], "positive"),
    "one sample": (["gait", "--samples", "1"], "at least 2"),
    "unknown interpolation": (["gait", "--interpolation", "bezier"], "quintic"),
    "missing specification": (["gait", "--specification", "no.toml"], "no.toml"),
    "gait beyond the joints' limits": (
        ["gait", "--specification", str(EXAMPLES / "lopsided.toml")],
        "reachable, but outside the joint limits",
    ),
    "too fast to stay on the floor": (["gait", "--time-unit", "0.001"], "floor would have to pull"),
    "NaN pose": (["ik", "left", "--position", "nan", "0", "0"], "finite"),
    "two coordinates": (["ik", "left", "--position", "0", "0"], "expected 3"),
    "unknown verb": (["dance"], "gait"),
    "zero speed": (["view", "--speed", "0"], "positive"),
    "negative hold": (["view", "--hold", "-1"], "positive"),
    "no port": (["view", "--port", "http"], "whole number"),
    "port too high": (["view", "--port", "70000", "--no-browser"], "65535"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_clear_message_exit_2_and_no_file(scout_pin, name, tmp_path):
    arguments, says = BAD[name]
    out = [] if arguments[0] in ("ik", "dance", "view") else ["--out", "made"]
    done = scout_pin(*arguments, *out, cwd=tmp_path)
    assert done.returncode == 2, done.stdout + done.stderr
    assert says in done.stderr
    assert "Traceback" not in done.stderr
    assert done.stdout == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments",
    [
        ["gait", "--out", __file__],
        ["gait", "--html", "no/where/report.html"],
        ["view", "--html", "no/where/view.html"],
        ["gait", "--json", "no/where/report.json"],
    ],
)
def test_what_cannot_be_written_is_refused_with_3_before_any_work(scout_pin, arguments, tmp_path):
    done = scout_pin(*arguments, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (3, "")
    assert "can't" in done.stderr
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_gait_out_of_reach_says_when_and_by_how_much(scout_pin, tmp_path):
    text = (EXAMPLES / "walk.toml").read_text()
    (tmp_path / "tall.toml").write_text(text.replace("z_mm = 216.00", "z_mm = 300"))
    done = scout_pin("gait", "--gait", "tall.toml", "--json", "report.json", cwd=tmp_path)
    assert done.returncode == 2
    assert "left foot, t = 0: unreachable: hip and ankle would be" in done.stderr
    assert "mm outside the 17.31 to 131.89 mm" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["tall.toml"]


def test_ik_lists_branches_and_explains(scout_pin):
    done = scout_pin("ik", "left", "--position", "-0.0445", "-0.02", "-0.22")
    assert done.returncode == 0
    assert done.stdout.count("valid") >= 1
    assert max(map(len, done.stdout.splitlines())) <= 80
    far = scout_pin("ik", "right", "--position", "0", "0", "-1")
    assert (far.returncode, far.stderr) == (1, "")
    assert "Unreachable: " in far.stdout
    far = scout_pin("ik", "right", "--position", "0", "0", "-1", "--json", "-")
    assert far.returncode == 1
    assert json.loads(far.stdout)["explanation"].startswith("unreachable: ")
    document = json.loads(
        scout_pin("ik", "left", "--position", "-0.0445", "-0.02", "-0.22", "--json", "-").stdout
    )
    assert len(document["branches"]) == 8


def test_info_and_urdf_describe_the_robot(scout_pin, tmp_path):
    text = scout_pin("info").stdout
    assert "0.89854 kg" in text
    assert "Assumed joint range" in text
    assert max(map(len, text.splitlines())) <= 80
    assert json.loads(scout_pin("info", "--json", "-").stdout)["mass"] == pytest.approx(0.89854)
    folder = EXAMPLES.parent / "urdf" / "scout"
    assert scout_pin("urdf").stdout == (folder / "scout.urdf").read_text()
    assert scout_pin("urdf", "--out", tmp_path / "made").returncode == 0
    for path in folder.rglob("*"):
        if path.is_file():
            made = tmp_path / "made" / path.relative_to(folder)
            assert made.read_bytes() == path.read_bytes()


def test_help_imports_nothing_heavy(scout_pin):
    probe = (
        "import sys\n"
        "from scout_pin.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'scipy', 'pinocchio', 'matplotlib', 'pydantic', 'rich', 'meshcat'}\n"
        "print(sorted(heavy & set(sys.modules)), file=sys.stderr)"
    )
    done = process("--help", code=probe)
    assert done.stderr.strip() == "[]"
    for verb in ("gait", "view", "ik", "info", "urdf"):
        assert verb in done.stdout
        assert "Example: scout-pin" in scout_pin(verb, "--help").stdout


def test_a_closed_pipe_is_no_error():
    command = (
        f'"{sys.executable}" -c "from scout_pin.cli import main; import sys; sys.exit(main())"'
    )
    environment = os.environ | {"PYTHONPATH": str(EXAMPLES.parent)}
    done = subprocess.run(
        f"{command} urdf | head -1",
        shell=True,
        capture_output=True,
        text=True,
        env=environment,
        check=False,
    )
    assert done.stdout.startswith("<?xml")
    assert "Traceback" not in done.stderr


def test_view_writes_one_page_and_serves_for_as_long_as_asked(scout_pin, tmp_path):
    done = scout_pin("view", "--html", "walk.html", "--gait", EXAMPLES / "walk.toml", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr == "wrote walk.html\n"
    assert (tmp_path / "walk.html").read_bytes().startswith(b"<!doctype html>")
    done = scout_pin("view", "--no-browser", "--port", "0", "--hold", "0.2")
    assert (done.returncode, done.stdout) == (0, "")
    assert "showing Scout, gait thesis at http://127.0.0.1:" in done.stderr


def test_view_on_a_busy_port_says_so(scout_pin, tmp_path):
    import socket

    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = scout_pin("view", "--no-browser", "--port", port)
    assert done.returncode == 2
    assert f"port {port}: the port is in use" in done.stderr
    assert "Choose another with --port" in done.stderr
    assert "Traceback" not in done.stderr


def test_gait_writes_its_report_as_a_page_beside_the_table(scout_pin, tmp_path):
    done = scout_pin("gait", "--html", "report.html", cwd=tmp_path)
    assert done.returncode == 0
    assert "Scout can't walk this gait" in done.stdout
    assert b"Scout can&#39;t walk this gait" in (tmp_path / "report.html").read_bytes()


def test_angles_of_a_leg_and_the_robots_numbers_need_neither_scipy_nor_matplotlib():
    probe = (
        "import sys\n"
        "from scout_pin.cli import main\n"
        "main()\n"
        "print(sorted({'scipy', 'matplotlib'} & set(sys.modules)), file=sys.stderr)"
    )
    leg = ("ik", "left", "--position", "-0.0445", "-0.02", "-0.22")
    for words in (("info",), leg, (*leg, "--json", "-")):
        assert process(*words, code=probe).stderr.strip() == "[]"


def test_a_gait_takes_the_branch_it_is_told(scout_pin):
    def theta(*words):
        done = scout_pin("gait", "--samples", "11", "--json", "-", *words)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)["theta"]

    assert theta() == theta("--branch=+++,-+-")
    other = scout_pin("gait", "--samples", "11", "--branch=+++,-++")
    assert other.returncode == 2
    assert "right foot, t = 0: branch -++ is outside the limits" in other.stderr
