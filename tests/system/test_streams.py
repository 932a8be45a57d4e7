"""Commands on the streams, terminals and names that there are: no traceback, the promised code."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from commands import run

ROOT = Path(__file__).parents[2]
IK = {
    "scout": ["ik", "left", "--position", "-0.0445", "-0.02", "-0.22"],
    "pollard": ["ik", "0.45", "0", "0.1", "0", "0", "0"],
}
ANSWERS = {}
EVERY = [(robot, words) for robot in IK for words in (["info"], IK[robot])]


def words_of(robot, *words):
    code = f"import sys; from {robot}_pin.cli import main; sys.exit(main())"
    return [sys.executable, "-c", code, *words]


def command(robot, *words, environment=None, **options):
    settings = os.environ | {"PYTHONPATH": str(ROOT)} | (environment or {})
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | options
    done = subprocess.run(
        words_of(robot, *words), env=settings, check=False, timeout=120, **options
    )
    assert b"Traceback" not in done.stderr, done.stderr.decode()
    assert b"bug:" not in done.stderr, done.stderr.decode()
    return done


@pytest.fixture
def answer(capfd, monkeypatch):
    """What a command says on standard output, called in this process; some compare with it."""

    def said(robot, words, columns):
        if (robot, *words, columns) not in ANSWERS:
            monkeypatch.setenv("COLUMNS", columns)
            code, out, err = run(f"{robot}-pin", words, capfd)
            assert (code, err) == (0, "")
            ANSWERS[robot, *words, columns] = out
        return ANSWERS[robot, *words, columns]

    return said


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "cp437"])
@pytest.mark.parametrize(("robot", "words"), EVERY)
def test_every_encoding_gets_a_readable_answer(robot, words, encoding, answer):
    environment = {"PYTHONIOENCODING": encoding, "COLUMNS": "80"}
    done = command(robot, *words, environment=environment)
    assert (done.returncode, done.stderr) == (0, b"")
    text = done.stdout.decode(encoding)
    assert not re.search(r"\\u|\\x|\?", text)
    plain = answer(robot, words, "80")
    numbers = [re.findall(r"\d+\.\d+", one) for one in (text, plain)]
    assert numbers[0] == numbers[1]
    assert len(numbers[0]) > 10


@pytest.mark.parametrize("width", ["20", "40"])
@pytest.mark.parametrize(("robot", "words"), EVERY)
def test_no_number_is_cut_below_80_columns(robot, words, width, answer):
    wide, narrow = (answer(robot, words, columns) for columns in ("200", width))
    decimals = r"-?\d+\.\d+"
    assert sorted(re.findall(decimals, narrow)) == sorted(re.findall(decimals, wide))
    assert "…" not in narrow


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("words", [["info"], ["info", "--json", "-"], ["urdf"], ["--help"]])
def test_a_full_standard_output_is_said_and_ends_with_3(words, unbuffered):
    with open("/dev/full", "wb") as full:
        environment = {"PYTHONUNBUFFERED": unbuffered}
        done = command("scout", *words, stdout=full, environment=environment)
    assert done.returncode == 3
    assert done.stderr.startswith(b"scout-pin: error: ")
    assert done.stderr.endswith(b"No space left on device\n")


@pytest.mark.parametrize("words", [["info"], ["info", "--json", "-"], ["urdf"]])
def test_a_closed_standard_output_is_said_and_ends_with_3(words):
    shell = ["sh", "-c", '"$@" >&-', "sh", *words_of("scout", *words)]
    done = subprocess.run(
        shell,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 3, done.stderr
    assert "standard output is closed" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_closed_standard_output_is_not_mistaken_for_a_file_that_is_written(tmp_path):
    shell = ["sh", "-c", '"$@" >&-', "sh", *words_of("scout", "info", "--json", tmp_path / "a")]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    subprocess.run(shell, env=environment, check=False, capture_output=True)
    assert json.loads((tmp_path / "a").read_bytes())["mass"] == pytest.approx(0.89854)


@pytest.mark.parametrize("words", [["info"], ["urdf"], ["--help"], ["info", "--json", "-"]])
def test_a_reader_that_leaves_ends_the_command_quietly(words):
    reading, writing = os.pipe()
    os.close(reading)  # as head does, only sooner
    with os.fdopen(writing, "wb", closefd=True) as pipe:
        done = command("scout", *words, stdout=pipe)
    assert (done.returncode, done.stderr) == (0, b"")


def test_names_that_are_no_text_are_taken_and_said(tmp_path):
    feet = ("left_foot_x", "left_foot_y", "right_foot_x", "right_foot_y")
    header = ",".join(["t", "support", *feet, "torso_z"])
    rows = [f"{t},double,-0.0445,-0.02,0.0445,-0.02,0.22" for t in (0, 0.5, 1, 1.5)]
    name = os.fsdecode(b"gait_\xff.csv")
    (tmp_path / name).write_text("\n".join([header, *rows]))
    done = command("scout", "gait", "--gait", name, "--samples", "5", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert re.search(r"gait_\\+xff", done.stdout.decode())
    done = command("scout", "gait", "--gait", name.replace("gait", "none"), cwd=tmp_path)
    assert done.stderr.startswith(b"scout-pin: error: none_\\udcff.csv: ")
    path = os.fsdecode(b"path_\xff.csv")
    poses = [f"{t},{0.45 + t / 100},0,0.1,0,0,0" for t in range(5)]
    (tmp_path / path).write_text("\n".join(poses))
    out, page = os.fsdecode(b"out_\xff"), os.fsdecode(b"page_\xff.html")
    words = ["trajectory", "--path", path, "--samples", "5", "--out", out, "--html", page]
    done = command("pollard", *words, "--json", "-", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)
    assert (tmp_path / out / "report.json").exists()
    assert "path_\\xff.csv" in (tmp_path / page).read_text(encoding="utf-8")
    done = command("scout", "urdf", "--out", out, cwd=tmp_path)
    assert done.returncode == 0
    assert b"out_\\" in done.stderr


@pytest.mark.parametrize(
    "words", [["info", "--json", "n" * 300], ["urdf", "--out", "n" * 300]], ids=["file", "folder"]
)
def test_a_name_too_long_for_the_file_system_is_called_that(words, tmp_path):
    done = command("scout", *words, cwd=tmp_path)
    assert done.returncode == 3
    assert b"the name is too long for the file system" in done.stderr
    assert done.stdout == b""


def test_of_two_commands_into_one_folder_the_second_ends_before_its_work(tmp_path):
    code = (
        "import sys\nfrom thesis_pin.files import Claim\n"
        f"with Claim({str(tmp_path / 'out')!r}):\n    print(1, flush=True)\n    sys.stdin.read()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    ) as first:
        first.stdout.readline()
        # The gait doesn't exist: had the work begun, the code would be 2.
        words = ["gait", "--gait", "missing.toml", "--out", tmp_path / "out"]
        done = command("scout", *map(str, words))
        assert done.returncode == 3
        assert b"another run is writing to this folder" in done.stderr
        first.stdin.close()
    assert os.listdir(tmp_path) == []
