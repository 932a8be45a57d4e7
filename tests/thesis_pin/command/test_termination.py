"""A command that is told to end leaves nothing behind."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from thesis_pin.command.termination import SIGNALS, tidy_end

ROOT = Path(__file__).parents[3]


HOLDS_MESHES = """
import sys, time
import scout_pin
from thesis_pin.command.termination import tidy_end

with tidy_end():
    robot = scout_pin.load()
    robot.visual_model  # Pinocchio reads meshes from files
    print("ready", flush=True)
    time.sleep(300)
"""


@pytest.mark.parametrize("number", SIGNALS)
def test_a_robot_whose_command_a_signal_ends_leaves_no_temporary_folder(tmp_path, number):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDS_MESHES],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
        env=os.environ | {"TMPDIR": str(tmp_path)},
    )
    try:
        ready = process.stdout.readline()
        during = list(tmp_path.iterdir())
        process.send_signal(number)
        _, rest = process.communicate(timeout=60)
    finally:
        process.kill()
    assert ready == "ready\n"
    assert during, "the folder that has to go was never there"
    assert process.returncode == 128 + number
    assert "Traceback" not in rest
    assert list(tmp_path.iterdir()) == []


def test_what_is_open_is_closed_and_the_signals_are_as_before():
    closed = []

    @tidy_end()
    def verb():
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            closed.append(True)

    with pytest.raises(SystemExit) as ended:
        verb()
    assert (ended.value.code, closed) == (143, [True])
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_ignored_signals_stay_ignored_as_nohup_wants():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with tidy_end():
            signal.raise_signal(signal.SIGHUP)
            assert signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_command_run_in_a_thread_leaves_signals_alone():
    seen = []

    @tidy_end()
    def verb():
        seen.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=verb)
    thread.start()
    thread.join()
    assert seen == [signal.SIG_DFL]
