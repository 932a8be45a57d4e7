"""``sweep_designs()``: every design judged, here or on a cluster, and all rows in their order."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from pathlib import Path

from thesis_pin.errors import BadInput
from thesis_pin.files import Claim
from thesis_pin.numeric.checks import function, instance, whole
from thesis_pin.numeric.workers import silent
from thesis_pin.sweep.designs.making import Designs
from thesis_pin.sweep.result import Effort, Sweep
from thesis_pin.sweep.running.cluster import on_cluster
from thesis_pin.sweep.running.pool import shared
from thesis_pin.sweep.running.store import Store
from thesis_pin.sweep.running.work import Done, Task, versions
from thesis_pin.sweep.study import Row, Study

_PARTS = 200
"""Chunks that a sweep has where each may have as many designs as that takes."""

_LARGEST, _MOST_PARTS = 50, 5000
"""Designs of a chunk, which is what a process that is killed loses; chunks of a sweep."""


class Interrupted(KeyboardInterrupt):
    """A sweep was interrupted.

    Attributes:
        done: Designs whose rows there are.
        total: Designs.
        kept: Whether they stand in a folder.
    """

    def __init__(self, done: int, total: int, kept: bool) -> None:
        self.done, self.total, self.kept = done, total, kept
        super().__init__(f"{done} of {total} designs")


def sweep_designs(
    study: Study,
    designs: Designs,
    *,
    jobs: int = 2,
    scheduler: str | None = None,
    out: str | Path | Claim | None = None,
    resume: bool = False,
    progress: Callable[[int, int], None] = silent,
) -> Sweep:
    """Judge every design.

    The rows don't depend on how many processes share them, nor on whether they are this machine's
    or a cluster's workers on it. A script has to call this below ``if __name__ == "__main__"``.

    Args:
        study: What is asked, as ``scout_pin.gait_study()`` makes one.
        designs: Of what.
        jobs: Processes of this machine that share the work.
        scheduler: Address of a Dask scheduler whose workers share it instead.
        out: Folder for the rows, in Parquet, which stay whatever becomes of this process; needs
            pyarrow.
        resume: Whether to go on with the rows that stand there.
        progress: Called with the designs done and their number.

    Raises:
        BadInput: The folder holds another sweep, no scheduler answers, or something that is
            needed isn't installed.
        Interrupted: By Ctrl-C; what is done stands in the folder.
    """
    instance("designs", designs, Designs, "make_designs()")
    function("progress", progress, "progress(done, total)")
    jobs = whole("jobs", jobs, 1)
    if not len(designs):
        raise BadInput("there is no design", allowed="at least one")
    tasks, began = chunks(designs), time.monotonic()
    rows: dict[int, Row] = {}
    memory, before = 0.0, 0
    with ExitStack() as stack:
        store = None
        if out is not None:
            claim = out if isinstance(out, Claim) else stack.enter_context(Claim(out))
            store = Store(claim, study, designs, tasks)
            store.begin(resume)
            for _, found in store.rows():
                rows.update((row.design, row) for row in found)
            before = len(rows)
        left = [task for task in tasks if task.designs[0] not in rows]
        progress(before, len(designs))
        try:
            with closing(_worked(study, designs, left, jobs, scheduler)) as found_now:
                for task, done in _gathered(found_now, left):
                    if store is not None:
                        store.write(task, done.rows)
                    rows.update((row.design, row) for row in done.rows)
                    memory = max(memory, done.memory)
                    progress(len(rows), len(designs))
        except KeyboardInterrupt:
            raise Interrupted(len(rows), len(designs), store is not None) from None
    effort = Effort(
        jobs if scheduler is None else 0,
        scheduler,
        len(designs) - before,
        time.monotonic() - began,
        memory,
    )
    return Sweep(study, designs, tuple(rows[k] for k in range(len(designs))), effort)


def chunks(designs: Designs) -> list[Task]:
    """Designs in the chunks that are judged, written and lost together.

    They depend on nothing but the number of designs.
    """
    count = len(designs)
    size = max(min(-(-count // _PARTS), _LARGEST), math.ceil(count / _MOST_PARTS))
    return [
        Task(
            number,
            tuple(range(first, min(first + size, count))),
            designs.values[first : first + size],
        )
        for number, first in enumerate(range(0, count, size))
    ]


def _worked(
    study: Study, designs: Designs, tasks: Sequence[Task], jobs: int, scheduler: str | None
) -> Generator[tuple[Task, Done]]:
    if not tasks:
        return
    made = (
        shared(study, designs, tasks, jobs)
        if scheduler is None
        else on_cluster(study, designs, tasks, scheduler)
    )
    ours = versions()
    with closing(made) as found:
        for task, done in found:
            _alike(ours, done.versions)
            yield task, done


def _alike(ours: Mapping[str, str], theirs: Mapping[str, str]) -> None:
    """Refuse rows of a worker that has other versions.

    Raises:
        BadInput: It has.
    """
    other = [
        f"{name} {theirs[name]} (here {ours[name]})"
        for name in theirs
        if theirs[name] != ours[name]
    ]
    if other:
        raise BadInput(
            f"a worker has other versions: {', '.join(other)}",
            where="scheduler",
            remedy="Install the same everywhere, so that all rows are of one kind",
        )


def _gathered(
    found: Iterator[tuple[Task, Done]], tasks: Sequence[Task]
) -> Iterator[tuple[Task, Done]]:
    """Whole chunks; designs that were tried alone come together again."""
    whole_of = {task.number: task for task in tasks}
    parts: dict[int, dict[int, Row]] = {}
    for task, done in found:
        chunk = whole_of[task.number]
        rows = parts.setdefault(task.number, {})
        rows.update((row.design, row) for row in done.rows)
        if len(rows) == len(chunk.designs):
            ordered = tuple(rows[design] for design in chunk.designs)
            yield chunk, Done(ordered, done.memory, done.versions)
            del parts[task.number]


def usual_jobs() -> int:
    """Processes that share the work where nobody says: one for each processor there is."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
