"""What may be in a file: every limit of every reader, in one place.

They are far above what robots need and low enough that a hostile or broken file
is refused within seconds and in little memory. docs/conventions.md lists them.
"""

from __future__ import annotations

from dataclasses import dataclass


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
        values: Numbers, texts and tables of a TOML file.
        nesting: Levels of tables, lists or elements inside each other.
        key: Length of a key or name [characters].
        text: Length of any other text [characters].
        elements: Elements of a URDF.
        links: Links of a robot.
        joints: Its joints that move, and entries of each list of a closure file.
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
    rows: int = 1_000_000
    columns: int = 200
    cells: int = 10_000_000
    values: int = 100_000
    nesting: int = 32
    key: int = 200
    text: int = 20_000
    elements: int = 200_000
    links: int = 10_000
    joints: int = 1_000
    magnitude: float = 1e12
    smallest: float = 1e-9
    time_step: float = 1e-9
    axis: float = 1e-6
    patience: float = 5.0


LIMITS = Limits()
