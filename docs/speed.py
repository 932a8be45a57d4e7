"""Write docs/speed.md from what one run of the benchmark measured.

    python benchmarks/run.py --all --json docs/speed.json
    python docs/speed.py

A test holds the page to docs/speed.json.
"""

from __future__ import annotations

import json
import runpy
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STORE, PAGE = ROOT / "docs" / "speed.json", ROOT / "docs" / "speed.md"
TABLES = runpy.run_path(str(ROOT / "benchmarks" / "tables.py"))

Json = Mapping[str, object]

TITLES = {
    "scout": "Scout",
    "pollard": "Pollard",
    "loading": "Loading a robot",
    "commands": "Whole commands",
    "streams": "A million samples",
    "threads": "Two threads",
    "planning": "Planning a walk",
    "simulation": "The second engine",
    "fastest": "Planning the fastest walk",
}
OPTIONAL = ("planning", "simulation", "fastest")
"""Suites without which a run is a whole one: they take seconds an item, or MuJoCo."""
NOTES = {
    "scout": "EAIK is C++ and answers with angles; our answer carries margins, residuals and "
    "reasons for all eight branches.",
    "loading": "In a process of its own, packages imported; the first call imports what loading "
    "needs besides.",
    "commands": "From the start of the process to its end.",
    "streams": "`torque_blocks` in a process of its own, without its start. Goals are of the time "
    "a sample, of the whole, and of the process's peak memory.",
    "threads": "By the clock on the wall. With both cores free, and with one kept busy by "
    "somebody else.",
    "planning": "`scout_pin.plan_gait` from a request to a judged walk: start, cycle, stop, both "
    "reports. N counts the samples at which it asks Pinocchio for RNEA; the yardstick is "
    "Pinocchio alone at as many samples, and its derivatives at as many as the plan takes them "
    "at. Goals are of the whole plan, by both clocks. A plan takes {turns}.",
    "simulation": "`simulate_gait` and `simulate_path` in MuJoCo, all of it but the report that "
    "they begin with. An item is a simulated millisecond: as many microseconds as it takes, so "
    "many milliseconds of processor time does a simulated second.",
    "fastest": 'As other plans, with `objective="fastest"`; in {turns}.',
}

TEXT = """# Speed

<!-- Written by docs/speed.py from docs/speed.json. -->

`python benchmarks/run.py` first compares ours and the peer's answers, then measures both in turns,
so that a busy machine hits both; `python benchmarks/run.py scout streams` runs some of it
({suites}),
`--all` also what takes minutes (`fastest`), `--quick` only tries everything, `--json FILE` writes
what was measured. Only the ratios mean anything on another machine.

This is one run of {date} on {machine}, with
{versions}.{missing}

Times are medians of an item, ratios medians of {rounds} turns or more (of plans fewer), beside the
quarters below and above; of processor time where one thread works, by the clock on the wall for two
threads. N is the number of items.

{tables}
## Long motions

`scout_pin.torque_blocks(robot, gait, t)` and `pollard_pin.torque_blocks(robot, path, time)` yield a
few thousand samples at a time: a million take {streams},
with one foot on the floor. Both feet on the floor cost {double} a sample where the least torques
would take a sole beyond its limits. A whole report of a million samples stays below 600 MB: from
65 536 samples on it keeps angles, torques and wrenches, and works rates and everything else out
when they are asked for, each time anew; `report.joints.part(samples)` gives those of some samples
in full.

```python
import scout_pin

robot, gait = scout_pin.load(), scout_pin.load_gait("thesis")
peak = 0.0
for block in scout_pin.torque_blocks(robot, gait, gait.sample_times(1_000_000)):
    peak = max(peak, abs(block.dynamics.torque).max())
```

## How

The sample is the last axis inside, in blocks that stay in a core's cache. Below sixteen
poses the same formulas run on Python floats. Along a motion only the branch that is kept is worked
out. Rates, accelerations and torques are products of the same few vectors, with 2×2 systems at
most, and on Pollard of the few components that don't vanish in the axes of its links; RNEA's base
rows are the floor's wrench. Where both feet stand, the facets that bind at one sample are tried on
the ones that follow, all of them in one stack. Figures are laid out once and drawn once a format,
numbers are written by orjson, what ships is read in a form that was checked when it was generated,
and heavy libraries are imported by the verbs that need them.
"""


def page(run: Json) -> str:
    """The page of one run."""
    rows = run["rows"]
    absent = [suite for suite in TITLES if not any(row["suite"] == suite for row in rows)]
    missing = [suite for suite in absent if suite not in OPTIONAL]
    if run["quick"] or missing:
        raise SystemExit(f"not a whole run: quick {run['quick']}, without {missing}")
    streams = [row for row in rows if row["suite"] == "streams"]
    said = [f"{row['ours']['cpu']['median'] * row['size']:.1f} s" for row in streams]
    peak = max(row["ours"]["memory_mb"] for row in streams)
    double = next(row for row in rows if row["work"].startswith("both feet"))
    return TEXT.format(
        suites=", ".join(f"`{suite}`" for suite in TITLES),
        date=run["date"],
        machine=machine(run["machine"]),
        versions=", ".join(f"{name} {one}" for name, one in run["versions"].items() if one),
        missing="".join(f" {name} wasn't installed." for name in run["missing"])
        + (f" Not run: {', '.join(f'`{suite}`' for suite in absent)}." if absent else ""),
        rounds=min(row["rounds"] for row in rows if row["suite"] not in OPTIONAL),
        tables="\n".join(section(suite, rows) for suite in TITLES if suite not in absent),
        streams=f"{' and '.join(said)} and at most {peak:.0f} MB",
        double=TABLES["seconds"](double["ours"]["cpu"]["median"]),
    )


def machine(found: Json) -> str:
    """What it ran on, in words."""
    simd = ", ".join(found["simd"]) or "none"
    name = found["processor"] or found["architecture"]
    busy = f", {found['load']:.1f} processes at work before" if found["load"] > 0.5 else ""
    return f"{name}, {found['cores']} cores{busy}, SIMD features that NumPy uses {simd}"


def section(suite: str, rows: Sequence[Json]) -> str:
    """A suite's table under its title."""
    rounds = sorted({row["rounds"] for row in rows if row["suite"] == suite})
    turns = f"{' or '.join(map(str, rounds))} turn{'s' * (rounds[-1] > 1)}"
    note = f"{NOTES[suite]}\n\n".replace("{turns}", turns) if suite in NOTES else ""
    return f"## {TITLES[suite]}\n\n{note}" + "\n".join(table(suite, rows)) + "\n"


def table(suite: str, rows: Sequence[Json]) -> Iterator[str]:
    """Lines of a suite's table."""
    columns = TABLES["COLUMNS"]
    yield f"| {' | '.join(columns)} |"
    yield "| --- " * len(columns) + "|"
    for row in rows:
        if row["suite"] == suite:
            for cells in TABLES["lines"](row):
                shown = [f"**{cell}**" if cell.startswith("no") else cell for cell in cells[-1:]]
                yield f"| {' | '.join((*cells[:-1], *shown))} |"


if __name__ == "__main__":
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else STORE
    found = json.loads(source.read_text(encoding="utf-8"))
    text = page(found)
    if source.resolve() != STORE:
        STORE.write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
    PAGE.write_text(text, encoding="utf-8")
