"""A path with the law of motion that was asked for: the fastest, a steady one, the gentlest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Literal, get_args

import numpy as np

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.model import Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.study.timing.course import Course
from pollard_pin.study.timing.limits import motor_limits
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import BadInput, Infeasible
from thesis_pin.numeric.checks import choice, function, instance, real
from thesis_pin.numeric.workers import silent
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.gentle import gentlest
from thesis_pin.timing.law import Law
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.rows import Array
from thesis_pin.timing.solving import SPARE, Solved, refined, solve
from thesis_pin.timing.steady import even, steady, windowed
from thesis_pin.timing.track import Grid

Aim = Literal["fastest", "constant-speed", "window", "least-load"]
AIMS: tuple[str, ...] = get_args(Aim)

WINDOW, SHARE = 0.05, 0.9
"""Of a window: how much slower than its speed the tool may be, and on which share of the way."""


@dataclass(frozen=True, eq=False)
class TimedPath(Brief):
    """A path and a law of motion along it.

    Attributes:
        course: The path on the robot.
        limits: What the law keeps.
        aim: Which law was asked for.
        solved: The law, its grid, and how much of the limits it uses between its places.
        window: How much slower than :attr:`speed` still counts, for ``"window"``.
        share: On which share of the way it was to be kept.
        speed: Tool speed that is kept [m/s], for ``"window"`` and ``"constant-speed"``.
    """

    course: Course
    limits: Limits
    aim: Aim
    solved: Solved
    window: float | None = None
    share: float | None = None
    speed: float | None = None

    @property
    def law(self) -> Law:
        """The law: s, ṡ and s̈ over time."""
        return self.solved.law

    @property
    def duration(self) -> float:
        """How long the motion takes [s]."""
        return self.law.duration

    @property
    def within_limits(self) -> bool:
        """Whether the limits hold at 20 points between any two places of the law's grid."""
        return self.solved.keeps

    @cached_property
    def path(self) -> ToolPath:
        """The path with this law, to be reported on, shown or written."""
        name = f"{self.course.path.name}, {self.aim}"
        parameters: dict[str, object] = {"law": self.aim, "pieces": len(self.course.track.ends) - 1}
        return self.course.track.chain.timed(self.law, name, parameters, self.course.notes)

    @cached_property
    def tool_speed(self) -> Array:
        """Speed of the spray tip at the places of the law's grid [m/s], shape ``(n,)``."""
        left, right = (np.linalg.norm(one.velocity, axis=1) for one in self.solved.grid.sides())
        return np.append(left * self.law.rate[:-1], right[-1] * self.law.rate[-1])

    @cached_property
    def largest_torque_share(self) -> float:
        """Largest share that any motor uses of its torque limit or line, between places too."""
        use = self.solved.use
        return max(
            float(share)
            for name, share in zip(use.names, use.peak, strict=True)
            if name.startswith("torque")
        )

    def _cell(self) -> Cell:
        use = self.solved.use
        order = np.argsort(-use.peak)[:6]
        rows = [(use.names[k], f"{use.peak[k]:.1%}") for k in order]
        said = [f"{self.duration:.4g} s"]
        return Cell("Time", said, self.within_limits, ("limit", "largest use"), rows, prose=True)


