"""What a process of a sweep does: a chunk of designs at a time, always with one BLAS thread."""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from thesis_pin.display.brief import Brief
from thesis_pin.sweep.designs.keys import Value
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.study import Row, Study, judged

BLAS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
"""Settings of the environment that keep sums in one order."""

_PACKAGES = ("thesis-pin", "pin", "numpy", "scipy", "daqp", "shapely")
"""What a row's last bit depends on."""


@dataclass(frozen=True)
class Task(Brief):
    """Designs that are judged one after the other.

    Attributes:
        number: Of the chunk that they belong to.
        designs: Numbers of the designs.
        values: What varies in each.
    """

    number: int
    designs: tuple[int, ...]
    values: tuple[tuple[Value, ...], ...]

    def alone(self) -> list[Task]:
        """A task for each of its designs."""
        return [
            Task(self.number, (design,), (values,))
            for design, values in zip(self.designs, self.values, strict=True)
        ]


@dataclass(frozen=True)
class Done(Brief):
    """What came of a task.

    Attributes:
        rows: A row for each design.
        memory: Most memory that the process has had [byte].
        versions: See :func:`versions`.
    """

    rows: tuple[Row, ...]
    memory: float
    versions: Mapping[str, str]


def work(study: Study, designs: Designs, task: Task) -> Done:
    """Judge the designs of a task.

    Args:
        study: What is asked.
        designs: What varies; its values may be left out.
        task: Which designs.
    """
    rows = []
    for number, values in zip(task.designs, task.values, strict=True):
        one = Designs(designs.parameters, (values,))
        rows.append(judged(study, one.data(study.base, 0), number, values))
    return Done(tuple(rows), peak_memory(), versions())


def peak_memory() -> float:
    """Most memory that this process has had so far [byte]."""
    import resource

    with contextlib.suppress(OSError):  # getrusage counts what the process had that began this one
        status = Path("/proc/self/status").read_bytes()
        if found := re.search(rb"VmHWM:\s*(\d+) kB", status):
            return 1024.0 * int(found[1])
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return float(most if sys.platform == "darwin" else 1024 * most)


def versions() -> dict[str, str]:
    """Versions of what the rows depend on."""
    import platform
    from importlib.metadata import PackageNotFoundError, version

    from thesis_pin.version import __version__

    found = {"python": platform.python_version(), "machine": platform.machine()}
    for name in _PACKAGES:
        try:
            found[name] = __version__ if name == "thesis-pin" else version(name)
        except PackageNotFoundError:
            found[name] = "none"
    return found
