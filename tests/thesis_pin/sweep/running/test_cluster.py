"""A real Dask scheduler with two workers on loopback: the same rows as everywhere."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from studied import BASE, Bowl

from thesis_pin.errors import BadInput
from thesis_pin.sweep.designs.making import combined, vary
from thesis_pin.sweep.running import cluster
from thesis_pin.sweep.running.runner import chunks, sweep_designs
from thesis_pin.sweep.running.work import work

ROOT = Path(__file__).parents[4]


def designs():
    return combined([vary(BASE, text) for text in ("x=0:2:9", "legs.*.length=0.1,0.2")])


def here(study, made=None):
    made = made or designs()
    return [row for task in chunks(made) for row in work(study, made, task).rows]


def begin(*words, folder):
    """A part of a cluster as a user begins it."""
    path = os.pathsep.join([str(ROOT), str(ROOT / "tests")])
    environment = os.environ | {"PYTHONPATH": path}
    return subprocess.Popen(
        [sys.executable, "-m", *map(str, words)],
        cwd=folder,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dask")
    file = folder / "scheduler.json"
    alone = ("--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", file)
    parts = [begin("distributed.cli.dask_scheduler", *alone, folder=folder)]
    until = time.monotonic() + 60
    while not file.exists():
        assert time.monotonic() < until
        time.sleep(0.05)
    for _ in range(2):
        words = ("--scheduler-file", file, "--nthreads", "1", "--no-dashboard")
        parts.append(begin("distributed.cli.dask_worker", *words, folder=folder))
    import json

    yield json.loads(file.read_text())["address"]
    for part in reversed(parts):
        part.terminate()
        part.wait(60)


def test_rows_of_a_cluster_are_the_same_bits_as_of_processes_and_of_none(address, tmp_path):
    study = Bowl({0.5: "warn", 1.0: "refuse", 1.25: "break"}, str(tmp_path))
    found = sweep_designs(study, designs(), scheduler=address)
    assert list(found.rows) == here(study)
    pids = {path.name for path in tmp_path.iterdir()} - {f"pid-{os.getpid()}"}
    assert len(pids) >= 1
    assert list(sweep_designs(study, designs(), jobs=2).rows) == list(found.rows)
    assert found.effort.memory > 2**20


def test_a_worker_of_a_cluster_that_dies_once_changes_no_row(address, tmp_path):
    study = Bowl({0.75: "die once"}, str(tmp_path))
    assert list(sweep_designs(study, designs(), scheduler=address).rows) == here(Bowl())
    assert (tmp_path / "dead-0.75").exists()


def test_a_design_that_every_worker_dies_of_is_a_row_that_says_so(address, tmp_path):
    made = combined([vary(BASE, "x=0:2:9")])
    rows = sweep_designs(Bowl({0.75: "die"}, str(tmp_path)), made, scheduler=address).rows
    lost = [row.design for row in rows if row.status == "lost"]
    assert lost == [3]
    assert "workers died of it" in rows[3].reason
    assert [row for row in rows if row.design not in lost] == [
        row for row in here(Bowl(), made) if row.design not in lost
    ]


def test_a_scheduler_that_isnt_there_is_one_message(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)
    with pytest.raises(BadInput, match=r"no Dask scheduler answers at 'tcp://127.0.0.1:1'"):
        sweep_designs(Bowl(), designs(), scheduler="tcp://127.0.0.1:1")
    with pytest.raises(BadInput, match="no Dask scheduler answers at 'nonsense'"):
        sweep_designs(Bowl(), designs(), scheduler="nonsense")


def test_without_dask_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(BadInput, match=r"pip install \"thesis-pin\[distributed\]\""):
        sweep_designs(Bowl(), designs(), scheduler="tcp://127.0.0.1:1")
