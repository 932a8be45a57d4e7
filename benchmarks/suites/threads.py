"""Two threads against one: with both cores free, and with one of them kept busy by another.

Times are by the clock on the wall, so these rows mean something only where nobody else works.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from functools import partial

import numpy as np
from measuring import Equal, Goal, Peer, Row, Scale
from processes import ENVIRONMENT, measured_child, run

import pollard_pin

GAIN, LOSS = Goal(1 / 1.5), Goal(1.2)
"""What two threads gain at least, and what they lose at most where a core is busy."""

_BUSY = """
import os
parent = os.getppid()
while os.getppid() == parent:
    sum(range(1_000_000))
"""
_GAIT = """
import sys
from scout_pin.cli import main
sys.exit(main(["gait", "--samples", "{count}"]))
"""
_LOOPS = """
import numpy as np, pollard_pin
from thesis_pin.loops.dynamics import inverse_dynamics
robot = pollard_pin.load()
joints = pollard_pin.joint_trajectory(robot, pollard_pin.appendix_b().sample({count}))
def work():
    inverse_dynamics(robot, joints.q, joints.v, joints.a)
"""


@contextlib.contextmanager
def busy_core() -> Iterator[None]:
    """One core kept busy by a process that ends with this one."""
    core = min(os.sched_getaffinity(0))
    process = subprocess.Popen([sys.executable, "-c", _BUSY])
    try:
        os.sched_setaffinity(process.pid, {core})
        yield
    finally:
        process.kill()
        process.wait()


def rows(scale: Scale) -> Iterator[Row]:
    """Rows with both cores free, then those with one busy."""
    if not hasattr(os, "sched_getaffinity") or len(os.sched_getaffinity(0)) < 2:
        print("threads: there is only one core, or no way to bind to one", file=sys.stderr)
        return
    yield from _ours(scale, "", GAIN)
    with busy_core():
        yield from _ours(scale, ", one core busy", LOSS)
        yield from _blas(scale, ", one core busy", LOSS)


def _ours(scale: Scale, where: str, goal: Goal) -> Iterator[Row]:
    """Our own threads and processes."""
    robot = pollard_pin.load()
    x, z = np.linspace(0.1, 0.8, 25 if scale.quick else 401), np.linspace(-0.5, 0.5, 401)
    work = {
        jobs: partial(pollard_pin.evaluate_workspace, robot, x, 0.0, z, jobs=jobs)
        for jobs in (1, 2)
    }

    def difference() -> float:
        one, two = work[1]().condition, work[2]().condition
        return float(np.abs(np.nan_to_num(one) - np.nan_to_num(two)).max())

    peer = Peer("1 thread", len(x) * len(z), work[1])
    equal = Equal("condition numbers [-]", difference, 0.0)
    shown = f"pollard-pin workspace, 2 threads{where}"
    yield Row(shown, len(x) * len(z), work[2], peer, equal, (goal,), clock="wall")


def _blas(scale: Scale, where: str, goal: Goal) -> Iterator[Row]:
    """What NumPy's own threads do to work that nobody gave threads to."""
    count = 300 if scale.quick else 10_001
    one, two = (ENVIRONMENT | {"OPENBLAS_NUM_THREADS": str(number)} for number in (1, 2))
    text = _GAIT.format(count=count)
    works = [partial(run, "-c", text, environment=one_of) for one_of in (one, two)]
    shown = f"scout-pin gait, 2 BLAS threads{where}"
    yield Row(shown, 1, works[1], Peer("1 thread", 1, works[0]), None, (goal,), clock="wall")
    text = _LOOPS.format(count=count)
    rounds = 1 if scale.quick else 9
    works = [partial(measured_child, text, rounds, environment=one_of) for one_of in (one, two)]
    shown = f"inverse dynamics of any loops, 2 BLAS threads{where}"
    yield Row(
        shown, count, works[1], Peer("1 thread", count, works[0]), None, (goal,), clock="wall"
    )
