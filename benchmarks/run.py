"""One table of ratios against peers, all measured in the same run.

Run ``python benchmarks/run.py``. Ours and the peer's are measured in turns; times
are medians on this machine, and only the ratios mean anything elsewhere.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import pollard
import processes
import scout
from timing import Comparison

from thesis_pin.command.output import print_table

SUITES: dict[str, Callable[[], list[Comparison]]] = {
    "scout": lambda: scout.kinematics() + scout.dynamics(),
    "pollard": lambda: pollard.kinematics() + pollard.dynamics(),
    "commands": processes.commands,
}


def main() -> None:
    """Run the suites asked for, all by default, and print their tables."""
    names = [*SUITES, "streams"]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("suite", nargs="*", help=f"which: {', '.join(names)} (default: all)")
    asked = parser.parse_args().suite or names
    for name in asked:
        if name not in names:
            parser.error(f"no suite {name!r}; there are {', '.join(names)}")
    for name in asked:
        if name == "streams":
            title = f"{processes.MILLION} samples to torques"
            print_table(("robot", "s", "peak MB", "added MB"), processes.streams(), title=title)
        else:
            print_comparisons(name, SUITES[name]())


def print_comparisons(name: str, comparisons: list[Comparison]) -> None:
    """Measure and print one suite."""
    unit, scale = ("ms", 1e3) if name == "commands" else ("µs", 1e6)
    rows = []
    for row in comparisons:
        ours, theirs, ratio = row.measure()
        times = (f"{ours * scale:.2f}", row.peer, f"{theirs * scale:.2f}")
        rows.append((row.work, *times, f"{ratio:.3g}"))
    print_table(("work", unit, "against", unit, "ratio"), rows, title=f"{name}: time per item")


if __name__ == "__main__":
    main()
