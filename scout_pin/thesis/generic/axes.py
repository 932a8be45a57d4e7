"""States of a robot built like the biped whose axes and offsets point anywhere.

On the biped many things vanish: a screw axis is at right angles to the next, an offset lies
along an axis, no rotation depends on where the torso stands. A line that puts such things
together says 0 = 0 there, whatever it says. Here each of the thesis's unit vectors, ``i_0``,
``k_4i`` or ``j_141``, has a direction of its own in its own frame, so that what the line takes
as given is free and what it makes of it is seen.

"axes": nothing else changes. "dependent": besides, every angle also depends on every
coordinate, so that no derivative vanishes. "alike": it does so on all coordinates in the
same way, so that derivatives that vanish on the biped are equal, if they are of one thing.
"grouped": alike on the coordinates of the torso's place, of its turn, of each leg.
"varying": the angles are dependent, and the vectors change in their own frames as well.
"actuation": as "axes", with A_τ as the thesis makes it.
"""

from __future__ import annotations

import functools
import zlib
from collections.abc import Hashable, Mapping
from dataclasses import dataclass

import numpy as np

from scout_pin.thesis.references import References
from scout_pin.thesis.state import UNIT, Parameters, State
from scout_pin.thesis.symbols import frames
from scout_pin.thesis.symbols.forces import matrix_entry
from scout_pin.thesis.symbols.geometry import JOINT_AXES
from thesis_pin.audit.judging.residuals import Free
from thesis_pin.equations.catalogue import Equation
from thesis_pin.equations.dual import Dual
from thesis_pin.equations.formula import Node, Symbol
from thesis_pin.equations.values import Value, scalar

KINDS = ("axes", "dependent", "alike", "grouped", "varying", "actuation")
_STATES, _SEED = 3, 4127
_FOOT_ANGLES = [f"{letter}{i}" for letter in ("theta", "phi", "psi") for i in "12"]
"""What the axes of a foot's Euler angles are called; they don't move the robot."""
_SAME = {"alike": [0] * 18, "grouped": [0] * 3 + [3] * 3 + [6] * 6 + [12] * 6}
"""Kind → the coordinate on which each depends as it does itself."""
_TRANSLATIONS = 3
"""The first coordinates: they move the torso and aren't angles."""


@dataclass(frozen=True)
class OpenState(State):
    """States on robots whose vectors point anywhere.

    Attributes:
        weights: Derivative of every angle by each coordinate besides its own, ``(18, 18)``.
        varying: Whether the vectors change with the coordinates, too, in their own frames.
    """

    weights: np.ndarray | None = None
    varying: bool = False

    def own(self, name: str) -> np.ndarray:
        """Components of a unit vector in its own frame, another direction for each name."""
        if self.weights is None or not self.varying:
            return _direction(name)
        return np.asarray(
            _direction(name) + self.q @ (self.weights[:, :3] * _direction(name[::-1]))
        )

    @property
    def steady(self) -> bool:
        """Whether unit vectors stay as they are in their own frames."""
        return not self.varying

    def turned_at(self, stage: int, name: str) -> np.ndarray:
        """A unit vector of one of the frames on the way to the torso's, in the world."""
        return np.asarray((self.torso[stage].rotation @ self.own(name)[..., None])[..., 0])

    def _then(
        self, frame: Dual, move: str, by: np.ndarray, speeds: Mapping[Hashable, float], axis: str
    ) -> Dual:
        (k,) = speeds or (None,)
        if self.weights is not None and isinstance(k, int) and k >= _TRANSLATIONS:
            by = by + self.q @ self.weights[k]
            speeds = {m: float(slope + (m == k)) for m, slope in enumerate(self.weights[k])}
        if not axis:
            return frame.then(move, by, speeds)
        bent = np.eye(4)
        bent[:3, :3] = bend(move[-1], axis)
        return (frame @ bent).then(move, by, speeds) @ bent.T


