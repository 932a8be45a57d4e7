"""One table of ratios against peers, all measured in the same run.

Run ``python benchmarks/run.py``. Answers are compared first; then ours and the peer's are measured
in turns. Times are medians on this machine, and only the ratios mean anything elsewhere.
``--all --json docs/speed.json``, then ``python docs/speed.py``, renews docs/speed.md.
"""

from __future__ import annotations

import argparse
import datetime
import importlib
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

os.environ.update({f"{name}_NUM_THREADS": "1" for name in ("OPENBLAS", "OMP", "MKL")})
# Before NumPy is imported: threads that wait for work cost time, too.

from machine import PEERS, machine, versions
from measuring import FULL, QUICK, Json, Row, Scale, Unequal
from tables import printed, spaced

SUITES = {
    "scout": ("scout_kinematics", "scout_dynamics"),
    "pollard": ("pollard_kinematics", "pollard_dynamics"),
    "loading": ("loading",),
    "commands": ("commands",),
    "streams": ("streams",),
    "threads": ("threads",),
    "planning": ("planning",),
    "simulation": ("simulation",),
    "fastest": ("fastest",),
}
"""Suite → modules whose ``rows`` are measured."""

LONG = ("fastest",)
"""Suites that take minutes and run only if they are named, or all are asked for."""

SCHEMA, VERSION = "thesis-pin/benchmark", 1


def main(words: Sequence[str] | None = None) -> int:
    """Run the suites asked for; 1 if answers differ."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    usual = [name for name in SUITES if name not in LONG]
    parser.add_argument(
        "suite",
        nargs="*",
        help=f"which: {', '.join(SUITES)} (default: all but {', '.join(LONG)})",
    )
    parser.add_argument("--all", action="store_true", help="every suite, those that take long too")
    parser.add_argument("--quick", action="store_true", help="a smoke run of a few samples")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write what was measured")
    arguments = parser.parse_args(words)
    for name in arguments.suite:
        if name not in SUITES:
            parser.error(f"no suite {name!r}; there are {', '.join(SUITES)}")
    if arguments.all and arguments.suite:
        parser.error(f"--all and {arguments.suite[0]!r}: either")
    if arguments.json and not arguments.json.parent.is_dir():
        parser.error(f"--json: there is no folder {str(arguments.json.parent)!r}")
    scale, begun = QUICK if arguments.quick else FULL, time.perf_counter()
    document = header(scale)
    for name, version in versions().items():
        if version is None:
            print(f"{name} isn't installed: rows against it have no ratio", file=sys.stderr)
    found: list[Json] = []
    try:
        for name in SUITES if arguments.all else arguments.suite or usual:
            mine = [measured(name, row, scale) for row in rows(name, scale)]
            printed(name, mine)
            found += mine
    except Unequal as error:
        print(f"run.py: error: {error}", file=sys.stderr)
        return 1
    document |= {"seconds": round(time.perf_counter() - begun), "rows": found}
    if arguments.json:
        text = json.dumps(shorter(document), indent=1, ensure_ascii=False, allow_nan=False)
        arguments.json.write_text(text + "\n", encoding="utf-8")
    return 0


def rows(suite: str, scale: Scale) -> Iterator[Row]:
    """The rows of a suite, each once its data are made."""
    for module in SUITES[suite]:
        yield from importlib.import_module(f"suites.{module}").rows(scale)


def measured(suite: str, row: Row, scale: Scale) -> Json:
    """A row's result; says on standard error which it is."""
    shown = f"{suite}: {row.work}, {spaced(row.size)}, against {row.peer.name}"
    print(shown, file=sys.stderr, flush=True)
    return {"suite": suite} | row.measure(scale)


def header(scale: Scale) -> Json:
    """What ran where."""
    found = versions()
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "quick": scale.quick,
        "machine": machine(),
        "versions": found,
        "missing": [name for name in PEERS if found[name] is None],
    }


def shorter(value: object) -> object:
    """The same document with six digits of its numbers: more say nothing of a time."""
    if isinstance(value, dict):
        return {key: shorter(item) for key, item in value.items()}
    if isinstance(value, list):
        return [shorter(item) for item in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


if __name__ == "__main__":
    sys.exit(main())
