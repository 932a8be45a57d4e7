"""What rounding and noise leave of a path's report: a section of docs/rounding.md.

    python docs/rounding_paths.py

prints it by itself.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import pollard_pin
from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.files import load_path
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.samples import through_orientations
from pollard_pin.report.document import trajectory_report

RATES = (25, 60, 100, 200, 300, 1000)
DECIMALS = (3, 4, 5, 6, 7)
NOISES = (1e-5, 1e-4)
"""Of lengths [m]; angles have ten times as much [rad]."""
MOTORS = ("θ21", "θ211", "θ212", "θ1615", "θ1716")
"""Motors whose torque is more than rounding: the tool rolls without a load."""


@dataclass(frozen=True)
class Cell:
    """One file and what its report says.

    Attributes:
        rate: Samples a second.
        how: Resolution or noise.
        peak: Largest torque of the most loaded motor: value, low, high [N·m].
        outside: Motors whose true peak lies outside its interval.
    """

    rate: float
    how: str
    peak: tuple[float, float, float]
    outside: tuple[str, ...]


def nod(time: np.ndarray) -> np.ndarray:
    """A path of 4 s whose tool moves, nods, rolls and turns: poses ``(n, 6)``."""
    w, poses = np.pi / 2, np.zeros((len(time), 6))
    poses[:, 0] = 0.45 + 0.03 * np.sin(w * time)
    poses[:, 1] = 0.05 * np.cos(1.3 * w * time)
    poses[:, 2] = 0.02 * np.sin(2 * w * time)
    poses[:, 3] = 0.4 + 0.6 * np.sin(w * time)
    poses[:, 4] = 0.3 * np.cos(2 * w * time)
    poses[:, 5] = 0.5 * np.sin(1.5 * w * time)
    return poses


def paths() -> Iterator[tuple[str, ToolPath]]:
    """Paths that are known exactly."""
    yield "appendix B", pollard_pin.appendix_b()
    time = np.linspace(0.0, 4.0, 8001)
    poses = nod(time)
    yield "nod", through_orientations(time, poses[:, :3], pose_rotation(poses), "free")


def section() -> Iterator[str]:
    """Lines of the document."""
    robot = pollard_pin.load()
    for name, path in paths():
        true = trajectory_report(robot, path, samples=4001).actuators.peak_torque
        made = list(_cells(robot, name, path, true))
        inside = sum(not one.outside for one in made)
        yield from (
            f"## Pollard, {name}",
            "",
            f"Truth: {true.max():.4f} N·m at the most loaded motor, no motor beyond its limits. "
            f"{len(made)} cells; in {inside} the true peaks of {', '.join(MOTORS)} all lie in "
            "their intervals. Cells: the most loaded motor's peak [N·m] with its interval.",
            "",
            "| samples | " + " | ".join(f"{rate} Hz" for rate in RATES) + " |",
            "| --- " * (1 + len(RATES)) + "|",
        )
        for how in dict.fromkeys(one.how for one in made):
            row = [told(one) for one in made if one.how == how]
            yield f"| {how} | {' | '.join(row)} |"
        yield ""


def seeds(name: str, rate: int, place: int) -> list[int]:
    """Of a cell's random numbers: path, rate, number of its resolution."""
    return [20261127, rate, place, *map(ord, name)]


def told(one: Cell) -> str:
    """A cell of the table."""
    value, low, high = (f"{x:.4f}" for x in one.peak)
    text = value if low == high else f"{value} [{low}, {high}]"
    return f"**{text} ({', '.join(one.outside)})**" if one.outside else text


def _cells(
    robot: pollard_pin.Pollard, name: str, path: ToolPath, true: np.ndarray
) -> Iterator[Cell]:
    for rate in RATES:
        for place, how in enumerate([*DECIMALS, *NOISES]):
            random = np.random.default_rng(seeds(name, rate, place))
            yield cell(robot, path, rate, how, random, true)


def cell(
    robot: pollard_pin.Pollard,
    path: ToolPath,
    rate: float,
    how: float,
    random: np.random.Generator,
    true: np.ndarray,
) -> Cell:
    """One file: decimals if ``how`` is whole, else noise."""
    start = random.uniform(0.0, 1.0 / rate)
    time = np.concatenate([[0.0], np.arange(start, path.duration, 1.0 / rate), [path.duration]])
    time = time[np.concatenate([[True], np.diff(time) > 0.1 / rate])]
    poses = path.at(time).pose
    text: Callable[[float], str] = f"{{:.{int(how)}f}}".format
    said = f"{how} decimals"
    if how < 1:
        scale = np.where(np.arange(6) < 3, how, 10.0 * how)
        poses = poses + scale * random.standard_normal(poses.shape)
        said, text = f"{how * 1e6:g} µm of noise", "{:.7f}".format
    lines = ["t,x,y,z,psi,theta,phi"]
    for t, row in zip(time, poses, strict=True):
        lines.append(",".join([repr(float(t)), *map(text, row)]))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "path.csv"
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        report = trajectory_report(robot, load_path(file))
    peaks, held = report.actuators.peak_torque, report.headlines
    worst = int(peaks.argmax())
    if held is None:
        whole, outside = (float(peaks[worst]),) * 3, ()
    else:
        one = held.peak_torque[worst]
        whole = one.value, one.low, one.high
        pairs = zip(MOTORS, held.peak_torque, true, strict=False)
        outside = tuple(name for name, i, x in pairs if not i.low <= x <= i.high)
    return Cell(rate, said, whole, outside)


if __name__ == "__main__":
    print("\n".join(section()))
