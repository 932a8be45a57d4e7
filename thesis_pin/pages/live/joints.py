"""Sliders for the joints of any robot; its loops stay closed."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from thesis_pin.loops.checking.assembly import Assembly
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.joints import is_free
from thesis_pin.loops.moving.coordinates import Coordinate, coordinates
from thesis_pin.loops.moving.moving import Moved, move, ways
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.mechanism.supplement import Coupling
from thesis_pin.pages.live.alone import Tree, tree
from thesis_pin.pages.live.rig import Slider, Stand
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Readouts = Callable[[Array], tuple[tuple[str, str], ...]]

_UNITS = {"rad": "°", "m": "mm", "": ""}


class JointRig:
    """A robot that is moved joint by joint.

    Args:
        robot: The robot.
        q: Where it stands at first, shape ``(nq,)``.
        size: How large it is [m], for joints without a range.
        open_because: Why its loops aren't kept closed; empty if they are.
        precision: See :func:`thesis_pin.loops.configurations.surveying.surveyed`.
        readouts: What there is to say of a configuration besides, labels and values.
        labels: What some coordinates are called instead of their names.
        headings: Under what some joints stand.
        root: Under what a root's coordinates stand.
    """

    choices: tuple[str, ...] = ()

    def __init__(
        self,
        robot: LoadedRobot,
        q: Array,
        size: float,
        *,
        open_because: str = "",
        precision: float | None = None,
        readouts: Readouts = lambda _: (),
        labels: Mapping[str, str] | None = None,
        headings: Mapping[str, str] | None = None,
        root: str = "root",
    ) -> None:
        self.robot, self._q, self._precision = robot, np.asarray(q, dtype=float), precision
        self._open_because, self._readouts = open_because, readouts
        base = 1 if is_free(robot.model) else -1
        # The root last: who turns joints doesn't want to look for them below it.
        every = sorted(coordinates(robot.model), key=lambda one: one.joint == base)
        self._coordinates = tuple(every)
        self.sliders = self._sliders(size, labels or {}, headings or {}, root)

    def _sliders(
        self, size: float, labels: Mapping[str, str], headings: Mapping[str, str], root_heading: str
    ) -> tuple[Slider, ...]:
        found = []
        motors = set(self.robot.actuators) if isinstance(self.robot, ClosedRobot) else set()
        root = 1 if is_free(self.robot.model) else -1
        for one, (low, high) in zip(self._coordinates, ways(self._coordinates, size), strict=True):
            heading = "joints" if not motors else "motors" if one.name in motors else "other joints"
            heading, note = headings.get(one.name, heading), ""
            if one.joint == root:
                heading = root_heading
            elif one.kind == "position" and not np.isfinite(one.low + one.high):
                note = "no limits in the file"
            # Where the robot stands has to be on the slider.
            value = one.value(self._q)
            ends = min(low, value), max(high, value)
            found.append(
                Slider(labels.get(one.name, one.name), _UNITS[one.unit], *ends, heading, note)
            )
        return tuple(found)

    def start(self) -> Stand:
        """Where it stands at first."""
        return self._stand(self._q)

    def moved(self, state: Array, slider: int, value: float) -> Stand:
        """See :class:`~thesis_pin.pages.live.rig.Rig`; the state is q."""
        q = np.asarray(pin.normalize(self.robot.model, state))
        coordinate = self._coordinates[slider]
        robot = self.robot
        if isinstance(robot, ClosedRobot) and not self._open_because:
            done = move(robot, q, coordinate, value, precision=self._precision)
        else:
            done = Moved(coordinate.placed(q, value))
        notes: tuple[str, ...] = ()
        if not done.reached:
            stays = _value(coordinate, done.q)
            notes = (f"{coordinate.name} stays at {stays}: {done.why}",)
        return self._stand(done.q, notes)

    def chosen(self, state: Array, choice: int) -> Stand:
        """There is nothing to choose."""
        return self._stand(np.asarray(pin.normalize(self.robot.model, state)))

    def alone(self) -> Tree | str:
        """See :class:`~thesis_pin.pages.live.rig.Rig`; a robot whose loops close has to ask."""
        robot, couplings = self.robot, list[Coupling]()
        if isinstance(robot, ClosedRobot) and not self._open_because:
            if robot.loops:
                return "its loops are kept closed by the command"
            couplings = list(robot.couplings)
        return tree(robot.model, self._coordinates, couplings)

    def _stand(self, q: Array, notes: tuple[str, ...] = ()) -> Stand:
        marks, levels = [], dict[int, int]()
        for one in self._coordinates:
            mark, level = _limit(one, q)
            marks.append(mark)
            if level is not None:
                levels[one.joint] = max(level, levels.get(one.joint, 0))
        return Stand(
            state=tuple(q.tolist()),
            q=q,
            values=tuple(one.value(q) for one in self._coordinates),
            marks=tuple(marks),
            levels=levels,
            notes=notes,
            readouts=self._readouts(q),
        )


def _limit(one: Coordinate, q: Array) -> tuple[str, int | None]:
    """What there is to say of a coordinate and its range: words, and a level for its joint."""
    value, excess = one.value(q), one.excess(q)
    if excess > TOLERANCES.joint_limit:
        scale, unit = (np.degrees(1.0), "°") if one.unit == "rad" else (1e3, " mm")
        if not one.unit:
            scale, unit = 1.0, ""
        return f"{excess * scale:.3g}{unit} beyond its limit", 1
    for end, word in ((one.low, "lower"), (one.high, "upper")):
        if abs(value - end) <= TOLERANCES.joint_limit:
            return f"at its {word} limit", 0
    return "", None


def _value(one: Coordinate, q: Array) -> str:
    value = one.value(q)
    if one.unit == "rad":
        return f"{np.degrees(value):.2f}°"
    return f"{value * 1e3:.4g} mm" if one.unit == "m" else f"{value:.4g}"


def why_open(found: Assembly) -> str:
    """Why the loops of a robot that was assembled aren't kept closed; empty if they are."""
    if found.closed:
        return ""
    return (
        f"the loops don't close: at the least {found.widest} stay open. Joints move one by one, "
        "the loops as they may"
    )
