"""What each number of the robot may be off by: tolerances by name, by pattern, by kind."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from pollard_pin.study.accuracy.parameters import (
    ASKED_ONLY,
    COLUMNS,
    KINDS,
    PARAMETERS,
    Parameter,
    Unit,
)
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput, UnknownName
from thesis_pin.numeric.checks import choice, real
from thesis_pin.tolerances import TOLERANCES

Distribution = Literal["uniform", "normal", "ends"]
DISTRIBUTIONS: tuple[str, ...] = get_args(Distribution)

DEVIATION: dict[str, float] = {"uniform": 1 / math.sqrt(3), "normal": 1 / 3, "ends": 1.0}
"""Standard deviation of a number over its tolerance: anything within it is as likely, it is three
standard deviations, or it is at one end or the other, as play under load."""

UNITS: dict[Unit, float] = {"mm": 1e-3, "deg": math.pi / 180}
"""What tolerances are written in, in SI."""

LENGTH_MM, ANGLE_DEG = 0.1, 0.1
"""Tolerances of everything where none are given."""

PLAYS = ("play", "backlash")
"""Kinds that are at one end or the other, unless something else is said."""


@dataclass(frozen=True)
class Tolerance(Brief):
    """What one number may be off by.

    Attributes:
        parameter: Which.
        size: To either side [m], [rad].
        distribution: How it is drawn.
    """

    parameter: Parameter
    size: float
    distribution: Distribution = "uniform"

    @property
    def written(self) -> float:
        """Its size in mm or degrees."""
        return self.size / UNITS[self.parameter.unit]


@dataclass(frozen=True)
class Tolerances(Brief):
    """What a robot's numbers may be off by; those that aren't named are exact.

    Attributes:
        each: Those that aren't zero, in the order of the parameters.
        source: Where they are from.
        notes: What was chosen for the user.
    """

    each: tuple[Tolerance, ...]
    source: str
    notes: tuple[str, ...] = ()

    @cached_property
    def columns(self) -> np.ndarray:
        """Column of each, shape ``(k,)``."""
        return np.array([one.parameter.column for one in self.each], dtype=np.intp)

    @cached_property
    def sizes(self) -> np.ndarray:
        """Size of each [m], [rad], shape ``(k,)``."""
        return np.array([one.size for one in self.each])

    @cached_property
    def deviations(self) -> np.ndarray:
        """Standard deviation of each [m], [rad], shape ``(k,)``."""
        return self.sizes * [DEVIATION[one.distribution] for one in self.each]

    @property
    def kinds(self) -> dict[str, np.ndarray]:
        """Kind → which of them are of it, for those that there are."""
        found = {
            kind: np.flatnonzero([one.parameter.kind == kind for one in self.each])
            for kind in KINDS
        }
        return {kind: some for kind, some in found.items() if some.size}

    def times(self, factor: float) -> Tolerances:
        """The same, all of them so much wider."""
        each = tuple(replace(one, size=one.size * factor) for one in self.each)
        return replace(self, each=each)

    def whole(self, errors: np.ndarray) -> np.ndarray:
        """Errors of each ``(k, ...)`` as those of all columns ``(m, ...)``."""
        found = np.zeros((len(COLUMNS), *errors.shape[1:]))
        np.add.at(found, self.columns, errors)
        return found

    def drawn(self, seed: int, draws: Iterable[int]) -> np.ndarray:
        """Errors of drawn robots; seed and number alone determine one.

        Returns:
            [m], [rad], shape ``(k, d)``.
        """
        normal = np.array([one.distribution == "normal" for one in self.each])
        ends = np.array([one.distribution == "ends" for one in self.each])
        rows = []
        for draw in draws:
            rng = np.random.default_rng([seed, draw])
            flat, bell = rng.uniform(-1.0, 1.0, len(self.each)), rng.normal(size=len(self.each))
            share = np.where(normal, bell / 3, np.where(ends, np.sign(flat), flat))
            rows.append(share * self.sizes)
        return np.array(rows).reshape(-1, len(self.each)).T


@dataclass(frozen=True)
class Rule:
    """A tolerance that is asked for.

    Attributes:
        pattern: A parameter's name, a pattern of names (``x_8*``), or a kind (``axes``).
        size: In ``unit``.
        unit: ``mm`` or ``deg``.
        distribution: How it is drawn; None for the usual one.
        where: File and line, for messages.
    """

    pattern: str
    size: float
    unit: Unit
    distribution: Distribution | None = None
    where: str = ""


def default_tolerances(distribution: Distribution = "uniform") -> Tolerances:
    """±0.1 mm of every length and ±0.1° of every angle, play aside: ours, the thesis has none."""
    rules = [Rule("*", LENGTH_MM, "mm"), Rule("*", ANGLE_DEG, "deg")]
    notes = (
        f"no tolerances are given: ±{LENGTH_MM:g} mm of every length and ±{ANGLE_DEG:g}° of every "
        "angle are ours; no play, no backlash",
    )
    return tolerances(rules, distribution, source="default", notes=notes)


def tolerances(
    rules: Iterable[Rule],
    distribution: Distribution = "uniform",
    *,
    source: str = "as given",
    notes: tuple[str, ...] = (),
) -> Tolerances:
    """Tolerances from rules, of which a later one comes before an earlier one.

    Args:
        rules: What is asked for.
        distribution: Of those that don't say theirs and aren't play.
        source: Where they are from.
        notes: What was chosen.

    Raises:
        UnknownName: A pattern fits no name.
        BadInput: A size is negative, too large, or in the wrong unit; or nothing is off.
    """
    choice("distribution", distribution, DISTRIBUTIONS)
    found: dict[Parameter, Tolerance] = {}
    for rule in rules:
        for parameter in fitting(rule):
            usual: Distribution = "ends" if parameter.kind in PLAYS else distribution
            size = rule.size * UNITS[rule.unit]
            found[parameter] = Tolerance(parameter, size, rule.distribution or usual)
    each = tuple(found[one] for one in PARAMETERS if one in found and found[one].size > 0)
    if not each:
        raise BadInput(
            "no tolerance is above zero, so that nothing is off",
            where=source,
            allowed="at least one",
        )
    return Tolerances(each, source, notes)


def fitting(rule: Rule) -> list[Parameter]:
    """The parameters that a rule is for.

    Raises:
        UnknownName: There is none.
        BadInput: They are of the other unit, or its size can't be.
    """
    choice("unit", rule.unit, tuple(UNITS))
    most = TOLERANCES.widest_length if rule.unit == "mm" else TOLERANCES.widest_angle
    try:
        real("a tolerance", rule.size, low=0.0, high=most / UNITS[rule.unit], unit=rule.unit)
    except BadInput as error:
        raise BadInput(error.what, where=rule.where, allowed=error.allowed) from None
    if rule.distribution is not None:
        choice("distribution", rule.distribution, DISTRIBUTIONS)
    named = [one for one in PARAMETERS if _fits(rule.pattern, one)]
    if not named:
        raise UnknownName(
            "parameter", rule.pattern, (*KINDS, *(one.name for one in PARAMETERS)), where=rule.where
        )
    found = [one for one in named if one.unit == rule.unit]
    if not found:
        raise BadInput(
            f"{rule.pattern} has a tolerance in {rule.unit}",
            where=rule.where,
            allowed=f"{named[0].unit}, for {named[0].name} ({named[0].words})",
        )
    return found


def _fits(pattern: str, parameter: Parameter) -> bool:
    """Whether a pattern means a parameter: by kind, by name, or by what follows its first dot."""
    pattern = pattern.strip().removesuffix("_deg")
    if pattern == parameter.kind:
        return True
    first, _, rest = parameter.name.partition(".")
    if parameter.kind in ASKED_ONLY:
        return pattern.partition(".")[0] == first and fnmatchcase(parameter.name, pattern)
    return fnmatchcase(parameter.name, pattern) or fnmatchcase(rest, pattern)
