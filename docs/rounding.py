"""Write docs/rounding.md: what rounding and noise of samples leave of a report.

    python docs/rounding.py

Every cell samples a gait whose truth is known, at some rate, rounds it or adds noise, writes
it as CSV, and asks for a report. Whoever changes a constant of the method after seeing the page
has to change the first of :func:`seeds`, too: cells that taught something prove nothing.
"""

from __future__ import annotations

import runpy
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import scout_pin
from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES
from scout_pin.report.document import gait_report

ROOT = Path(__file__).parents[1]
PATHS = ROOT / "docs" / "rounding_paths.py"
RATES = (25, 60, 100, 200, 300, 1000)
DECIMALS = (3, 4, 5, 6, 7)
NOISES = (1e-5, 1e-4)
"""Of lengths [m]; angles have ten times as much [rad]."""

Curves = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Truth:
    """A gait that is known exactly.

    Attributes:
        name: Its name.
        robot: The biped that walks it.
        seconds: How long it takes.
        poses: Times [s] → 18 coordinates, ``(n, 18)``.
        support: Times [s] → who stands, ``(n, 2)``.
        margin: Least margin [m].
        torque: Largest torque of any joint [N·m].
        use: Largest use of a servo's torque-speed line.
        verdict: Whether it can walk, and whether the servos carry it.
    """

    name: str
    robot: scout_pin.Scout
    seconds: float
    poses: Curves
    support: Curves
    margin: float
    torque: float
    use: float
    verdict: tuple[bool, bool]


@dataclass(frozen=True)
class Cell:
    """One file and what its report says.

    Attributes:
        gait, rate, how: Name, samples a second, resolution or noise.
        margin, torque, use: Value, low, high.
        verdict: Can walk, servos carry; None where the samples can't say.
        truth: The gait.
    """

    gait: str
    rate: float
    how: str
    margin: tuple[float, float, float]
    torque: tuple[float, float, float]
    use: tuple[float, float, float]
    verdict: tuple[bool | None, bool | None]
    truth: Truth

    @property
    def exact(self) -> bool:
        """Whether the samples count as exact, so that nothing is left open."""
        return self.margin[1] == self.margin[2]

    @property
    def inside(self) -> bool:
        """Whether margin, torque and use of the truth lie in their intervals.

        Of samples that count as exact: within 0.05 mm and 0.1 %.
        """
        return all(
            low - near * self.exact <= true <= high + near * self.exact
            for (_, low, high), true, near in (
                (self.margin, self.truth.margin, 5e-5),
                (self.torque, self.truth.torque, 1e-3 * self.truth.torque),
                (self.use, self.truth.use, 1e-3 * self.truth.use),
            )
        )

    @property
    def wrong(self) -> bool:
        """Whether it says yes or no where the truth says the other."""
        return any(
            said is not None and said != true
            for said, true in zip(self.verdict, self.truth.verdict, strict=True)
        )

    @property
    def useless(self) -> bool:
        """Whether it is refused or wider than ± 2 mm."""
        return None in self.verdict or self.margin[2] - self.margin[1] > 4e-3


def stride(t: np.ndarray) -> np.ndarray:
    """A brisk stride of two steps in 1.6 s that never rests: 18 coordinates, ``(n, 18)``."""
    w = 2 * np.pi / 1.6
    sway = np.sin(w * (t - 0.12)) + 0.1 * np.sin(3 * w * (t - 0.12))
    result = np.zeros((len(t), 18))
    result[:, 0] = -0.05 * sway
    result[:, 1] = 0.0375 * t - 0.0073 + 0.0027 * np.sin(2 * w * t - 1.4)
    result[:, 2] = 0.209 + 0.0044 * np.sin(2 * w * t - 1.1)
    result[:, 3] = -0.213 + 0.015 * np.cos(2 * w * t)
    result[:, 4] = -0.125 * sway
    result[:, 5] = 0.1 * np.sin(w * t)
    for first, start in ((6, 1.025), (12, 0.225)):
        u = np.clip((t - start) / 0.575, 0.0, 1.0)
        result[:, first] = -0.034 if first == 6 else 0.034
        rise = u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)  # three derivatives vanish at ends
        result[:, first + 1] = 0.06 * rise + (0.0 if first == 6 else -0.03)
        result[:, first + 2] = 0.02 * 256 * (u * (1 - u)) ** 4
    return result


