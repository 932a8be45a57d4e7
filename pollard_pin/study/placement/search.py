"""Where a path should stand: a grid of placements, then the best of them refined.

A peak over a path has kinks where another instant becomes the worst, and no value at all where
the path can't be followed: so a grid first, then Nelder and Mead's simplex from a few of its best.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from operator import ne

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, branch_labels, one_branch
from pollard_pin.model import Branches, Pollard
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.placing import Placement
from pollard_pin.study.placement.choices import Choices, values_of
from pollard_pin.study.placement.judged import Judged
from pollard_pin.study.placement.judging import Judge
from pollard_pin.study.placement.objectives import OBJECTIVES, Objective, cost, rounded
from pollard_pin.study.placement.placements import Placements
from pollard_pin.study.placement.refining import STARTS, TRIES, refine_from, starts
from pollard_pin.study.placement.result import Found
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, function, instance, real, shown, whole
from thesis_pin.numeric.workers import silent

Array = NDArray[np.float64]

REPORT_SAMPLES = 2001
"""Of the best, as many as a trajectory report has."""

_ALIKE = 0.1  # of the grid's, within which a refined placement is no other


def evaluate_placements(
    robot: Pollard,
    path: ToolPath,
    *,
    x: ArrayLike = 0.0,
    y: ArrayLike = 0.0,
    z: ArrayLike = 0.0,
    turn: ArrayLike = 0.0,
    mirrored: bool | Sequence[bool] = False,
    branch: Branches = DEFAULT_BRANCH,
    objective: Objective = "torque",
    condition: float | None = None,
    samples: int = 401,
    refine: bool = True,
    best: int = 10,
    start: Placement | None = None,
    start_branch: Branch = DEFAULT_BRANCH,
    progress: Callable[[int, int], None] = silent,
) -> Placements:
    """Judge placements of a path, the best first.

    Args:
        robot: The robot; the motors' limits are those of its specification.
        path: The path where it stands.
        x: What is added to its x [m]: one value, or several in ascending order.
        y: The same of y.
        z: The same of z.
        turn: Turns about the vertical through its middle [rad].
        mirrored: Whether the path itself, its mirror image or both.
        branch: One solution of inverse kinematics, several, ``"useful"`` (16) or ``"all"`` (128);
            of several those are left out on which the arms of the side chains cross.
        objective: What is to be best: ``"torque"``, the largest share of a motor's torque limit;
            ``"conditioning"``, the largest condition number of the six motors; ``"time"``, the
            duration when the path is played as fast as the motors' limits let it, and of the
            three best with the fastest law of motion; ``"clearance"``, the least sine of the
            singular sets.
        condition: Largest condition number of the six motors that is allowed; None for any.
        samples: Evenly spaced samples of the path.
        refine: Whether to go on between the grid's values from the best.
        best: How many are looked at again, at 2001 samples, and told.
        start: The placement that all are compared with; None is where the path stands.
        start_branch: Its branch.
        progress: Called with the placements judged and their total.

    Returns:
        Every placement of the grid, and the best of all.

    Raises:
        BadInput: An axis is empty or descends, there are too many placements, or the shortest
            time is asked for of a path that doesn't move.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    instance("path", path, ToolPath, "load_path() or appendix_b()")
    path = path.followed_by(robot.specification)
    choice("objective", objective, OBJECTIVES)
    function("progress", progress, "progress(done, total)")
    best, samples = whole("best", best, 1), whole("samples", samples, 2)
    if not isinstance(refine, bool):
        raise BadInput(f"refine is {shown(refine)}", allowed="True or False")
    start = Placement() if start is None else start
    instance("start", start, Placement, "Placement.of()")
    start_branch = one_branch(start_branch)
    choices = Choices.of(x, y, z, turn, mirrored, _branches(branch, start_branch))
    worst = math.inf if condition is None else real("condition", condition, low=1.0)
    several = len(choices.branches) > 1
    judge = Judge.of(robot, path, samples, paces=objective == "time", apart=several, worst=worst)
    if objective == "time" and _rests(judge):
        raise BadInput(
            f"the path {path.name!r} stays where it is, and takes no time",
            allowed="a path that moves, where the shortest time is asked for",
        )
    wide = [k for k, axis in enumerate(choices.lines) if len(axis) > 1] if refine else []
    each = TRIES * len(wide)
    total = choices.count + STARTS * each
    grid = _grid(judge, choices, lambda done: progress(done, total))
    costs = cost(robot, objective, grid)
    order = np.argsort(rounded(costs), kind="stable")[: int(np.isfinite(costs).sum())]
    tried: list[tuple[Placement, Branch, bool]] = []
    quick = replace(judge, conditions=objective == "conditioning")
    for number, first in enumerate(starts(choices, order) if wide else ()):
        progress(choices.count + number * each, total)
        one, its_branch = choices.at(first)
        nearby = refine_from(quick, objective, choices, wide, one, its_branch)
        tried.append((nearby, its_branch, True))
    many = max(samples, REPORT_SAMPLES)
    fine = Judge.of(robot, path, many, paces=judge.paces, apart=judge.apart, worst=worst)
    last = itertools.chain(tried, ((*choices.at(int(k)), False) for k in order))
    found = _best(fine, choices, objective, last, best, len(tried))
    progress(total, total)
    space = Placements(
        robot,
        path,
        objective,
        choices,
        samples,
        judge.about,
        grid,
        costs,
        Found(start, start_branch, fine.placements([start], start_branch), path.duration, False),
        tuple(found),
    )
    if objective != "time":
        return space
    from pollard_pin.study.placement.laws import with_laws

    return with_laws(space)


