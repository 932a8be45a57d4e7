"""What tolerances come to at many poses: at worst, by root of squares, by number and by kind."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pollard_pin.model import Pollard
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.accuracy.exact import reached
from pollard_pin.study.accuracy.extremes import farthest, root_of_squares, sums
from pollard_pin.study.accuracy.parameters import PLACE
from pollard_pin.study.accuracy.sensitivity import sensitivity
from pollard_pin.study.accuracy.tolerances import Tolerances
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.workers import silent

MOTORS = np.array([PLACE[f"motor.{name}"] for name in ACTUATOR_NAMES])
"""Columns of the six motors."""

_BLOCK = 1024


@dataclass(frozen=True)
class Stack(Brief):
    """Errors of the spray tip at n poses; k tolerances, of some kinds.

    Attributes:
        worst: Farthest that the tip is off, linear in the errors [m], shape ``(n,)``.
        components: Farthest along x, y and z [m], ``(n, 3)``.
        root: Root of the sum of squares of what each tolerance does [m], ``(n,)``.
        deviation: Standard deviation of the distance, as the tolerances are drawn [m], ``(n,)``.
        worst_turn, root_turn, deviation_turn: The same of the spray direction [rad], ``(n,)``.
        exact: Distance at the same errors, and at the opposite ones, by exact kinematics: the
            larger [m], ``(n,)``; infinite where such a robot can't be assembled.
        bent: By how much the exact way differs from the linear one, over that, ``(n,)``.
        give: Largest way of the tip for a force, the motors' stiffness alone [m/N], ``(n,)``; NaN
            if no stiffness is given.
        slopes: Way of the tip for each number that is off [m/m], [m/rad], ``(n, k)``.
        turns: The same of the spray direction [rad/m], [rad/rad].
        kinds: Kind of tolerance → worst, root, worst_turn, root_turn of it alone, ``(4, n)``.
    """

    worst: np.ndarray
    components: np.ndarray
    root: np.ndarray
    deviation: np.ndarray
    worst_turn: np.ndarray
    root_turn: np.ndarray
    deviation_turn: np.ndarray
    exact: np.ndarray
    bent: np.ndarray
    give: np.ndarray
    slopes: np.ndarray
    turns: np.ndarray
    kinds: dict[str, np.ndarray]

    @property
    def farthest(self) -> np.ndarray:
        """The larger of the linear worst case and the exact one [m], shape ``(n,)``."""
        return np.asarray(np.maximum(self.worst, self.exact))


def stacked(
    robot: Pollard,
    angles: np.ndarray,
    allowed: Tolerances,
    stiffness: np.ndarray | None = None,
    progress: Callable[[int, int], None] = silent,
) -> Stack:
    """Errors of the spray tip at closed configurations.

    Args:
        robot: The planned robot.
        angles: Shape ``(n, 12)`` [rad].
        allowed: What may be off.
        stiffness: Of each motor's joint [N·m/rad], shape ``(6,)``.
        progress: Called with the poses done and their total.
    """
    parts = []
    for part in blocks(len(angles), _BLOCK):
        parts.append(_stacked(robot, angles[part], allowed, stiffness))
        progress(min(part.stop, len(angles)), len(angles))
    names = [name for name in Stack.__dataclass_fields__ if name != "kinds"]
    joined = {name: np.concatenate([getattr(part, name) for part in parts]) for name in names}
    kinds = {
        kind: np.concatenate([part.kinds[kind] for part in parts], axis=1) for kind in allowed.kinds
    }
    return Stack(**joined, kinds=kinds)


def _stacked(
    robot: Pollard, angles: np.ndarray, allowed: Tolerances, stiffness: np.ndarray | None
) -> Stack:
    every = sensitivity(robot, angles)
    some = every[:, :, allowed.columns]
    moved, turned = some[:, :3], some[:, 3:]
    vectors, turning = moved * allowed.sizes, turned * allowed.sizes
    worst, signs = farthest(vectors)
    corner = (vectors @ signs[..., None])[..., 0]
    exact, bent = _corners(robot, angles, allowed, signs, corner)
    give = np.full(len(angles), np.nan)
    if stiffness is not None:
        by_motor = every[:, :3][:, :, MOTORS]
        give = np.linalg.eigvalsh((by_motor / stiffness) @ by_motor.swapaxes(1, 2))[:, -1]
    kinds = {
        kind: np.stack(
            [
                farthest(vectors[:, :, of])[0],
                root_of_squares(vectors[:, :, of]),
                farthest(turning[:, :, of])[0],
                root_of_squares(turning[:, :, of]),
            ]
        )
        for kind, of in allowed.kinds.items()
    }
    return Stack(
        worst=worst,
        components=sums(vectors),
        root=root_of_squares(vectors),
        deviation=root_of_squares(moved * allowed.deviations),
        worst_turn=farthest(turning)[0],
        root_turn=root_of_squares(turning),
        deviation_turn=root_of_squares(turned * allowed.deviations),
        exact=exact,
        bent=bent,
        give=give,
        slopes=np.linalg.norm(moved, axis=1),
        turns=np.linalg.norm(turned, axis=1),
        kinds=kinds,
    )


def _corners(
    robot: Pollard,
    angles: np.ndarray,
    allowed: Tolerances,
    signs: np.ndarray,
    linear: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Distance at the worst errors and their opposite, exactly; and how far from linear it is."""
    errors = allowed.whole((signs * allowed.sizes).T[:, None, :] * np.array([[[1.0], [-1.0]]]))
    tips = reached(robot.specification, angles, errors).tip
    away = tips - robot.posture(angles).tip
    expected = np.stack([linear, -linear])
    size = np.linalg.norm(linear, axis=-1)
    distance = np.linalg.norm(away, axis=-1).max(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        bent = np.linalg.norm(away - expected, axis=-1).max(axis=0) / size
    lost = np.isnan(distance)
    return np.where(lost, np.inf, distance), np.where(lost | np.isnan(bent), np.inf, bent)