def stride_support(t: np.ndarray) -> np.ndarray:
    """Who stands in :func:`stride`, left then right, ``(n, 2)``."""
    return np.stack([(t <= 1.025) | (t >= 1.6), (t <= 0.225) | (t >= 0.8)], axis=1)


def truths() -> Iterator[Truth]:
    """The gaits, each with its numbers by exact curves."""
    scout = scout_pin.load()
    for name, source, robot in (
        ("walk", ROOT / "examples/walk.toml", scout),
        ("lopsided walk", ROOT / "examples/lopsided_walk.toml", None),
        ("squat", ROOT / "examples/squat.toml", scout),
        ("thesis", "thesis", scout),
    ):
        walker = robot or scout_pin.load(ROOT / "examples/lopsided.toml")
        gait = load_gait(source)
        unit, start, end = gait.time_unit, gait.start, gait.end

        def poses(t: np.ndarray, gait=gait, unit=unit, start=start, end=end) -> np.ndarray:
            at = np.clip(start + t / unit, start, end)
            return np.stack([c(at) for body in BODIES for c in gait.curves[body]], axis=1)

        def support(t: np.ndarray, gait=gait, unit=unit, start=start, end=end) -> np.ndarray:
            return gait.support(np.clip(start + t / unit, start, end))

        report = gait_report(walker, gait, samples=3001)
        yield _truth(name, walker, unit * (end - start), poses, support, report)
    with tempfile.TemporaryDirectory() as folder:
        # Finely and with all digits, in rows that stand on both sides of every change.
        t = np.union1d(np.linspace(0.0, 1.6, 3201), [0.225, 0.8, 1.025])
        path = Path(folder) / "stride.csv"
        write(path, t, stride(t), stride_support(t), lambda value: f"{value:.17g}")
        report = gait_report(scout, load_gait(path, smooth="none"), samples=3001)
    yield _truth("stride", scout, 1.6, stride, stride_support, report)


def _truth(name, robot, seconds, poses, support, report) -> Truth:
    numbers = report.margin.min(), report.actuators.peak_torque.max(), report.servo_use.max()
    said = report.can_walk, report.servos_carry
    return Truth(name, robot, seconds, poses, support, *(float(n) for n in numbers), said)


def write(
    path: Path,
    t: np.ndarray,
    poses: np.ndarray,
    support: np.ndarray,
    text: Callable[[float], str],
) -> None:
    """A gait as CSV."""
    names = {(True, True): "double", (True, False): "left", (False, True): "right"}
    columns = [f"{body}_{coordinate}" for body in BODIES for coordinate in POSE_NAMES]
    lines = [",".join(["t", "support", *columns])]
    for time, who, row in zip(t, support, poses, strict=True):
        said = names[bool(who[0]), bool(who[1])]
        lines.append(",".join([repr(float(time)), said, *map(text, row)]))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def seeds(name: str, rate: float, place: int) -> list[int]:
    """Of a cell's random numbers: gait, rate, number of its resolution."""
    return [20261127, int(rate), place, *map(ord, name)]


def cells(truth: Truth) -> Iterator[Cell]:
    """Every rate and resolution of one gait."""
    for rate in RATES:
        for place, how in enumerate([*DECIMALS, *NOISES]):
            random = np.random.default_rng(seeds(truth.name, rate, place))
            yield cell(truth, rate, how, random)


