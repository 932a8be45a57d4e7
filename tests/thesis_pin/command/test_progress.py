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


def on_a_terminal(command, *words):
    """Standard error of a command whose standard error is a terminal; and its output."""
    code = f"import sys; from {command}.cli import main; sys.exit(main())"
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


LONG_RUNS = {
    "gait": ("scout_pin", ["gait", "--samples", "20000"], "working out the gait"),
    "trajectory": ("pollard_pin", ["trajectory", "--samples", "20000"], "working out the path"),
    "workspace": ("pollard_pin", ["workspace", "--points", "41"], "mapping the workspace"),
}


@pytest.mark.parametrize("name", LONG_RUNS)
def test_a_long_run_shows_a_bar_on_a_terminal_and_takes_it_away(name):
    command, words, says = LONG_RUNS[name]
    code, said, out = on_a_terminal(command, *words)
    assert code == 0
    assert says in said
    assert said.rstrip().endswith("\x1b[2K")  # the line is erased
    assert says not in out


def test_a_short_run_shows_none():
    assert on_a_terminal("scout_pin", "gait", "--samples", "401")[1] == ""


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
