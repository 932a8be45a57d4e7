"""The command pollard-pin: in a process of its own where that matters, else called directly."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from thesis_pin.command.main import main as thesis_pin

ROOT = Path(__file__).parents[2]
DATA = ROOT / "tests" / "thesis_pin" / "loops" / "data"


def process(*arguments, code="import sys; from pollard_pin.cli import main; sys.exit(main())"):
    """Run the command as a user does."""
    environment = os.environ | {"COLUMNS": "80", "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        capture_output=True,
        text=True,
        env=environment,
        check=False,
    )


def test_default_run_with_printed_inertias_shows_the_peaks_and_the_assumptions():
    done = process("trajectory", "--inertia", "printed")
    assert done.returncode == 0
    assert done.stderr == ""
    text = " ".join(done.stdout.split())
    for peak in ("θ21 1.7478", "θ211 1.2762", "θ212 1.2699"):
        assert peak in text
    assert "determinant of constant sign" in text
    assert "the thesis uses them (3.2) and prints none" in text
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_report_as_json_has_the_documented_keys():
    done = process("trajectory", "--json", "-", "--samples", "51", "--inertia", "printed")
    document = json.loads(done.stdout)
    keys = (
        "actuators joints time pose theta theta_rate theta_acceleration torque power work "
        "loop_force condition margin parameters summary"
    )
    assert set(keys.split()) <= document.keys()
    assert np.shape(document["loop_force"]) == (51, 2, 3)
    np.testing.assert_allclose(
        document["work"], np.array(document["summary"]["net_work"]), atol=1e-9
    )


def test_out_writes_report_samples_and_the_thesis_figures(pollard_pin, tmp_path):
    done = pollard_pin("trajectory", "--out", tmp_path / "new" / "report", "--samples", "101")
    assert done.returncode == 0, done.stderr
    names = {file.name for file in (tmp_path / "new" / "report").iterdir()}
    figures = ("positions", "velocities", "accelerations", "actuators", "margins", "tool")
    assert names == {
        "manifest.sha256",
        "report.json",
        "samples.csv",
        "joint_trajectory.yaml",
        "ticks.csv",
        *(f"{figure}.{kind}" for figure in figures for kind in ("png", "svg")),
    }
    report = json.loads((tmp_path / "new" / "report" / "report.json").read_text())
    lines = (tmp_path / "new" / "report" / "samples.csv").read_text().splitlines()
    assert len(lines) == 102
    row = dict(zip(lines[0].split(","), map(float, lines[50].split(",")), strict=True))
    assert row["torque_chain0_shoulder_Nm"] == report["torque"][49][0]


def test_figures_are_chosen_by_the_thesis_numbers_or_by_name(pollard_pin, tmp_path):
    def asked(*words):
        return pollard_pin("trajectory", "--samples", "21", *words)

    out = tmp_path / "out"
    done = asked("--out", out, "--figure", "4.4", "tool", "--figure", "4.1")
    assert done.returncode == 0, done.stderr
    drawn = {file.stem for file in out.iterdir() if file.suffix == ".svg"}
    assert drawn == {"actuators", "tool", "positions"}
    assert (out / "report.json").is_file()
    for words, said in (
        (("--out", tmp_path / "no", "--figure", "5.2"), "4.4 actuators"),
        (("--figure", "4.4"), "Add --out DIR"),
    ):
        done = asked(*words)
        assert (done.returncode, done.stdout) == (2, "")
        assert said in done.stderr
    assert not (tmp_path / "no").exists()


VERBS = (
    *("trajectory", "view", "ik", "fk", "workspace", "place", "accuracy"),
    *("info", "urdf", "audit"),
)


@pytest.mark.parametrize("verb", VERBS)
def test_help_of_every_verb_has_an_example_that_names_it(pollard_pin, verb):
    done = pollard_pin(verb, "--help")
    assert done.returncode == 0
    assert f"Example: pollard-pin {verb}" in done.stdout


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from pollard_pin.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "heavy = {'numpy', 'pinocchio', 'scipy', 'matplotlib', 'pydantic', 'rich', 'yaml'}\n"
        "sys.stderr.write(' '.join(sorted(heavy & set(sys.modules))))"
    )
    done = process(code=code)
    assert "Pollard" in done.stdout
    assert done.stderr == ""


def test_a_short_report_needs_neither_scipy_nor_matplotlib():
    code = (
        "import sys; from pollard_pin.cli import main\n"
        "main(['trajectory', '--samples', '11', '--json', '-'])\n"
        "sys.stderr.write(' '.join(sorted({'scipy', 'matplotlib'} & set(sys.modules))))"
    )
    done = process(code=code)
    assert json.loads(done.stdout)["schema"] == "pollard-pin/trajectory-report"
    assert done.stderr == ""


def test_inverse_and_forward_kinematics_return_to_the_pose(pollard_pin):
    done = pollard_pin("ik", "--json", "-", "--", 0.45, 0.03, 0.05, 5, 10, -20)
    document = json.loads(done.stdout)
    assert len(document["branches"]) == 16
    best = next(one for one in document["branches"] if one["branch"] == "-++-+++")
    motors = np.degrees(best["angles"])[[0, 6, 9, 3, 4, 5]]
    modes = json.loads(pollard_pin("fk", "--json", "-", "--", *motors).stdout)["modes"]
    poses = np.array([mode["pose"] for mode in modes])
    gaps = np.abs(poses - document["pose"]).max(axis=1)
    assert gaps.min() < 1e-9
    assert modes[int(gaps.argmin())]["branch"] == "-++-+++"


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("ik", "0.45", "0", "0.05", "0", "10", "0"), "16 of 16 branches are valid"),
        (("ik", "0.45", "0", "0.05", "0", "10", "0", "--branch=-++-+++"), "1 of 1 branches"),
        (("fk", "-35", "-40", "40", "0", "20", "0"), "2 assembly modes"),
        (("info",), "6 by counting, 6 by rank"),
        (("workspace", "--points", "15"), "reachable share"),
        (("accuracy", "--samples", "31", "--within", "1mm"), "What moves it most: motor.chain"),
        (("accuracy", "--workspace", "--points", "9"), "in the median"),
    ],
)
def test_tables_fit_a_terminal_and_say_what_matters(pollard_pin, arguments, says):
    done = pollard_pin(*arguments)
    assert done.returncode == 0, done.stderr
    assert says in " ".join(done.stdout.split())
    assert "…" not in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_urdf_writes_the_four_files_and_thesis_pin_check_accepts_them(pollard_pin, tmp_path, capfd):
    done = pollard_pin("urdf", "--out", tmp_path)
    assert done.returncode == 0
    names = ("pollard.urdf", "pollard_printed.urdf", "pollard.closures.yaml", "pollard.mjcf.xml")
    assert {file.name for file in tmp_path.iterdir()} == {*names, "manifest.sha256"}
    capfd.readouterr()
    assert thesis_pin(["check", str(tmp_path / names[0]), str(tmp_path / names[2])]) == 0
    assert "6 by rank" in capfd.readouterr().out


def test_check_names_the_command_that_has_it_now(pollard_pin):
    done = pollard_pin("check", DATA / "five_bar.urdf", DATA / "five_bar.yaml", "--json", "-")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "pollard-pin: error: check has moved; use: thesis-pin check URDF CLOSURES\n"
    )


def test_workspace_writes_data_and_picture(pollard_pin, tmp_path):
    done = pollard_pin("workspace", "--points", "21", "--out", tmp_path, "--y", "-0.2", "0.2")
    assert done.returncode == 0, done.stderr
    assert {file.name for file in tmp_path.iterdir()} == {
        "manifest.sha256",
        "workspace.csv",
        "workspace.json",
        "workspace.png",
        "workspace.svg",
    }
    assert len((tmp_path / "workspace.csv").read_text().splitlines()) == 21**3 + 1


def test_the_example_path_is_a_closed_one_and_balances_its_energy(pollard_pin):
    done = pollard_pin("trajectory", "--path", ROOT / "examples" / "spray_arch.toml", "--json", "-")
    document = json.loads(done.stdout)
    np.testing.assert_allclose(document["pose"][0], document["pose"][-1], atol=1e-12)
    energy = document["summary"]["energy"]
    assert abs(energy["net_work"]) < 1e-5 * energy["exchanged"]
    assert document["parameters"]["segments"][0]["path"] == "arc"


def test_flags_put_a_path_where_its_file_could_have_put_it(pollard_pin, tmp_path):
    """Half a turn about the vertical, a mirror image and a move, written by hand."""
    from scipy.spatial.transform import Rotation

    text = "format = 1\n[start]\nposition = [{}, {}, 0.05]\norientation_deg = [{}, {}, {}]\n"
    text += '[[segments]]\nkind = "line"\nposition = [{}, {}, 0.15]\nduration = 2.0\n'
    here, there = tmp_path / "here.toml", tmp_path / "there.toml"
    here.write_text(text.format(0.42, -0.1, 5, 10, 15, 0.48, 0.1))
    turn = Rotation.from_euler("z", 30, degrees=True).as_matrix()
    image = np.diag([1.0, -1.0, 1.0])
    before = Rotation.from_euler("XYZ", [10, 5, 15], degrees=True).as_matrix()  # θ, ψ, φ
    theta, psi, phi = Rotation.from_matrix(turn @ image @ before @ image).as_euler("XYZ", True)
    middle = np.array([0.45, 0.0, 0.1])
    ends = [middle + turn @ image @ (end - middle) for end in ([0.42, -0.1, 0.05], [0.48, 0.1, 0])]
    (x, y, _), (end_x, end_y, _) = np.add(ends, [0.02, 0.01, 0.0])
    there.write_text(text.format(x, y, psi, theta, phi, end_x, end_y))
    asked = ("--turn", "30", "--mirror", "--placement", "0.02", "0.01", "0")
    found, wanted = (
        json.loads(pollard_pin("trajectory", "--path", *words, "--json", "-").stdout)
        for words in ((here, *asked), (there,))
    )
    for name in ("pose", "theta", "torque"):
        np.testing.assert_allclose(found[name], wanted[name], atol=1e-9)
    assert found["parameters"]["placed"][0]["mirrored"] is True


def test_view_and_report_are_written_as_pages(pollard_pin, tmp_path):
    path = ROOT / "examples" / "spray_arch.toml"
    done = pollard_pin("view", "--path", path, "--html", tmp_path / "view.html")
    assert (done.returncode, done.stdout) == (0, "")
    done = pollard_pin("trajectory", "--samples", "201", "--html", tmp_path / "report.html")
    assert done.returncode == 0
    assert "determinant of constant sign" in " ".join(done.stdout.split())
    for name in ("view.html", "report.html"):
        assert (tmp_path / name).read_bytes().startswith(b"<!doctype html>")
    done = pollard_pin("view", "--no-browser", "--port", "0", "--hold", "0.1")
    assert done.returncode == 0
    assert "at http://127.0.0.1:" in done.stderr


def test_everything_runs_on_the_second_specification(pollard_pin, tmp_path):
    other = ROOT / "pollard_pin" / "specifications" / "skewed.toml"
    for arguments in (
        ("trajectory", "--samples", "101", "--html", tmp_path / "report.html"),
        ("view", "--html", tmp_path / "view.html"),
        ("ik", "0.47", "0", "0.05", "0", "10", "0"),
        ("info",),
        ("urdf", "--out", tmp_path),
        ("workspace", "--points", "9"),
    ):
        done = pollard_pin(*arguments, "--specification", other)
        assert done.returncode == 0, done.stderr


def test_strict_fails_only_if_a_motor_exceeds_a_limit(pollard_pin, tmp_path):
    weak = tmp_path / "weak.toml"
    from pollard_pin.specification import POLLARD_PATH

    text = POLLARD_PATH.read_text(encoding="utf-8")
    weak.write_text(text.replace("effort = 10.0 ", "effort = 1.0 "), encoding="utf-8")
    arguments = ("trajectory", "--samples", "51", "--strict")
    assert pollard_pin(*arguments).returncode == 0
    done = pollard_pin(*arguments, "--specification", weak)
    assert done.returncode == 1
    assert "The motors can't do this: θ21 needs" in " ".join(done.stdout.split())
    assert pollard_pin(*arguments[:-1], "--specification", weak).returncode == 0


def test_angles_of_another_order_and_a_feed_are_taken_and_told(pollard_pin, tmp_path):
    path = tmp_path / "cam.csv"
    path.write_text(
        "x_mm;y_mm;z_mm;a_deg;b_deg;c_deg\n400;-50;100;0;5,5;0\n420;0;110;0;0;0\n400;50;100;0;0;9\n"
    )
    done = pollard_pin(
        "trajectory", "--path", path, "--euler", "ZYX", "--feed", "0.05", "--samples", "51"
    )
    assert (done.returncode, done.stderr) == (0, "")
    told = " ".join(done.stdout.split())
    assert "Note: a, b, c are read as Rz(a) Ry(b) Rx(c)." in told
    assert "tool speed of 50 mm/s" in told
