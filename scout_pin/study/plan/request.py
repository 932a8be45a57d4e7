"""What a walk is asked to be: every choice of a plan, with its default."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Literal, get_args

import numpy as np

from scout_pin.kinematics.branches import branch_words
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, real, shown

Objective = Literal["limits", "least_torque", "fastest", "largest_margin"]
OBJECTIVES: tuple[str, ...] = get_args(Objective)

STEP_LENGTH = 0.030
"""Length of a step where nobody says [m]."""

STEP_TIME = 0.8
"""Time of a step where nobody says [s]."""

GAP = 0.012
"""Room between the soles where nobody says how far apart the feet are [m]: servos whose zeros
are off by a degree bring them nearer by some millimetres."""

LINE_RESERVE = 0.1
"""Share of the servos' torque-speed line that isn't used, where nobody says."""

FASTEST_LINE_RESERVE = 0.05
"""The same of the fastest walk, whose rotors may need some more."""

RANGES: dict[str, tuple[float, float, str]] = {
    **dict.fromkeys(("step_length", "foot_spacing", "lift"), (1e-4, 10.0, "m")),
    "side": (-10.0, 10.0, "m"),
    "turn": (-math.pi, math.pi, "rad"),
    "margin": (0.0, 10.0, "m"),
    "step_time": (0.01, 100.0, "s"),
    "speed": (1e-4, 10.0, "m/s"),
    **dict.fromkeys(("torque_reserve", "speed_reserve", "line_reserve"), (0.0, 0.95, "")),
    **dict.fromkeys(("pitch", "roll", "yaw"), (1e-4, 1.5, "rad")),
    "knee": (math.radians(1.0), math.radians(80.0), "rad"),
    "friction": (1e-6, math.inf, ""),
}
"""Least and greatest value of each number of a request, and its unit."""

LEAST = {"side": 1e-4, "turn": math.radians(0.5)}
"""What is too little of a way aside [m], or round [rad], to be meant; zero is none."""

_OPEN = frozenset({"step_length", "foot_spacing", "step_time", "speed", "line_reserve", "friction"})
"""Those that may be left open."""


@dataclass(frozen=True)
class PlanRequest(Brief):
    """What a walk is asked to be.

    Attributes:
        step_length: Way from one footfall to the next [m]; None for 30 mm, for none where it goes
            aside or round, or for what suits best where a speed is given or ``objective`` is
            ``"fastest"``.
        side: Way aside of two steps, to the right [m]; to the left it is negative.
        turn: Turn of two steps, to the left [rad]; to the right it is negative. A way ahead or
            aside goes round with it: it is the length of an arc.
        step_time: Time from one footfall to the next [s]; None for 0.8 s, or for what the speed
            says.
        speed: Of the walk [m/s], instead of ``step_time``.
        foot_spacing: Distance of the soles' origins across where the feet stand side by side [m];
            None leaves 12 mm between the soles where they come nearest.
        lift: How high the swinging foot goes [m].
        margin: Least distance of the zero-moment point inside the support polygon [m].
        torque_reserve: Share of the servos' stall torque that isn't used.
        speed_reserve: Share of the servos' no-load speed that isn't used.
        servo_line: Whether the servos' torque-speed line |τ|/τ_stall + |θ̇|/ω_no-load ≤ 1 is kept
            too.
        line_reserve: Share of that line that isn't used; None for 10 %, of the fastest walk for
            5 %. Rotors and gears that the specification says nothing of need some of it.
        pitch, roll, yaw: How far the torso may turn either way [rad].
        height: Least and greatest height of the torso's origin [m]; None for 80 to 100 % of that
            in the neutral pose.
        friction: Friction coefficient; None for the specification's.
        knee: Least angle of a knee from straight or folded [rad].
        branch: How the legs stand, as :meth:`scout_pin.Scout.inverse_kinematics` takes it; None
            for what the specification says, else the shape nearest the neutral pose.
        objective: ``"limits"`` for any walk that keeps them; or the one of these with the
            ``"least_torque"``, the ``"fastest"``, or the ``"largest_margin"``.
    """

    step_length: float | None = None
    side: float = 0.0
    turn: float = 0.0
    step_time: float | None = None
    speed: float | None = None
    foot_spacing: float | None = None
    lift: float = 0.015
    margin: float = 0.010
    torque_reserve: float = 0.1
    speed_reserve: float = 0.1
    servo_line: bool = True
    line_reserve: float | None = None
    pitch: float = math.radians(15.0)
    roll: float = math.radians(15.0)
    yaw: float = math.radians(12.0)
    height: tuple[float, float] | None = None
    friction: float | None = None
    knee: float = math.radians(10.0)
    branch: str | None = None
    objective: Objective = "limits"

    def __post_init__(self) -> None:
        """Refuse what can't be meant.

        Raises:
            BadInput: Says which field, what is allowed and how to mend it.
        """
        for name, (low, high, unit) in RANGES.items():
            if (value := getattr(self, name)) is not None or name not in _OPEN:
                real(name, value, low=low, high=high, unit=unit)
        for name, least in LEAST.items():
            if 0.0 < abs(value := getattr(self, name)) < least:
                raise BadInput(
                    f"{name} is {value:g} {RANGES[name][2]}",
                    allowed=f"0, or at least {least:.3g} {RANGES[name][2]} either way",
                )
        if not isinstance(self.servo_line, bool | np.bool_):
            raise BadInput(f"servo_line is {shown(self.servo_line)}", allowed="True or False")
        choice("objective", self.objective, OBJECTIVES)
        if self.line_reserve is None:
            usual = FASTEST_LINE_RESERVE if self.objective == "fastest" else LINE_RESERVE
            object.__setattr__(self, "line_reserve", usual)
        branch_words(self.branch)
        self._check_height()
        self._check_speed()

    def _check_height(self) -> None:
        if self.height is None:
            return
        if not isinstance(self.height, tuple | list) or len(self.height) != 2:
            raise BadInput(f"height is {shown(self.height)}", allowed="least and greatest [m]")
        low, high = (real("height", one, low=1e-3, high=10.0, unit="m") for one in self.height)
        if not low < high:
            raise BadInput(
                f"height is from {low:g} to {high:g} m", allowed="the least below the greatest"
            )
        object.__setattr__(self, "height", (low, high))

    def _check_speed(self) -> None:
        said = [name for name in ("step_length", "step_time", "speed") if getattr(self, name)]
        if len(said) == 3:
            raise BadInput(
                "step_length, step_time and speed are all given",
                allowed="two of them",
                remedy="Leave one out: it follows from the others",
            )
        if self.objective == "fastest" and (self.step_time or self.speed):
            raise BadInput(
                f"{said[-1]} is given, and the fastest walk is asked for",
                allowed="either",
                remedy=f"Leave {said[-1]} or the objective out",
            )

    @property
    def free_length(self) -> bool:
        """Whether the step's length is the planner's to choose."""
        chosen = self.speed is not None and self.step_time is None
        return self.step_length is None and (chosen or self.objective == "fastest")

    @property
    def aside(self) -> bool:
        """Whether it goes aside or round, too or only."""
        return bool(self.side or self.turn)

    @property
    def first_length(self) -> float:
        """Length of a step [m]; where it is free, what the search begins with."""
        if self.step_length is not None:
            return float(self.step_length)
        if self.aside and self.speed is None and not self.free_length:
            return 0.0
        if self.speed is not None and self.step_time is not None:
            return self.speed * self.step_time
        return STEP_LENGTH

    @property
    def walking_speed(self) -> float:
        """Speed of the walk [m/s]; of the fastest what the search begins with."""
        if self.speed is not None:
            return float(self.speed)
        return self.first_length / float(self.step_time or STEP_TIME)

    def changed(self, **values: object) -> PlanRequest:
        """The same request with other values."""
        return replace(self, **values)  # type: ignore[arg-type]

    def document(self) -> dict[str, object]:
        """JSON-ready: every field in SI units."""
        found = {one.name: getattr(self, one.name) for one in fields(self)}
        if self.height is not None:
            found["height"] = list(self.height)
        return found
