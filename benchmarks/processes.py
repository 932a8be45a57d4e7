"""Processes of their own: whole commands, and what only a fresh interpreter shows."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from tempfile import TemporaryDirectory

from measuring import Spent

_BYTECODE = TemporaryDirectory()
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
ENVIRONMENT = {
    key: value
    for key, value in os.environ.items()
    if key not in (*THREADS, "PYTHONDONTWRITEBYTECODE")
} | {"PYTHONPYCACHEPREFIX": os.environ.get("PYTHONPYCACHEPREFIX") or _BYTECODE.name}
"""Of children: nobody sets the number of threads for a user, and all is compiled, as an installer
leaves it: the first run, which isn't counted, compiles, unless the caller names a folder where
that was done before."""

_MEASURE = """
import json, resource, sys, time
def peak():
    try:  # getrusage counts what the parent held when it forked
        with open("/proc/self/status") as lines:
            return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20  # macOS, in bytes
times = []
for _ in range({warm} + {rounds}):
    cpu, wall = time.process_time(), time.perf_counter()
    work()
    times.append((time.process_time() - cpu, time.perf_counter() - wall))
cpu, wall = sorted(times[{warm}:])[{rounds} // 2]
json.dump({{"cpu": cpu, "wall": wall, "memory": peak()}}, sys.stdout)
"""


def run(*words: str, environment: Mapping[str, str] = ENVIRONMENT) -> str:
    """What a Python process of its own says.

    Raises:
        RuntimeError: It failed; says how.
    """
    done = subprocess.run(
        [sys.executable, *words], capture_output=True, text=True, env=dict(environment), check=False
    )
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(words)} ended with {done.returncode}: {done.stderr[-2000:]}")
    return done.stdout


def measured_child(
    text: str,
    rounds: int = 1,
    *,
    warm: int = 1,
    environment: Mapping[str, str] | None = None,
) -> Spent:
    """What ``work()`` takes in a process of its own, without its start.

    Args:
        text: Python that defines ``work``.
        rounds: How often it is done; the median counts.
        warm: How often before.
        environment: Of the process; None for the user's.
    """
    measure = _MEASURE.format(warm=warm, rounds=rounds)
    found = json.loads(run("-c", text + measure, environment=environment or ENVIRONMENT))
    return Spent(found["cpu"], found["wall"], found["memory"])
