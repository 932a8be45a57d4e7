"""Progress bars: on a terminal's standard error only, and gone at the end."""

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

import pollard_pin
import scout_pin
from thesis_pin.command.progress import Bar, track

ROOT = Path(__file__).parents[3]


def on_a_terminal(module, *words, patience=0.0):
    """Standard error of a command whose standard error is a terminal; and its output.

    Bars are shown after ``patience`` [s], so that no test depends on how fast a machine is.
    """
    code = (
        f"import sys; from thesis_pin.command import progress; progress.PATIENCE = {patience}\n"
        f"from {module} import main; sys.exit(main())"
    )
    master, slave = pty.openpty()
    environment = os.environ | {"PYTHONPATH": str(ROOT), "TERM": "xterm", "COLUMNS": "80"}
    process = subprocess.Popen(
        [sys.executable, "-c", code, *words], stdout=subprocess.PIPE, stderr=slave, env=environment
    )
    os.close(slave)
    said = b""
    try:
        while part := os.read(master, 4096):
            said += part
    except OSError:  # Linux says the other end has closed in this way
        pass
    out, _ = process.communicate()
    os.close(master)
    return process.returncode, said.decode(), out.decode()


FIVE_BAR = [
    str(ROOT / "tests/thesis_pin/loops/data" / f"five_bar.{kind}") for kind in ("urdf", "yaml")
]
RUNS = {
    "gait": ("scout_pin.cli", ["gait"], "working out the gait"),
    "ik": ("scout_pin.cli", ["ik", "left", "--position", "-0.04", "-0.02", "-0.2"], "working"),
    "trajectory": ("pollard_pin.cli", ["trajectory"], "working out the trajectory"),
    "workspace": ("pollard_pin.cli", ["workspace", "--points", "9"], "mapping the workspace"),
    "audit": ("scout_pin.cli", ["audit", "--equation", "4.3.3:dot_e_9i"], "auditing"),
    "view": ("scout_pin.cli", ["view", "--html", "{folder}/page.html"], "working out the motion"),
    "check": ("thesis_pin.command.main", ["check", *FIVE_BAR], "checking"),
}


@pytest.mark.parametrize("name", RUNS)
def test_a_run_that_takes_longer_shows_a_bar_on_a_terminal_and_takes_it_away(name, tmp_path):
    module, words, says = RUNS[name]
    code, said, out = on_a_terminal(module, *(word.format(folder=tmp_path) for word in words))
    assert code == 0
    assert says in said
    assert "\x1b[2K" in said[said.rindex(says) :]  # the line is erased
    assert says not in out


def test_a_run_that_ends_before_anybody_grows_impatient_shows_none():
    assert on_a_terminal("scout_pin.cli", "gait", patience=1e6)[1] == ""


def test_a_bar_that_is_shown_late_knows_what_was_done_before(monkeypatch, capsys):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    with Bar("counting", after=1e6) as bar:
        bar(3, 7)
        bar._show()
        task = bar._bar.tasks[0]
        assert (task.completed, task.total) == (3, 7)
        bar(5, 7)
        assert task.completed == 5
    bar._show()  # the timer's last moment: too late
    assert not bar._bar.live.is_started


def test_without_a_terminal_nothing_is_said_and_rich_is_not_needed(capsys):
    with Bar("counting") as bar:
        bar(1, 2)
    assert list(track("abc", "letters", 3)) == ["a", "b", "c"]
    assert capsys.readouterr() == ("", "")


def test_reports_tell_their_progress_from_the_first_step_to_the_last():
    seen = []
    gait = scout_pin.load_gait()
    scout_pin.gait_report(
        scout_pin.load(), gait, samples=5, progress=lambda *step: seen.append(step)
    )
    assert seen == [(k, 4) for k in (1, 2, 3, 4)]
    seen.clear()
    pollard_pin.trajectory_report(
        pollard_pin.load(),
        pollard_pin.appendix_b(),
        samples=5,
        progress=lambda *step: seen.append(step),
    )
    assert seen == [(k, 4) for k in (1, 2, 3, 4)]
