"""Whole processes: how long the commands take, and a million samples in little memory."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from timing import Comparison

MILLION = 1_000_000

_SCOUT = """
import scout_pin
robot, gait = scout_pin.load(), scout_pin.load_gait("thesis")
blocks = lambda n: scout_pin.torque_blocks(robot, gait, gait.sample_times(n))
"""

_POLLARD = """
import numpy, pollard_pin
robot, path = pollard_pin.load(), pollard_pin.appendix_b()
blocks = lambda n: pollard_pin.torque_blocks(robot, path, numpy.linspace(0, path.duration, n))
"""

_MEASURE = """
import resource, time
def peak():
    try:  # getrusage counts what the parent held when it forked
        with open("/proc/self/status") as lines:
            return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20  # macOS, in bytes
for _ in blocks(10): pass
before, start = peak(), time.perf_counter()
for block in blocks({count}): block.dynamics.torque
print(time.perf_counter() - start, peak(), peak() - before)
"""


def _run(*words: str) -> str:
    return subprocess.run(
        [sys.executable, *words], check=True, capture_output=True, text=True
    ).stdout


def _command(module: str, *words: str) -> list[str]:
    return ["-c", f"import sys; from {module}.cli import main; sys.exit(main({list(words)!r}))"]


def commands() -> list[Comparison]:
    """Commands against a Python that imports Pinocchio and does nothing."""
    out = str(Path(tempfile.mkdtemp()) / "report")
    many = ["--samples", "10001"]

    def row(shown: str, module: str, *words: str) -> Comparison:
        return Comparison(
            shown,
            lambda: _run(*_command(module, *words)),
            1,
            "import pinocchio",
            lambda: _run("-c", "import pinocchio"),
            1,
            5,
        )

    return [
        row("scout-pin --help", "scout_pin", "--help"),
        row("scout-pin info", "scout_pin", "info"),
        row("scout-pin gait, 10 001", "scout_pin", "gait", *many),
        row("pollard-pin info", "pollard_pin", "info"),
        row("pollard-pin trajectory, 10 001", "pollard_pin", "trajectory", *many),
        row("the same, --out", "pollard_pin", "trajectory", *many, "--out", out),
    ]


def streams(count: int = MILLION) -> list[tuple[str, str, str, str]]:
    """Robot, seconds, peak memory of the process and what the samples added [MB]."""
    rows = []
    for name, setup in (("scout", _SCOUT), ("pollard", _POLLARD)):
        values = _run("-c", setup + _MEASURE.format(count=count)).split()
        seconds, peak, added = map(float, values)
        rows.append((name, f"{seconds:.2f}", f"{peak:.0f}", f"{added:.0f}"))
    return rows
