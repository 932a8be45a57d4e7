"""Between a grid's placements: Nelder and Mead's simplex from a few of the best."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pollard_pin.kinematics.geometry import Branch
from pollard_pin.motion.placing import Placement
from pollard_pin.study.placement.choices import AXES, Choices, values_of
from pollard_pin.study.placement.judging import Judge
from pollard_pin.study.placement.objectives import cost

Array = NDArray[np.float64]

STARTS = 3  # of the refinement
TRIES = 60  # of each, for every axis along which it goes
_LENGTH, _ANGLE = 4, 2  # digits of metres and degrees to which it is set up
_STEP = 0.01  # of the grid's, to which it is refined


def starts(choices: Choices, order: NDArray[np.intp]) -> Iterator[int]:
    """The best placements, branches aside, none of which is next to a better one."""
    chosen: list[Array] = []
    for number in order.tolist():
        image, _, *place = (int(k) for k in np.unravel_index(number, choices.shape))
        cell = np.array([2 * image, *place])  # another image isn't next to it
        if all(np.abs(cell - other).max() > 1 for other in chosen):
            chosen.append(cell)
            yield number
        if len(chosen) == STARTS:
            return


def refine_from(
    judge: Judge,
    objective: str,
    choices: Choices,
    wide: list[int],
    first: Placement,
    branch: Branch,
) -> Placement:
    """The best near a placement of the grid, in whole tenths of millimetres and hundredths of °."""
    from scipy.optimize import minimize

    axes = [choices.lines[k] for k in wide]
    values = np.array(values_of(first))
    centre = values[wide]
    low, high = np.array([axis[0] for axis in axes]), np.array([axis[-1] for axis in axes])
    step = np.array([np.diff(axis).min() for axis in axes])

    def placed(at: Array) -> Placement:
        every = values.copy()
        every[wide] = np.clip(centre + at * step, low, high)
        return Placement.of(every[:3], float(every[3]), first.mirrored)

    def value(at: Array) -> float:
        judged = judge.placements([placed(at)], branch)
        return float(cost(judge.robot, objective, judged)[0])

    least, most = (low - centre) / step, (high - centre) / step
    inwards = np.where(most > 0, 0.5, -0.5)
    simplex = np.concatenate([np.zeros((1, len(wide))), np.diag(inwards)])
    scale = abs(value(np.zeros(len(wide))))
    found = minimize(
        value,
        np.zeros(len(wide)),
        method="Nelder-Mead",
        bounds=np.stack([least, most], axis=1),
        options={
            "initial_simplex": simplex,
            "xatol": _STEP,
            "fatol": 1e-4 * scale,
            "maxfev": TRIES * len(wide),
        },
    )
    return _set_up(placed(found.x), wide, first)


def _set_up(found: Placement, wide: list[int], first: Placement) -> Placement:
    """To as many digits as a part is set up to; what wasn't moved stays as it was."""
    x, y, z = (
        round(value, _LENGTH) if k in wide else before
        for k, (value, before) in enumerate(zip(found.position, first.position, strict=True))
    )
    turned = AXES.index("turn") in wide
    turn = float(np.radians(round(np.degrees(found.turn), _ANGLE))) if turned else first.turn
    return Placement((x, y, z), turn, first.mirrored)
