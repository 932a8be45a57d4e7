"""Processes that share designs: the same rows however many, also where some are killed."""

import contextlib
import os
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest
from studied import BASE, Bowl

from thesis_pin.errors import ModelWarning
from thesis_pin.sweep.designs.making import combined, vary
from thesis_pin.sweep.running.runner import chunks, sweep_designs
from thesis_pin.sweep.running.work import Task, work

TESTS = Path(__file__).parents[3]


def designs(*texts):
    return combined([vary(BASE, text) for text in texts or ("x=0:2:9", "legs.*.length=0.1,0.2")])


def here(study, made):
    """The rows worked out in this process, one after the other."""
    return [row for task in chunks(made) for row in work(study, made, task).rows]


def test_rows_are_the_same_bits_for_any_number_of_processes():
    study = Bowl({0.5: "warn", 1.0: "refuse", 1.25: "break"})
    expected = here(study, designs())
    for jobs in (1, 2, 3):
        assert list(sweep_designs(study, designs(), jobs=jobs).rows) == expected


def test_what_is_wrong_with_a_design_is_its_row():
    study = Bowl({0.5: "warn", 1.0: "refuse", 1.5: "break"})
    with warnings.catch_warnings():
        warnings.simplefilter("error", ModelWarning)  # it is the row's, not ours
        rows = here(study, designs("x=0,0.5,1,1.5"))
    assert [row.status for row in rows] == ["done", "done", "impossible", "failed"]
    assert [row.warnings for row in rows] == ["", "it leaks", "", ""]
    assert rows[2].reason == "x = 1 is no bowl. Take another"
    assert rows[3].reason == "ZeroDivisionError: a slip"
    assert rows[2].cells == (None,) * 4
    assert rows[0].cells == (True, 1 / 3 + 0.09, 0.0, "blue, 0")


@pytest.mark.parametrize("odd", [float("nan"), float("inf"), -float("inf"), np.float64("nan")])
def test_what_is_no_finite_number_is_a_cell_without_one(odd):
    class Odd(Bowl):
        def judge(self, data):
            return {"good": np.True_, "depth": odd, "width": np.float64(-0.0), "colour": "blue"}

    (row,) = here(Odd(), designs("x=1"))
    assert row.cells == (True, None, 0.0, "blue")
    assert type(row.cells[0]) is bool
    assert str(row.cells[2]) == "0.0"


def test_a_process_that_is_killed_once_costs_nothing_but_time(tmp_path):
    study = Bowl({0.75: "die once", 1.5: "die once"}, str(tmp_path))
    found = sweep_designs(study, designs(), jobs=2)
    assert list(found.rows) == here(Bowl(), designs())
    assert (tmp_path / "dead-0.75").exists()


def test_a_design_that_kills_its_process_twice_is_a_row_that_says_so(tmp_path):
    study = Bowl({0.75: "die"}, str(tmp_path))
    made = designs("x=0:2:9")
    rows = sweep_designs(study, made, jobs=2).rows
    expected = here(Bowl(), made)
    assert [row for row in rows if row.design != 3] == [row for row in expected if row.design != 3]
    assert rows[3].status == "lost"
    assert "was ended by SIGKILL" in rows[3].reason
    assert "twice" in rows[3].reason


def test_the_others_of_a_chunk_that_dies_are_judged_alone(tmp_path):
    study, made = Bowl({0.75: "die"}, str(tmp_path)), designs("x=0:2:9")
    from thesis_pin.sweep.running.pool import shared

    whole = Task(0, tuple(range(9)), made.values)
    found = [row for _, done in shared(study, made, [whole], 1) for row in done.rows]
    assert sorted(row.design for row in found) == list(range(9))
    assert {row.design: row.status for row in found if row.status != "done"} == {3: "lost"}