class OpenReferences(References):
    """The references on such robots."""

    state: OpenState

    def _axis(self, name: str) -> np.ndarray | None:
        """An axis as its own frame carries it, whatever turns about it."""
        stage = {"ithetaB": 2, "jphiB": 3, "kpsiB": 4}.get(name)
        if stage is not None:
            return self.state.turned_at(stage, name)
        body = self._body(frames.frame(name[1:]) or "") if JOINT_AXES.get(name[:-1]) else None
        if body is None:
            return super()._axis(name)
        return self.state.turned(body, name)

    def _along_world(self, array: np.ndarray) -> np.ndarray:
        axes = np.stack([self.state.own(name) for name in ("i0", "j0", "k0")], axis=-1)
        return np.asarray((np.linalg.inv(axes) @ array[..., None])[..., 0])

    def skew(self, axis: str, argument: Node, indices: dict[str, str]) -> np.ndarray | None:
        """What turns the axis of a printed rotation into the robot's, ``(3, 3)``."""
        name = frames.axis_of(axis, argument, indices)
        return bend(axis, name) if name else None


class ActuationReferences(OpenReferences):
    """The same, with A_τ as the thesis makes it."""

    def _of_A(self, symbol: Symbol, i: str) -> Value | None:
        """An entry of A_τ as (4.12) and (4.13) make it: a torque's axis times its link's turn.

        On the biped those that hold are zero because two axes are at right angles.
        """
        entry = matrix_entry(symbol.sub)
        if symbol.bold or symbol.dots or entry is None:
            return super()._of_A(symbol, i)
        row, column = entry
        leg, n = str(column // 6 + 1), column % 6 + 1
        start = next(key for key, joint in JOINT_AXES.items() if joint == n)
        turned = self.state.angular(f"{n}{leg}")[..., row]
        return scalar((self._axis(f"{start}{leg}") * turned).sum(axis=-1))


@functools.cache
def _direction(name: str) -> np.ndarray:
    if name[1:] in _FOOT_ANGLES:
        return UNIT[name[0]]
    if name[1:] in ("1", "2"):  # frame i is the sole's, which is also called 14i
        name = f"{name[0]}14{name[1:]}"
    drawn = np.random.default_rng(zlib.crc32(name.encode())).normal(size=3)
    return np.asarray(drawn / np.linalg.norm(drawn))


@functools.cache
def bend(letter: str, name: str) -> np.ndarray:
    """Rotation of the x, y or z axis into the direction of a vector, ``(3, 3)``."""
    start, end = UNIT["ijk"["xyz".index(letter)]], _direction(name)
    half = (start + end) / np.linalg.norm(start + end)
    return 2 * np.outer(half, half) - np.eye(3)


def states(kind: str) -> OpenState:
    """Seeded open states of one of :data:`KINDS`."""
    generator = np.random.default_rng(_SEED)
    robots = [(Parameters.random(generator), 1) for _ in range(_STATES)]
    q, v, a, virtual = (generator.uniform(-s, s, (_STATES, 1, 18)) for s in (1.2, 2.0, 5.0, 1.0))
    tau, multipliers = (generator.uniform(-1, 1, (_STATES, 1, 12)) for _ in range(2))
    weights = None
    if kind not in ("axes", "actuation"):
        weights = generator.uniform(0.2, 0.8, (18, 18))
        weights = weights[:, _SAME[kind]] if kind in _SAME else weights
    parameters = Parameters.repeat(robots)
    return OpenState(
        parameters, q, v, a, virtual, tau, multipliers, weights=weights, varying=kind == "varying"
    )


@functools.cache
def references(kind: str) -> OpenReferences:
    """The references at open states of one of :data:`KINDS`."""
    of = ActuationReferences if kind == "actuation" else OpenReferences
    return of(states(kind))


def free(equation: Equation) -> tuple[Free, ...]:
    """Where a line has to hold besides: with any axes unless it says why not, and as it says."""
    kinds = {} if equation.special else {"axes": ()}
    return tuple(Free(references(kind), found) for kind, found in (kinds | equation.free).items())