def time_path(
    robot: Pollard,
    path: ToolPath | Course,
    limits: Limits | None = None,
    *,
    law: Aim = "fastest",
    duration: float | None = None,
    window: float | None = None,
    share: float | None = None,
    branch: Branch | None = None,
    progress: Callable[[int, int], None] = silent,
) -> TimedPath:
    """A law of motion along a path whose geometry is kept.

    Args:
        robot: The robot.
        path: The path of the spray tip, whose timing counts for nothing; or its
            :class:`~pollard_pin.study.timing.course.Course` on the robot, which saves work if
            several laws are asked for.
        limits: From :func:`pollard_pin.motor_limits`; None for the specification's.
        law: ``"fastest"``, from rest to rest; ``"constant-speed"``, the largest speed of the
            tool that can be kept from beginning to end; ``"window"``, the largest that is kept
            within a window on a share of the way, slower only where a limit binds or the
            motion rests; ``"least-load"``, the law of a duration whose largest share of the
            motors' torque limits is the least.
        duration: Of ``"least-load"`` [s].
        window: Of ``"window"``: how much slower than its speed still counts; None is 0.05.
        share: Of ``"window"``: of the way; None is 0.9.
        branch: Which inverse-kinematics solution; None for the default branch.
        progress: Called with the steps done and their total.

    Raises:
        Unreachable, SingularPose: The path can't be followed at all; with the place.
        Infeasible: The motors can't even hold the robot still somewhere.
        TrajectoryError: No such law exists on this path.
        BadInput: What is given belongs to another law.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    choice("law", law, AIMS)
    function("progress", progress, "progress(done, total)")
    course = path if isinstance(path, Course) else Course.of(robot, path, branch)
    if course.robot is not robot or branch not in (None, course.branch):
        raise BadInput(
            "the course is another robot's or another branch's",
            remedy="Make it with Course.of(robot, path, branch)",
        )
    if limits is None:
        limits = motor_limits(course.robot.specification)
    instance("limits", limits, Limits, "pollard_pin.motor_limits()")
    _belong(law, duration=duration, window=window, share=share)
    given = (duration, window, share)
    try:
        return _timed(course, limits, law, given, progress)
    except Infeasible as error:
        x, y, z = course.track.chain(np.array([error.place]))[0].position[0]
        raise Infeasible(
            error.limit,
            error.share,
            error.place,
            where=f"with the spray tip at ({x:z.4g}, {y:z.4g}, {z:z.4g}) m",
        ) from None


def _timed(
    course: Course,
    limits: Limits,
    law: Aim,
    given: tuple[float | None, float | None, float | None],
    progress: Callable[[int, int], None],
) -> TimedPath:
    """The law of checked arguments; ``given`` is a duration, a window and a share of the way."""
    duration, window, share = given
    tight = limits.tightened(SPARE)
    if law == "constant-speed":
        solved = solve(even(course.grid), limits, partial(_steady, tight), progress=progress)
        made = TimedPath(course, limits, law, solved)
        return replace(made, speed=float(made.tool_speed.max()))
    grid, _, gain = refined(course.grid, partial(_fastest, tight), progress)
    if law == "window":
        wide = WINDOW if window is None else real("the window", window, low=1e-3, high=0.9)
        most = SHARE if share is None else real("the share of the way", share, low=0.01, high=0.999)
        _, speed = windowed(grid, tight, wide, most)
        kept = partial(_fastest, replace(tight, tool_speed=speed))
        solved = solve(grid, limits, kept, gain, progress)
        return TimedPath(course, limits, law, solved, wide, most, speed)
    if law == "least-load":
        if duration is None:
            raise BadInput("the law of least load needs a duration", remedy="Give one, in seconds")
        seconds = real("the duration", duration, low=1e-3, high=1e6, unit="s")
        solved = solve(grid, limits, partial(_gentlest, tight, seconds), gain, progress)
    else:
        solved = solve(grid, limits, partial(_fastest, tight), gain, progress)
    return TimedPath(course, limits, law, solved)


def _belong(law: Aim, **given: float | None) -> None:
    """Refuse what belongs to another law."""
    owner = {"duration": "least-load", "window": "window", "share": "window"}
    for name, value in given.items():
        if value is not None and owner[name] != law:
            raise BadInput(
                f"a {name} belongs to the law {owner[name]!r}, and {law!r} is asked for",
                remedy="Leave it out, or ask for that law",
            )


def _fastest(limits: Limits, grid: Grid) -> Law:
    return fastest(grid, limits)


def _steady(limits: Limits, grid: Grid) -> Law:
    return steady(grid, limits)


def _gentlest(limits: Limits, duration: float, grid: Grid) -> Law:
    return gentlest(grid, limits, duration)[0]
