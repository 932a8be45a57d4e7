"""Where the verbs of any robot write: pipes, full devices, readers that leave, missing folders."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from commands import ROOT, run

DATA = Path(__file__).parents[1] / "thesis_pin" / "loops" / "data"
BAR = [str(DATA / f"five_bar.{end}") for end in ("urdf", "yaml")]
GRID = ("--frame", "left_tip", "--along", "x", "0", "0.2", "--along", "z", "0.3", "0.4")
FILES = {
    "workspace": ("--json", "--html"),
    "balance": ("--json", "--html"),
    "torque": ("--json", "--html"),
    "size": ("--json",),
    "view": ("--html",),
}
EVERY = [(verb, option) for verb, options in FILES.items() for option in options]


@pytest.fixture(scope="module")
def words(tmp_path_factory):
    """What each verb is asked: of a five-bar whose tip goes round, of a quadruped that stands."""
    folder = tmp_path_factory.mktemp("given")
    time = np.arange(0, 1.5, 0.05)
    path = np.column_stack([time, 0.1 + 0.05 * np.sin(time), 0.35 + 0.03 * np.cos(time)])
    np.savetxt(folder / "path.csv", path, delimiter=",", header="t,x,z", comments="")
    (folder / "servos.csv").write_text("name,torque_Nm,speed_rpm\nstrong,9,60\n")
    led = [*BAR, str(folder / "path.csv"), "--frame", "left_tip"]
    return {
        "workspace": [*BAR, *GRID, "--points", "3"],
        "balance": ["example:solo12"],
        "torque": led,
        "size": [*led, "--list", str(folder / "servos.csv")],
        "view": led,
    }


def thesis_pin(verb, words, capfd):
    return run(f"thesis-pin {verb}", [verb, *map(str, words)], capfd)


@pytest.mark.parametrize(("verb", "option"), EVERY)
def test_a_pipe_with_a_name_gets_what_a_file_gets(verb, option, words, tmp_path, capfd):
    pipe, got = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()))
    reader.start()
    code, _, err = thesis_pin(verb, [*words[verb], option, pipe], capfd)
    reader.join(timeout=60)
    assert (code, "wrote" in err) == (0, True)
    plain = tmp_path / "plain"
    thesis_pin(verb, [*words[verb], option, plain], capfd)
    assert got == [plain.read_bytes()]
    assert {path.name for path in tmp_path.iterdir()} == {"pipe", "plain"}


@pytest.mark.parametrize(("verb", "option"), EVERY)
@pytest.mark.parametrize("target", ["no folder", "a folder"])
def test_what_can_not_be_written_ends_with_3_and_no_answer(
    verb, option, target, words, tmp_path, capfd
):
    (tmp_path / "folder").mkdir()
    places = {"no folder": tmp_path / "no" / "x", "a folder": tmp_path}
    code, out, err = thesis_pin(verb, [*words[verb], option, places[target]], capfd)
    assert (code, out) == (3, "")
    assert err.startswith("thesis-pin: error: ")
    assert "can't write it" in err
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


@pytest.mark.parametrize("verb", ["workspace", "balance", "torque", "size"])
@pytest.mark.parametrize("where", ["file", "below a file"])
def test_a_folder_that_can_not_be_made_ends_with_3_and_no_answer(
    verb, where, words, tmp_path, capfd
):
    file = tmp_path / "file"
    file.write_text("kept")
    folder = file if where == "file" else file / "made"
    code, out, err = thesis_pin(verb, [*words[verb], "--out", folder], capfd)
    assert (code, out) == (3, "")
    assert "isn't a folder" in err
    assert file.read_text() == "kept"
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize(
    ("verb", "form"),
    [("workspace", ()), ("balance", ("--json", "-")), ("torque", ()), ("size", ("--json", "-"))],
)
def test_a_full_output_ends_with_3_and_a_reader_that_leaves_with_0(verb, form, words):
    code = "import sys; from thesis_pin.command.main import main; sys.exit(main())"
    command = [sys.executable, "-c", code, verb, *words[verb], *form]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    reading, writing = os.pipe()
    os.close(reading)
    with open("/dev/full", "wb") as full, os.fdopen(writing, "wb") as left:
        both = [
            subprocess.Popen(command, stdout=to, stderr=subprocess.PIPE, env=environment, text=True)
            for to in (full, left)
        ]
        said = [process.communicate(timeout=120)[1] for process in both]
    assert [process.returncode for process in both] == [3, 0]
    assert said[0].startswith("thesis-pin: error: ")
    assert said[0].endswith("No space left on device\n")
    assert said[1] == ""
