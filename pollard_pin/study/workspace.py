"""Where the tool can go at a given orientation: reach and conditioning on a grid."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.screws import Posture
from pollard_pin.kinematics.singularity import LENGTH, actuation
from pollard_pin.model import Pollard
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.arrays import finite_array, vector
from thesis_pin.numeric.checks import function, instance, whole
from thesis_pin.numeric.workers import silent
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/workspace"
VERSION = 1

_CHUNK = 4096
_MOST = 20_000_000


@dataclass(frozen=True)
class Workspace(Brief):
    """Reach and conditioning on a grid of positions.

    Attributes:
        robot, branch: What was asked about.
        axes: Grid values of x, y, z [m].
        orientation: ψ, θ, φ of the tool [rad], shape ``(3,)``.
        margin: Reach margin, shape ``(nx, ny, nz)``; negative where out of reach.
        condition: Condition number of the six motors, NaN where out of reach or singular.
        determinant: Base determinant; its sign splits the workspace. NaN likewise.
    """

    robot: Pollard
    branch: Branch
    axes: tuple[np.ndarray, np.ndarray, np.ndarray]
    orientation: np.ndarray
    margin: np.ndarray
    condition: np.ndarray
    determinant: np.ndarray

    @property
    def reachable(self) -> np.ndarray:
        """Whether a position can be reached within the joint limits, ``(nx, ny, nz)``."""
        return self.margin >= 0

    @property
    def points(self) -> np.ndarray:
        """Grid positions [m], shape ``(nx, ny, nz, 3)``."""
        return np.stack(np.meshgrid(*self.axes, indexing="ij"), axis=-1)

    def columns(self) -> dict[str, np.ndarray]:
        """The grid as columns of a table; condition and determinant empty out of reach."""
        points = self.points.reshape(-1, 3)
        return {
            **{f"{name}_m": points[:, k] for k, name in enumerate("xyz")},
            "margin": np.where(np.isfinite(self.margin), self.margin, np.nan).ravel(),
            "condition": self.condition.ravel(),
            "determinant": self.determinant.ravel(),
        }

    def summary(self) -> dict[str, float | None]:
        """Shares of the grid, and the best and worst conditions."""
        regular = np.isfinite(self.condition)
        inside = self.condition[regular]
        return {
            "positions": int(self.margin.size),
            "reachable": int(self.reachable.sum()),
            "reachable_share": float(self.reachable.mean()),
            "negative_determinant": int((self.determinant < 0).sum()),
            "positive_determinant": int((self.determinant > 0).sum()),
            "least_condition": float(inside.min()) if inside.size else None,
            "median_condition": float(np.median(inside)) if inside.size else None,
            "largest_condition": float(inside.max()) if inside.size else None,
        }

    def document(self) -> dict[str, object]:
        """The reachable, regular positions as JSON-ready data; see docs/pollard.md."""
        some = self.reachable & np.isfinite(self.condition)
        return {
            "schema": SCHEMA,
            "version": VERSION,
            "axes": {name: axis for name, axis in zip("xyz", self.axes, strict=True)},
            "position": np.ascontiguousarray(self.points[some]),
            "margin": self.margin[some],
            "condition": self.condition[some],
            "determinant": self.determinant[some],
            "parameters": {
                "robot": self.robot.specification.name,
                "branch": str(self.branch),
                "orientation": self.orientation,
                "condition_length": LENGTH,
                "thesis_pin": __version__,
            },
            "summary": self.summary(),
        }


def evaluate_workspace(
    robot: Pollard,
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    orientation: Sequence[float] = (0.0, 0.0, 0.0),
    branch: Branch = DEFAULT_BRANCH,
    *,
    jobs: int = 2,
    progress: Callable[[int, int], None] = silent,
) -> Workspace:
    """Reach and conditioning over a grid.

    Args:
        robot: The robot.
        x: Grid values [m], shape ``(nx,)``, or one number for a slice.
        y: The same for y.
        z: The same for z.
        orientation: ψ, θ, φ of the tool [rad].
        branch: Which solution.
        jobs: Threads that share the grid.
        progress: Called with the positions done and their total.

    Raises:
        BadInput: The grid is empty or has more than 20 million positions.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    branch, jobs = one_branch(branch), whole("jobs", jobs, 1)
    function("progress", progress, "progress(done, total)")
    axes = tuple(np.atleast_1d(finite_array(n, v)) for n, v in zip("xyz", (x, y, z), strict=True))
    tool = vector("orientation", orientation, 3)
    shape = tuple(len(axis) for axis in axes)
    total = int(np.prod(shape))
    if any(axis.ndim != 1 for axis in axes) or not 0 < total <= _MOST:
        raise BadInput(
            f"a grid of shape {shape}",
            allowed=f"1 to {_MOST:,} positions",
            remedy="Use fewer points an axis",
        )
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    results = np.empty((3, total))

    def work(start: int) -> int:
        part = slice(start, min(start + _CHUNK, total))
        pose = np.empty((len(points[part]), 6))
        pose[:, :3], pose[:, 3:] = points[part], tool
        results[:, part] = _evaluate(robot, pose, branch)
        return len(pose)

    with ThreadPoolExecutor(jobs) as pool:
        done = itertools.accumulate(pool.map(work, range(0, total, _CHUNK)))
        for count in done:
            progress(count, total)
    margin, condition, determinant = results.reshape(3, *shape)
    return Workspace(
        robot, branch, (axes[0], axes[1], axes[2]), tool, margin, condition, determinant
    )


def _evaluate(robot: Pollard, pose: np.ndarray, branch: Branch) -> np.ndarray:
    """Margin, condition and determinant of poses, shape ``(3, n)``."""
    solution = robot.inverse_kinematics(pose, branch)
    result = np.full((3, len(pose)), np.nan)
    # A pose that only a joint limit forbids is out of reach too.
    beyond = ~solution.valid & (solution.margin >= 0)
    result[0] = np.where(beyond, -np.inf, solution.margin)
    some = np.flatnonzero(solution.valid)
    if some.size:
        posture = Posture.of(robot.geometry, solution.angles[some])
        regular = (np.abs(posture.serial_sines) > TOLERANCES.near_singular).all(axis=-1)
        some = some[regular]
    if some.size:
        posture = Posture.of(robot.geometry, solution.angles[some])
        holding = actuation(posture)
        result[1, some], result[2, some] = holding.condition, holding.base_determinant
    return result
