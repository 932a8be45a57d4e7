"""Slips tried on a whole thesis, counted by kind."""

from __future__ import annotations

import functools
import random
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing

from thesis_pin.audit.mutation.slips import SLIPS
from thesis_pin.audit.mutation.trial import ANSWERS, Trial, Trials
from thesis_pin.audit.thesis import Thesis
from thesis_pin.numeric.checks import whole
from thesis_pin.numeric.workers import shared
from thesis_pin.report.tables import Table

_TOGETHER = 32
"""Lines a process takes at once."""


def try_slips(thesis: Thesis, *, share: float = 1.0, seed: int = 1, jobs: int = 1) -> list[Trial]:
    """Plant slips in the lines of a thesis that hold, and see which the audit notices.

    Args:
        thesis: The thesis.
        share: Share of its lines to try, drawn by the seed.
        seed: Of the choice of lines and slips.
        jobs: Processes that share the work. With more than one, a script has to call this
            below ``if __name__ == "__main__"``.
    """
    jobs = whole("jobs", jobs, 1)
    drawn = random.Random(seed)
    names = [one.id for one in thesis.catalogue().equations if drawn.random() < share]
    parts = [names[k : k + _TOGETHER] for k in range(0, len(names), _TOGETHER)]
    if jobs < 2 or len(parts) < 2:
        _begin(thesis, seed)
        try:
            return [trial for part in parts for trial in _trials(part)]
        finally:
            _here.clear()  # its states take hundreds of megabytes
    order = {name: k for k, name in enumerate(names)}
    begin = functools.partial(_begin, thesis, seed)
    with closing(shared(_trials, parts, min(jobs, len(parts)), begin)) as results:
        found = [trial for part in results for trial in part]
    return sorted(found, key=lambda trial: order[trial.id])


_here: list[tuple[Thesis, Trials]] = []
"""The thesis that this process tries, and its trials."""


def _begin(thesis: Thesis, seed: int) -> None:
    equations = thesis.catalogue()
    _here[:] = [(thesis, Trials(equations, thesis.ground(equations), seed=seed))]


def _trials(names: Sequence[str]) -> list[Trial]:
    ((thesis, trials),) = _here
    equations = thesis.catalogue()
    return [trial for name in names for trial in trials.of(equations[name])]


def table(title: str, trials: Iterable[Trial]) -> Table:
    """How many slips of each kind were tried, and what became of them."""
    counted = Counter((trial.kind, trial.answer) for trial in trials)
    rows = []
    for kind in (*SLIPS, "all"):
        counts = [sum(counted[one, a] for one in _kinds(kind)) for a in ANSWERS]
        rows.append((kind, str(sum(counts)), *(str(count or "-") for count in counts)))
    return Table(title, ("kind of slip", "tried", *ANSWERS), rows)


def _kinds(kind: str) -> tuple[str, ...]:
    return tuple(SLIPS) if kind == "all" else (kind,)


def missed_lines(trials: Iterable[Trial]) -> Iterator[str]:
    """Every slip that was missed, by line."""
    for trial in trials:
        if trial.answer == "missed":
            where = f"member {trial.member}" if trial.member else "left side"
            yield f"{trial.id}, {where}, {trial.kind}: {' '.join(trial.said.split())}"
