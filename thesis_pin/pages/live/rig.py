"""What a page of sliders asks: which sliders there are, and where the robot goes by them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from thesis_pin.model.loading import LoadedRobot
from thesis_pin.pages.live.alone import Tree

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Slider:
    """One number that a reader can change.

    Attributes:
        name: What it moves.
        unit: In which it is shown: ``°``, ``mm`` or nothing.
        low, high: Its ends [rad], [m].
        group: Heading under which it stands.
        note: What there is to say of its ends; empty for nothing.
    """

    name: str
    unit: str
    low: float
    high: float
    group: str = ""
    note: str = ""

    @property
    def factor(self) -> float:
        """What is shown of one of its own unit."""
        return {"°": float(np.degrees(1.0)), "mm": 1e3}.get(self.unit, 1.0)


@dataclass(frozen=True, eq=False)
class Stand:
    """Where a robot stands.

    Attributes:
        state: What a page sends back to say from where it moves on.
        q: The configuration, shape ``(nq,)``.
        values: Of the sliders [rad], [m].
        marks: What there is to say of each slider, as that its joint is at a limit.
        levels: Joints at a limit (0) or beyond it (1).
        notes: Why it isn't where it was asked to be.
        readouts: Labels and values.
        choice: Which of the choices.
        possible: Which of them would do.
    """

    state: tuple[float, ...]
    q: Array
    values: tuple[float, ...]
    marks: tuple[str, ...] = ()
    levels: Mapping[int, int] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    readouts: tuple[tuple[str, str], ...] = ()
    choice: int = 0
    possible: tuple[bool, ...] = ()


class Rig(Protocol):
    """A robot that sliders move."""

    @property
    def robot(self) -> LoadedRobot:
        """The robot."""

    @property
    def sliders(self) -> tuple[Slider, ...]:
        """Its sliders."""

    @property
    def choices(self) -> tuple[str, ...]:
        """Between what a reader may choose besides, as branches; empty for nothing."""

    def start(self) -> Stand:
        """Where it stands at first."""

    def moved(self, state: Array, slider: int, value: float) -> Stand:
        """Where it stands after a slider was moved.

        Args:
            state: A stand's, finite.
            slider: Which slider.
            value: Where to [rad], [m], between the slider's ends.
        """

    def chosen(self, state: Array, choice: int) -> Stand:
        """Where it stands with another choice."""

    def alone(self) -> Tree | str:
        """What a page needs that moves it without asking; or why none can, in words."""