def _branches(branch: Branches, like: Branch) -> tuple[Branch, ...]:
    """The branches that are meant, those first that differ least from another.

    Of branches as good as each other, the first is the answer.
    """
    meant = (one_branch(branch),) if isinstance(branch, Branch) else branch_labels(branch)
    return tuple(sorted(meant, key=lambda one: sum(map(ne, one, like))))


def _rests(judge: Judge) -> bool:
    """Whether the tool moves at no sample."""
    tool = judge.motion.tool
    return not (tool.velocity.any() or tool.omega.any())


def _grid(judge: Judge, choices: Choices, progress: Callable[[int], None]) -> Judged:
    parts: list[Judged] = []
    positions = choices.positions

    def told(done: int, _: int) -> None:
        progress(len(parts) * len(positions) + done)

    for turned, branch in choices.groups():
        parts.append(judge.positions(turned, branch, positions, told))
    return Judged.joined(parts)


def _best(
    fine: Judge,
    choices: Choices,
    objective: str,
    every: Iterator[tuple[Placement, Branch, bool]],
    best: int,
    least: int,
) -> list[Found]:
    """The best of what is still good at many samples, in order.

    Args:
        fine: Judges at many samples.
        choices: The grid.
        objective: What is to be best.
        every: Placements, about the best first.
        best: How many to find.
        least: How many come from the refinement, which are all looked at.
    """
    seen: dict[tuple[Placement, Branch], tuple[float, Found]] = {}
    for number, (placement, branch, refined) in enumerate(every):
        if len({one for one, _ in seen}) >= best + least and number >= least:
            break
        judged = fine.placements([placement], branch)
        value = float(cost(fine.robot, objective, judged)[0])
        if np.isfinite(value) and (placement, branch) not in seen:
            one = Found(placement, branch, judged, fine.path.duration, refined)
            seen[placement, branch] = float(rounded(np.array(value))), one
    found: list[Found] = []
    for _, one in sorted(seen.values(), key=lambda pair: pair[0]):
        if not any(_alike(choices, one, other) for other in found):
            found.append(one)
    return found[:best]


def _alike(choices: Choices, one: Found, other: Found) -> bool:
    """Whether two placements, branches aside, are so near each other that they are one answer."""
    if one.placement.mirrored != other.placement.mirrored:
        return False
    pairs = zip(values_of(one.placement), values_of(other.placement), choices.lines, strict=True)
    return all(
        abs(a - b) <= _ALIKE * float(np.diff(line).min()) if len(line) > 1 else a == b
        for a, b, line in pairs
    )