def test_memory_is_a_process_own_and_not_that_of_who_began_it():
    script = (
        "import subprocess, sys; large = bytearray(400_000_000); sys.exit(subprocess.call("
        "[sys.executable, '-c', 'from thesis_pin.sweep.running.work import peak_memory as p;"
        " print(p())']))"
    )
    said = subprocess.check_output([sys.executable, "-c", script], text=True)
    assert 10e6 < float(said) < 300e6


def test_chunks_depend_on_the_number_of_designs_alone_and_cover_each_once():
    for count in (1, 9, 200, 201, 2000, 40_000, 300_000):
        made = designs(f"x=0:1:{count}") if count > 1 else designs("x=1")
        tasks = chunks(made)
        covered = [design for task in tasks for design in task.designs]
        assert covered == list(range(count))
        assert [task.number for task in tasks] == list(range(len(tasks)))
        assert len(tasks) <= 6000
        assert max(len(task.designs) for task in tasks) <= max(50, count // 5000 + 1)


SLOW = """
import sys
sys.path[:0] = {path!r}
from studied import Bowl
from test_pool import designs
from thesis_pin.sweep.running.runner import sweep_designs
if __name__ == "__main__":
    study = Bowl({{x / 8: "sleep" for x in range(17)}}, {folder!r})
    sweep_designs(study, designs(), jobs=2, out={out!r})
"""


def begun(tmp_path):
    """A sweep in a process of its own that has written some rows and judges others."""
    (tmp_path / "pids").mkdir()
    script = tmp_path / "slow.py"
    path = [str(TESTS), str(Path(__file__).parent)]
    out = str(tmp_path / "out")
    script.write_text(SLOW.format(path=path, folder=str(tmp_path / "pids"), out=out))
    process = subprocess.Popen([sys.executable, script], stderr=subprocess.PIPE, text=True)
    until = time.monotonic() + 120
    while len(list((tmp_path / "out").glob("rows/*.parquet"))) < 3:
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < until
        time.sleep(0.02)
    return process


def workers(tmp_path):
    return [int(path.name.split("-")[1]) for path in (tmp_path / "pids").iterdir()]


def alive(pid):
    """Whether a process lives; one that is dead and not yet waited for doesn't."""
    with contextlib.suppress(OSError):
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
        return state != "Z"
    with contextlib.suppress(OSError):
        os.kill(pid, 0)
        return not Path("/proc/self").exists()
    return False


def gone(pids):
    until = time.monotonic() + 60
    while any(map(alive, pids)):
        if time.monotonic() > until:
            return False
        time.sleep(0.02)
    return True


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_sweep_that_is_ended_leaves_no_process_and_goes_on_to_the_same_rows(how, tmp_path):
    process = begun(tmp_path)
    process.send_signal(how)
    process.wait(60)
    process.stderr.close()
    assert workers(tmp_path)
    assert gone(workers(tmp_path))
    parts = set((tmp_path / "out" / "rows").iterdir())
    assert 3 <= len(parts) < 18
    written = {part: part.read_bytes() for part in parts}

    study = Bowl({x / 8: "sleep" for x in range(17)}, str(tmp_path / "pids"))
    found = sweep_designs(study, designs(), jobs=2, out=tmp_path / "out", resume=True)
    assert list(found.rows) == here(Bowl(), designs())
    assert found.effort.judged == 18 - len(parts)
    assert {part: part.read_bytes() for part in parts} == written


def test_a_worker_that_somebody_kills_doesnt_change_a_row(tmp_path):
    process = begun(tmp_path)
    os.kill(workers(tmp_path)[0], signal.SIGKILL)
    assert process.wait(120) == 0, process.communicate()[1]
    process.stderr.close()
    found = sweep_designs(
        Bowl({x / 8: "sleep" for x in range(17)}, str(tmp_path / "pids")),
        designs(),
        out=tmp_path / "out",
        resume=True,
    )
    assert found.effort.judged == 0
    assert list(found.rows) == here(Bowl(), designs())
