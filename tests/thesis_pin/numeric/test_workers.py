"""Work that several processes share: all of it is done, and none of them outlives the caller."""

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import closing
from functools import partial
from importlib import import_module
from pathlib import Path

import pytest

from thesis_pin.errors import BadInput
from thesis_pin.numeric import workers
from thesis_pin.numeric.workers import shared

ROOT = Path(__file__).parents[3]
NOTHING = partial(int)

PROCESS, ENDLESS = "__import__('os').getpid()", "__import__('time').sleep(600)"

SCRIPT = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
from thesis_pin.numeric.workers import shared
if __name__ == "__main__":
    for one in shared(eval, [{PROCESS!r}, {ENDLESS!r}, {ENDLESS!r}], 2, int):
        print(one, flush=True)
"""

MEETING = """
import os, time
def meet(folder):
    open(os.path.join(folder, str(os.getpid())), "w").close()
    end = time.monotonic() + 60
    while len(os.listdir(folder)) < 2 and time.monotonic() < end:
        time.sleep(0.01)
    return os.getpid()
"""


def alive(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    return True


def gone(processes, seconds=20.0):
    """Whether processes end soon."""
    end = time.monotonic() + seconds
    while any(map(alive, processes)) and time.monotonic() < end:
        time.sleep(0.05)
    return not any(map(alive, processes))


def test_every_task_is_done_once_and_two_processes_work_at_once(tmp_path, monkeypatch):
    assert sorted(shared(int, [str(k) for k in range(40)], 2, NOTHING)) == list(range(40))
    (tmp_path / "meeting.py").write_text(MEETING)
    (tmp_path / "folder").mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    processes = set(shared(import_module("meeting").meet, [tmp_path / "folder"] * 4, 2, NOTHING))
    assert len(processes) == 2
    assert os.getpid() not in processes
    assert gone(processes)


def test_each_process_begins_before_its_first_task():
    begin = partial(exec, "import builtins; builtins.begun = 'begun'")
    assert set(shared(eval, ["__import__('builtins').begun"] * 4, 2, begin)) == {"begun"}


def test_an_error_in_a_task_arrives_with_its_words_and_ends_the_others():
    bad = "exec('from thesis_pin.errors import UnknownName; raise UnknownName(\"leg\", 1, [])')"
    with pytest.raises(BadInput, match="unknown leg"):
        list(shared(eval, [ENDLESS, bad], 2, NOTHING))


def test_a_caller_that_stops_early_leaves_no_process():
    with closing(shared(eval, [PROCESS, ENDLESS, ENDLESS], 2, NOTHING)) as results:
        process = next(results)
        assert alive(process)
    assert gone([process])


def test_a_process_that_is_killed_is_said():
    with pytest.raises(BadInput, match=r"killed.*Use fewer"):
        list(shared(eval, [f"__import__('os').kill({PROCESS}, 9)"], 1, NOTHING))


def children(process):
    """Processes that another one has begun, as far as the system tells."""
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process)], capture_output=True)
    return {int(word) for word in listed.stdout.split()}


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_whatever_ends_the_caller_ends_its_processes(number, tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    words = [sys.executable, tmp_path / "script.py"]
    caller = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    with caller, caller.stdout, caller.stderr:
        process = int(caller.stdout.readline())
        processes = children(caller.pid)
        assert process in processes
        caller.send_signal(number)
        assert gone(processes)
        assert caller.wait(20) != 0


def test_ctrl_c_that_another_thread_takes_waits_until_all_processes_are_begun():
    """Such as a thread of OpenBLAS, which was there before the signal was blocked."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    rest, begun = threading.Event(), []
    other = threading.Thread(target=rest.wait)
    other.start()

    def begin():
        with workers.ctrl_c_later():
            signal.pthread_kill(other.ident, signal.SIGINT)
            time.sleep(0.05)
            begun.append(True)

    try:
        with pytest.raises(KeyboardInterrupt):
            begin()
        assert begun
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    finally:
        signal.signal(signal.SIGINT, before)
        rest.set()
        other.join()
