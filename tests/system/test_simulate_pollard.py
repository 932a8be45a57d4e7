"""`pollard-pin simulate`: exit codes, files, what it says without MuJoCo."""

import json
import os
import subprocess
import sys

import pytest
from commands import ROOT, run

pytest.importorskip("mujoco", reason="MuJoCo isn't installed: pip install 'thesis-pin[simulate]'")

ARCH = ("--path", str(ROOT / "examples" / "spray_arch.toml"))
HELD = ("--stiffness", "30", "30", "30", "0.3", "0.3", "0.01", "--time-step", "0.001")


def test_a_path_that_is_kept_passes_with_every_file(tmp_path, capfd):
    words = [*ARCH, *HELD, "--out", str(tmp_path / "out"), "--html", str(tmp_path / "page.html")]
    code, out, err = run("pollard-pin simulate", ["simulate", *words], capfd)
    assert code == 0, err
    assert "PASS: the simulated robot does what its plan says." in out
    names = {"report.json", "samples.csv", "torques.png", "deviation.svg", "manifest.sha256"}
    assert names <= {path.name for path in (tmp_path / "out").iterdir()}
    assert (tmp_path / "page.html").stat().st_size < 3e6


def test_an_open_loop_fails_with_1_and_the_reason(capfd):
    code, out, err = run("pollard-pin simulate", ["simulate", "--json", "-"], capfd)
    assert (code, err) == (1, "")
    document = json.loads(out)
    assert document["summary"]["passed"] is False
    assert "by a factor of e each 0.140 s" in document["summary"]["reason"]


def test_open_loop_may_be_said(capfd):
    words = ["simulate", *ARCH, "--open-loop", "--time-step", "0.001"]
    code, out, _ = run("pollard-pin simulate", words, capfd)
    assert code == 1
    assert "open loop" in out


def test_without_mujoco_one_error_says_what_to_install_and_pinocchio_serves(tmp_path):
    (tmp_path / "mujoco.py").write_text("raise ImportError('not here')\n")
    settings = os.environ | {"PYTHONPATH": os.pathsep.join((str(tmp_path), str(ROOT)))}
    code = "import sys; from pollard_pin.cli import main; sys.exit(main())"

    def command(*words):
        return subprocess.run(
            [sys.executable, "-c", code, "simulate", *words],
            env=settings,
            capture_output=True,
            text=True,
            check=False,
            cwd=tmp_path,
        )

    done = command()
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    assert "pip install 'thesis-pin[simulate]'" in done.stderr
    done = command("--engine", "pinocchio", "--duration", "60", "--time-step", "0.004")
    assert (done.returncode, done.stderr) == (1, "")
