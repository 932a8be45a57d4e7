"""``view --film`` and ``--picture``: what is written, what is refused, Ctrl-C."""

import contextlib
import io
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import chromium
import numpy as np
import pytest
from commands import MODULES, ROOT, run
from PIL import Image

DELTA = ("examples/delta.urdf", "examples/delta.yaml", "examples/delta_pick.csv")
MOTIONS = {"scout-pin": (), "pollard-pin": (), "thesis-pin": (*DELTA, "--frame", "platform")}


@pytest.fixture
def needs_browser():
    """Skip without what films are made with."""
    pytest.importorskip("imageio_ffmpeg", reason="pip install 'thesis-pin[film]'")
    if chromium.find() is None:
        pytest.skip("no Chromium on this machine (Debian and Ubuntu: apt-get install chromium)")


@pytest.mark.browser
@pytest.mark.parametrize("command", MOTIONS)
def test_each_command_writes_a_film_a_picture_and_a_page(
    command, tmp_path, monkeypatch, capfd, needs_browser
):
    monkeypatch.chdir(ROOT)
    film, picture, page = (str(tmp_path / name) for name in ("a.gif", "a.png", "a.html"))
    words = ["view", *MOTIONS[command], "--film", film, "--fps", "1", "--size", "200x151"]
    words += ["--picture", picture, "--at", "0.5", "--html", page, "--json", "-"]
    words += ["--look", "front", "--speed", "2", "--hide", "all", "--show", "robot"]
    code, out, err = run(f"{command} view", words, capfd)
    assert code == 0, err
    said = json.loads(out)
    assert (said["film"], said["picture"], said["page"]) == (film, picture, page)
    assert said["address"] is None
    assert [f"wrote {name}" in err for name in (film, picture, page)] == [True] * 3
    gif = Image.open(io.BytesIO(Path(film).read_bytes()))
    assert gif.size == (200, 151)
    assert gif.n_frames == int(said["duration"] / 2) + 1
    drawn = np.asarray(Image.open(io.BytesIO(Path(picture).read_bytes())).convert("RGB")).astype(
        int
    )
    assert drawn.shape == (151, 200, 3)
    assert (np.abs(drawn[50:] - chromium.BACKGROUND).max(axis=-1) > 110).sum() > 100
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.gif", "a.html", "a.png"]


REFUSED = {
    "an ending": (["--film", "FILE.avi"], ".mp4, .webm or .gif"),
    "standard output": (["--film", "-"], ".mp4, .webm or .gif"),
    "a picture's ending": (["--picture", "FILE.jpg"], ".png"),
    "a moment": (
        ["--html", "FILE.html", "--picture", "FILE.png", "--at", "4.5"],
        "--at is 4.5; allowed: 0 to 4 seconds",
    ),
    "a moment of nothing": (["--html", "FILE.html", "--at", "1"], "--at belongs to --picture"),
    "a rate of nothing": (["--html", "FILE.html", "--fps", "10"], "--fps belongs to --film"),
    "a size of nothing": (["--html", "FILE.html", "--size", "640x480"], "--size belongs to"),
    "a unit": (["--film", "FILE.mp4", "--size", "160x90mm"], "whole pixels"),
    "half pixels": (["--film", "FILE.mp4", "--size", "160.5x90"], "whole pixels"),
    "a size too large": (["--film", "FILE.mp4", "--size", "9000x90"], "64 to 4096"),
    "a rate of a GIF": (["--film", "FILE.gif", "--fps", "60"], "at most 50"),
    "a group": (["--html", "FILE.html", "--show", "shadows"], "robot, soles, com, zmp"),
    "both": (["--html", "FILE.html", "--show", "zmp", "--hide", "com,zmp"], "shown and hidden"),
    "one place": (["--film", "FILE.gif", "--html", "FILE.gif"], "can't both be"),
    "a folder": (["--film", "no/such/FILE.gif"], "no folder"),
    "a port": (["--picture", "FILE.png", "--port", "0"], "--port means nothing"),
}


