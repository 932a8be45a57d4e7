"""The smallest motors of one kind that carry a motion: the answer, in sentences, JSON and CSV."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import instance, real
from thesis_pin.sizing.loads import Array, Loads
from thesis_pin.sizing.smallest.family import Family
from thesis_pin.sizing.smallest.solving import asked, smallest_torques

MASSES = "Not counted: masses, which stay those of the specification; a heavier motor asks more."
_DIGITS = 4

Groups = Mapping[str, Sequence[int]]
"""Name → numbers of the joints whose motors are alike."""


@dataclass(frozen=True, eq=False)
class Smallest(Brief):
    """The smallest motors of one kind with which a motion is done, in one timing of it.

    Attributes:
        law: ``"given"``, ``"free"``, or what the motion's time was chosen for.
        timing: How the motion is timed, in words.
        duration: How long it takes [s].
        loads: What the joints need so.
        family: Which motors.
        groups: Name → numbers of the joints whose motors are alike.
        factor: Least safety factor asked for.
        once: Stall torque of each joint's motor that does it once [N·m], shape ``(k,)``; NaN if
            no motor of the kind does.
        long: The same of one that bears it for long.
        notes: What else has to be said, whole sentences.
    """

    law: str
    timing: str
    duration: float
    loads: Loads
    family: Family
    groups: Groups
    factor: float
    once: Array
    long: Array
    notes: tuple[str, ...] = ()

    @property
    def yes(self) -> bool:
        """Whether each joint has a motor that carries the motion for long."""
        return bool(np.isfinite(self.long).all())

    @property
    def use(self) -> Array:
        """What each motor of :attr:`once` is asked for over what it has, ``(k,)``."""
        each = np.where(np.isfinite(self.once), self.once, np.inf)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = asked(self.loads, self.family, each, self.factor)[0] / each
        return np.where(np.isfinite(self.once), share, np.nan)

    def sentences(self) -> Iterator[str]:
        """The answer, a sentence for each group of joints."""
        for name, joints in self.groups.items():
            once, long = (float(values[list(joints)].max()) for values in (self.once, self.long))
            if math.isnan(once):
                yield f"{self.timing}: no motor of this kind carries {name}."
                continue
            said = f"{self.timing}: {name} {'needs' if len(joints) == 1 else 'need'} {up(once)} N·m"
            if math.isnan(long):
                yield f"{said} to do it once; none does for long."
            elif long > once:
                yield f"{said} to do it once, {up(long)} N·m for long."
            else:
                yield f"{said}, once and for long."

    def _cell(self) -> Cell:
        heads = ("motors", "once N·m", "for long N·m")
        rows = [(name, *values) for name, *values in self.rows()]
        return Cell(
            f"Smallest motors, {self.timing}", list(self.sentences()), self.yes, heads, rows
        )

    def rows(self) -> Iterator[tuple[str, str, str]]:
        """Name of each group, and its two torques for people."""
        for name, joints in self.groups.items():
            k = list(joints)
            yield name, up(float(self.once[k].max())), up(float(self.long[k].max()))

    def document(self) -> dict[str, object]:
        """JSON-ready; docs/sizing.md describes it."""
        loads = self.loads
        return {
            "law": self.law,
            "timing": self.timing,
            "duration": self.duration,
            "load": {
                "peak_torque": np.abs(loads.torque).max(axis=0),
                "rms_torque": loads.rms(loads.torque),
                "peak_speed": np.abs(loads.speed).max(axis=0),
                "peak_acceleration": np.abs(loads.acceleration).max(axis=0),
            },
            "once": _known(self.once),
            "long": _known(self.long),
            "use": _known(self.use),
            "yes": self.yes,
            "notes": list(self.notes),
        }


def smallest(
    loads: Loads,
    family: Family,
    groups: Groups | None = None,
    *,
    factor: float = 1.0,
    law: str = "given",
    timing: str = "As it is timed",
) -> Smallest:
    """The smallest motors of one kind that carry loads.

    Args:
        loads: From :meth:`Loads.of <thesis_pin.sizing.loads.Loads.of>`.
        family: Which motors there are, one for each joint.
        groups: Name → numbers of the joints whose motors are alike; None for each its own.
        factor: Least safety factor.
        law: See :class:`Smallest`.
        timing: The same.

    Raises:
        BadInput: The factor isn't positive, or family or groups are of other joints.
    """
    instance("loads", loads, Loads, "Loads.of()")
    instance("family", family, Family, "Family.of()")
    factor = real("factor", factor, low=1e-6)
    if groups is None:
        groups = {name: (k,) for k, name in enumerate(loads.joints)}
    count = len(loads.joints)
    if len(family.speed) != count or sorted(k for g in groups.values() for k in g) != list(
        range(count)
    ):
        raise BadInput(
            "family or groups are of other joints than the loads",
            allowed=f"{count} joints, each once",
        )
    once, long = smallest_torques(loads, family, list(groups.values()), factor)
    duration = float(loads.time[-1] - loads.time[0])
    return Smallest(law, timing, duration, loads, family, groups, factor, once, long)


def up(value: float) -> str:
    """A torque for people, rounded up: what is said carries what it has to."""
    if math.isnan(value):
        return "none"
    if value <= 0:
        return "0"
    step = 10.0 ** (math.floor(math.log10(value)) - _DIGITS + 1)
    # A hair below, so that what is round already stays so.
    return f"{math.ceil(value / step * (1 - 1e-12)) * step:.{_DIGITS}g}"


def _known(values: Array) -> list[float | None]:
    return [one if math.isfinite(one) else None for one in values.tolist()]