def cell(truth: Truth, rate: float, how: float, random: np.random.Generator) -> Cell:
    """One file: decimals if ``how`` is whole, else noise."""
    start = random.uniform(0.0, 1.0 / rate)  # so that rows don't stand on changes of contact
    t = np.arange(start, truth.seconds, 1.0 / rate)
    poses = truth.poses(t)
    if how >= 1:
        said, text = f"{how} decimals", lambda value: f"{value:.{int(how)}f}"
    else:
        scale = np.where(np.arange(18) % 6 < 3, how, 10.0 * how)
        poses = poses + scale * random.standard_normal(poses.shape)
        said, text = f"{how * 1e6:g} µm of noise", lambda value: f"{value:.7f}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "gait.csv"
        write(path, t, poses, truth.support(t), text)
        report = gait_report(truth.robot, load_gait(path))
    peaks, use = report.actuators.peak_torque, report.servo_use
    held = report.headlines
    if held is None:
        one = [(float(v),) * 3 for v in (report.margin.min(), peaks.max(), use.max())]
    else:
        whole = (held.margin, held.peak_torque[peaks.argmax()], held.servo_use[use.argmax()])
        one = [(float(i.value), float(i.low), float(i.high)) for i in whole]
    verdict = report.can_walk, report.servos_carry
    return Cell(truth.name, rate, said, one[0], one[1], one[2], verdict, truth)


def _paths() -> Iterator[str]:
    section: Callable[[], Iterator[str]] = runpy.run_path(str(PATHS))["section"]
    return section()


HOOKS: list[Callable[[], Iterator[str]]] = [_paths]
"""More sections: of other robots, each a maker of lines."""


def page() -> str:
    """The whole document."""
    made: list[Cell] = []
    sections: list[str] = []
    for truth in truths():
        own = list(cells(truth))
        made += own
        sections += _section(truth, own)
    for hook in HOOKS:
        sections += hook()
    return "\n".join([*_head(made), *sections]) + "\n"


def _head(made: list[Cell]) -> list[str]:
    fine = [one for one in made if one.how in _FINE]
    inside, wrong = sum(one.inside for one in made), sum(one.wrong for one in made)
    useless, none = sum(one.useless for one in fine), sum(None in one.verdict for one in made)
    told = f"""# What rounding and noise leave of a report

Made by `python docs/rounding.py`. Every cell samples a gait whose truth is known, at a rate and
from a moment of no one's choice, rounds it to so many decimals of metres and radians (5 are
0.01 mm) or adds white noise (in µm; ten times as much in µrad), writes it as CSV and asks for a
report. Earlier tables of the same gaits taught two slacks of the method (of torque, and of rates of
joints that rest) and how to tell corners from noise; these random numbers were drawn afterwards,
once.

**{len(made)} cells: the true margin, peak torque and use of the servos lie in their intervals in
{inside} ({inside / len(made):.1%}); {wrong} wrong verdicts, {none} without one.** Of the
{len(fine)} cells at 0.01 mm or finer {useless} have no verdict or are wider than ± 2 mm.

Cells: least margin and largest torque, each with its interval; whether it walks and whether the
servos carry it (? where the samples can't say). **Bold**: the truth is outside an interval.
A value without an interval is that of samples which count as exact.
"""
    return told.split("\n")


_FINE = ("5 decimals", "6 decimals", "7 decimals", "10 µm of noise")


def _section(truth: Truth, own: list[Cell]) -> list[str]:
    words = {True: "yes", False: "no", None: "?"}
    walks, carried = (words[said] for said in truth.verdict)
    lines = [
        f"## {truth.name}",
        "",
        f"Truth: margin {truth.margin * 1e3:.2f} mm, torque {truth.torque:.4f} N·m, "
        f"{truth.use:.1%} of the torque-speed line; walks: {walks}, carried: {carried}.",
        "",
        "| rate | samples | margin mm | torque N·m | walks | carried |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for one in own:
        numbers = (bounds(one.margin, 1e3, 2), bounds(one.torque, 1.0, 4))
        mark = "" if one.inside and not one.wrong else "**"
        said = " | ".join(words[answer] for answer in one.verdict)
        cells_ = " | ".join(f"{mark}{text}{mark}" for text in numbers)
        lines.append(f"| {one.rate:g} Hz | {one.how} | {cells_} | {said} |")
    return [*lines, ""]


def bounds(values: tuple[float, float, float], factor: float, digits: int) -> str:
    value, low, high = (f"{x * factor:.{digits}f}" for x in values)
    return value if low == high else f"{value} [{low}, {high}]"


if __name__ == "__main__":
    (ROOT / "docs" / "rounding.md").write_text(page(), encoding="utf-8")
