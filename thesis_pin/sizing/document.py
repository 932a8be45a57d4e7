"""What sizing answers: in sentences, JSON and CSV."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import instance, real
from thesis_pin.sizing.actuator import RATED, Actuator
from thesis_pin.sizing.catalogue import Catalogue
from thesis_pin.sizing.judging import Fits, by_size, fits
from thesis_pin.sizing.loads import Loads
from thesis_pin.version import __version__

VERSION = 1
"""Of the schema ``…/size``; docs/sizing.md describes it."""

MASSES = (
    "Counted: the inertia of each servo's own rotor, N² J. Not counted: masses, which stay those "
    "of the specification; a heavier servo asks more."
)


@dataclass(frozen=True, eq=False)
class Sizing(Brief):
    """Actuators held against the joints of a motion.

    Attributes:
        loads: What the joints need.
        catalogue: The actuators.
        factor: Least safety factor asked for.
        fits: Each at every joint.
    """

    loads: Loads
    catalogue: Catalogue
    factor: float
    fits: Fits

    @property
    def actuators(self) -> tuple[Actuator, ...]:
        """The actuators, in the order of their lists."""
        return self.catalogue.actuators

    @cached_property
    def lasting(self) -> NDArray[np.bool_]:
        """Which actuator carries which joint for long, ``(actuators, joints)``."""
        return self.fits.lasts(self.factor)

    @property
    def order(self) -> tuple[list[int], str]:
        """Numbers of the actuators from the smallest on, and by what."""
        return by_size(self.actuators)

    def smallest(self, carried: Iterable[bool]) -> Actuator | None:
        """The smallest actuator that carries, by one truth for each of them."""
        true = list(carried)
        numbers = [k for k in self.order[0] if true[k]]
        return self.actuators[numbers[0]] if numbers else None

    @property
    def each(self) -> list[Actuator | None]:
        """The smallest for each joint that carries it for long."""
        return [self.smallest(column) for column in self.lasting.T]

    def _cell(self) -> Cell:
        joints = self.loads.joints
        rows = [
            (joint, "none" if one is None else one.name)
            for joint, one in zip(joints, self.each, strict=True)
        ]
        heads = ("joint", "smallest that carries it for long")
        return Cell("Sizing", self.verdict(), self.yes, heads, rows, prose=True)

    @property
    def yes(self) -> bool:
        """Whether each joint has an actuator that carries it for long."""
        return bool(self.lasting.any(axis=0).all())

    def warnings(self) -> list[str]:
        """What may be wrong with the lists."""
        return [said for one in self.actuators for said in one.odd()]

    def notes(self) -> list[str]:
        """What was taken for granted, whole sentences."""
        unrated = [one.name for one in self.actuators if one.rated_torque is None]
        said = [MASSES, *self.loads.notes]
        if unrated:
            who = "every servo" if len(unrated) == len(self.actuators) else ", ".join(unrated[:6])
            more = f" and {len(unrated) - 6} more" if who != "every servo" and unrated[6:] else ""
            said.append(f"The rating of {who}{more} is taken as {RATED:g} of stall: none is given.")
        own = [f"{one.name}: {note}." for one in self.actuators for note in one.notes]
        return [*said, *own, *(f"{note}." for note in self.catalogue.notes)]

    def verdict(self) -> list[str]:
        """The answer in sentences, the most important first."""
        word, count = self.order[1], len(self.actuators)
        one = self.smallest(map(all, self.lasting))
        if one is not None:
            k = self.actuators.index(one)
            j, hot = int(self.fits.factor[k].argmin()), int(self.fits.heat[k].argmax())
            said = [
                f"{one.name} is the smallest of {count} (by {word}) that carries every joint for "
                f"long: safety factor {shown_factor(self.fits.factor[k, j])} at "
                f"{self.loads.joints[j]}, RMS {self.fits.heat[k, hot]:.0%} of its rating at "
                f"{self.loads.joints[hot]}."
            ]
            if any(one.odd()):
                said.append("But its numbers can't be right: see the warning.")
        else:
            said = [f"No servo of {count} carries every joint for long."]
            brief = self.smallest(map(all, self.fits.carries(self.factor)))
            if brief is not None:
                k = self.actuators.index(brief)
                hot = int(self.fits.heat[k].argmax())
                said.append(
                    f"{brief.name} carries the motion once: its RMS torque at "
                    f"{self.loads.joints[hot]} is {self.fits.heat[k, hot]:.0%} of its rating."
                )
        bare = [
            name for name, found in zip(self.loads.joints, self.each, strict=True) if found is None
        ]
        if bare:
            said.append(f"No servo of the list carries {', '.join(bare)} for long.")
        return said

    def document(self, command: str) -> dict[str, object]:
        """JSON-ready; docs/sizing.md describes it.

        Args:
            command: Which writes it, for the schema's name.
        """
        loads, found = self.loads, self.fits
        carried = found.carries(self.factor)
        every = self.smallest(map(all, self.lasting))
        return {
            "schema": f"{command}/size",
            "version": VERSION,
            "robot": loads.robot,
            "motion": loads.motion,
            "least_factor": self.factor,
            "joints": list(loads.joints),
            "load": {
                "peak_torque": np.abs(loads.torque).max(axis=0),
                "rms_torque": loads.rms(loads.torque),
                "peak_speed": np.abs(loads.speed).max(axis=0),
                "peak_acceleration": np.abs(loads.acceleration).max(axis=0),
            },
            "servos": [
                {
                    **{key: value for key, value in asdict(one).items() if key != "where"},
                    "armature": one.armature,
                    "rating": one.rating,
                    "power": one.power,
                }
                for one in self.actuators
            ],
            "fits": {
                "peak_torque": found.peak,
                "rms_torque": found.rms,
                "factor": [
                    [None if f == np.inf else f for f in row] for row in found.factor.tolist()
                ],
                "factor_time": found.time,
                "use": found.use,
                "rms_share": found.heat,
                "carries": carried,
                "lasts": self.lasting,
            },
            "smallest": {
                "by": self.order[1],
                "every_joint": None if every is None else every.name,
                "each_joint": [None if one is None else one.name for one in self.each],
            },
            "yes": self.yes,
            "verdict": self.verdict(),
            "notes": self.notes(),
            "warnings": self.warnings(),
            "thesis_pin": __version__,
        }

    def columns(self) -> dict[str, np.ndarray | list[str]]:
        """A row for each actuator at each joint; what the lists carried along last."""
        servos, joints = len(self.actuators), len(self.loads.joints)
        found, each = self.fits, np.repeat(np.arange(servos), joints)
        columns: dict[str, np.ndarray | list[str]] = {
            "servo": [_cell(self.actuators[k].name) for k in each],
            "joint": list(self.loads.joints) * servos,
            "factor": np.where(np.isinf(found.factor), np.nan, found.factor).ravel(),
            "use": found.use.ravel(),
            "rms_share": found.heat.ravel(),
            "peak_torque_Nm": found.peak.ravel(),
            "rms_torque_Nm": found.rms.ravel(),
            "lasts": [str(bool(one)).lower() for one in self.lasting.ravel()],
        }
        extra = dict.fromkeys(key for one in self.actuators for key in one.extra)
        for key in extra:
            columns[_cell(key)] = [_cell(self.actuators[k].extra.get(key, "")) for k in each]
        return columns


def size(loads: Loads, catalogue: Catalogue, factor: float = 1.0) -> Sizing:
    """Hold actuators against the joints of a motion.

    Args:
        loads: From :meth:`Loads.of`.
        catalogue: From :func:`thesis_pin.sizing.catalogue.read_catalogue`.
        factor: Least safety factor.

    Raises:
        BadInput: The factor isn't positive, or the loads or actuators are none.
    """
    instance("loads", loads, Loads, "Loads.of()")
    instance("catalogue", catalogue, Catalogue, "read_catalogue()")
    factor = real("factor", factor, low=1e-6)
    if not catalogue.actuators:
        raise BadInput("the catalogue is empty", allowed="at least one servo")
    return Sizing(loads, catalogue, factor, fits(loads, catalogue.actuators))


def shown_factor(value: float) -> str:
    """A safety factor for people."""
    return "–" if np.isinf(value) else f"{value:.2f}"


def _cell(text: str) -> str:
    """A word for a CSV file, in quotes where it has to be."""
    clean = " ".join(text.split())
    return '"' + clean.replace('"', '""') + '"' if any(c in clean for c in ',"') else clean