@pytest.mark.parametrize("wrong", REFUSED)
def test_what_can_t_be_filmed_is_one_message_and_no_file(wrong, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    words, reason = REFUSED[wrong]
    code, out, err = run("scout-pin view", ["view", *words], capfd)
    assert code == (3 if wrong == "a folder" else 2), err
    assert reason in err
    assert err.count("error: ") == 1
    assert (out, list(tmp_path.iterdir())) == ("", [])


def without(module, folder):
    """An environment in which a module can't be imported."""
    (folder / f"{module}.py").write_text(f"raise ImportError('no {module} here')")
    return {"PYTHONPATH": os.pathsep.join((str(folder), str(ROOT)))}


@pytest.mark.parametrize(
    ("module", "flag"), [("playwright", "--picture=a.png"), ("imageio_ffmpeg", "--film=a.mp4")]
)
def test_a_missing_extra_names_what_to_install(module, flag, tmp_path):
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    done = subprocess.run(
        [sys.executable, "-c", CALL.format(MODULES["scout-pin"]), "view", flag],
        cwd=tmp_path,
        env=os.environ | without(module, hidden),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "pip install 'thesis-pin[film]'" in done.stderr
    assert done.stderr.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["hidden"]


CALL = "import sys; from {} import main; sys.exit(main())"


def test_a_missing_browser_says_how_to_get_one(tmp_path):
    pytest.importorskip("playwright")
    done = subprocess.run(
        [sys.executable, "-c", CALL.format(MODULES["scout-pin"]), "view", "--picture=a.png"],
        cwd=tmp_path,
        env=os.environ
        | {
            "PATH": str(tmp_path),
            "PLAYWRIGHT_BROWSERS_PATH": str(tmp_path),
            "PYTHONPATH": str(ROOT),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2, done.stderr
    assert "need a Chromium, and none is here" in done.stderr
    assert "playwright install chromium" in done.stderr
    assert list(tmp_path.iterdir()) == []


def below(process):
    """Process numbers of everything that a process has started, its children's included."""
    found = []
    for task in Path(f"/proc/{process}/task").glob("*/children"):
        for child in map(int, told(task).split()):
            found += [child, *below(child)]
    return found


def told(entry):
    """What an entry of /proc says: nothing where its process has ended since it was listed."""
    try:
        return entry.read_bytes()
    except OSError:
        return b""


def running(process):
    """Whether a process is there and isn't a mere entry for its parent."""
    state = told(Path(f"/proc/{process}/stat")).rpartition(b")")[2].split()
    return bool(state) and state[0] != b"Z"


@pytest.fixture
def short():
    """A folder with a short name: Chromium makes a socket in the one for temporary files."""
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)


@pytest.fixture
def begin(short):
    """Start a command in a session of its own; a test that fails leaves none of it behind."""
    processes = []

    def start(words, **settings):
        processes.append(subprocess.Popen(words, start_new_session=True, **settings))
        return processes[-1]

    yield start
    for process in processes:
        with process, contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


@pytest.mark.browser
@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="reads /proc")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_leaves_no_file_and_no_process(number, needs_browser, short, begin):
    kept = short / "walk.mp4"
    kept.write_bytes(b"an older film")
    process = begin(
        [
            *(sys.executable, "-c", CALL.format(MODULES["scout-pin"]), "view"),
            *("--film", kept, "--fps", "120", "--size", "320x200"),
        ],
        env=os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(short)},
        stderr=subprocess.PIPE,
    )
    deadline = time.monotonic() + 120
    ffmpeg = []
    while not ffmpeg:  # it starts with the first frame
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < deadline
        time.sleep(0.05)
        started = below(process.pid)
        ffmpeg = [one for one in started if b"ffmpeg" in told(Path(f"/proc/{one}/cmdline"))]
    if number == signal.SIGINT:
        os.killpg(process.pid, number)  # as a terminal does
    else:
        process.send_signal(number)
    _, err = process.communicate(timeout=120)
    text = err.decode()
    assert process.returncode == (130 if number == signal.SIGINT else 128 + number), text
    assert text == ("scout-pin: interrupted\n" if number == signal.SIGINT else "")
    assert kept.read_bytes() == b"an older film"
    while any(map(running, started)):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert [path.name for path in short.iterdir()] == ["walk.mp4"]
