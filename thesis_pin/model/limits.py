"""What may be in a file: every limit of every reader, in one place.

They are far above what robots need and low enough that a hostile or broken file
is refused within seconds and in little memory. docs/conventions.md lists them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from thesis_pin.tolerances import TOLERANCES

Key = tuple[str | int, ...]
"""Place of a value in nested tables and lists."""


@dataclass(frozen=True)
class Limits:
    """Bounds of what is read; messages name the one that was passed.

    Attributes:
        toml_bytes: Size of a specification, gait, path or catalogue [bytes].
        csv_bytes: Size of a file of samples [bytes].
        yaml_bytes: Size of a closure file [bytes].
        urdf_bytes: Size of a URDF [bytes].
        rows: Lines of a file of samples.
        columns: Cells of a line.
        cells: Cells of all lines together.
        phases: Phases of support of a gait.
        values: Numbers, texts and tables of a TOML file.
        nesting: Levels of tables, lists or elements inside each other.
        bodies_nesting: Levels of elements in formats whose bodies stand inside each other.
        key: Length of a key or name [characters].
        text: Length of any other text [characters].
        elements: Elements of a URDF.
        links: Links of a robot.
        joints: Its joints that move; Pinocchio's data grow with their cube, and take
            0.5 GB at 200.
        entries: Entries of each list of a closure file; loops and tied joints of a URDF.
        magnitude: Largest absolute value of a number, in whatever unit.
        smallest: Least value of what has to be positive.
        time_step: Least step between samples and between nodes [s], [-].
        axis: Least length of a joint's axis [-].
        patience: How long a pipe into which nobody writes is waited for [s].
    """

    toml_bytes: int = 2**20
    csv_bytes: int = 128 * 2**20
    yaml_bytes: int = 256 * 2**10
    urdf_bytes: int = 16 * 2**20
    rows: int = 500_000
    columns: int = 200
    cells: int = 5_000_000
    phases: int = 10_000
    values: int = 100_000
    nesting: int = 32
    bodies_nesting: int = 256
    key: int = 200
    text: int = 20_000
    elements: int = 200_000
    links: int = 10_000
    joints: int = 200
    entries: int = 1_000
    magnitude: float = 1e12
    smallest: float = 1e-9
    time_step: float = TOLERANCES.step
    axis: float = 1e-6
    patience: float = 5.0


LIMITS = Limits()


def bounded(data: object) -> tuple[object, list[tuple[Key, str, object]]]:
    """Data with tuples for lists, and what passes :data:`LIMITS`.

    Args:
        data: Nested dicts and lists.

    Returns:
        The same data with tuples for its lists, and key, complaint and value of
        everything that is too large, too long, too deep or too much.
    """
    problems: list[tuple[Key, str, object]] = []
    count = 0

    def copy(value: object, key: Key) -> object:
        nonlocal count
        count += 1
        if count > LIMITS.values:
            if count == LIMITS.values + 1:
                problems.append((key[:1], f"holds more than {LIMITS.values:,} values", None))
            return None
        if len(key) > LIMITS.nesting:
            problems.append((key[:3], f"is nested deeper than {LIMITS.nesting} levels", None))
            return None
        if isinstance(value, dict):
            for name in value:
                if len(str(name)) > LIMITS.key:
                    problems.append((key, f"a key is longer than {LIMITS.key} characters", name))
            return {name: copy(one, (*key, name)) for name, one in value.items()}
        if isinstance(value, list | tuple):
            return tuple(copy(one, (*key, k)) for k, one in enumerate(value))
        if isinstance(value, str) and len(value) > LIMITS.text:
            problems.append((key, f"is longer than {LIMITS.text:,} characters", value))
        if isinstance(value, int | float) and LIMITS.magnitude < abs(value) < math.inf:
            problems.append((key, f"its magnitude must be at most {LIMITS.magnitude:g}", value))
        return value

    return copy(data, ()), problems
