"""Bipeds judged by the walk that is planned for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import cast

from scout_pin.study.plan.planning import plan_gait
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.results.judged import Judged
from scout_pin.study.plan.results.result import Plan
from scout_pin.study.sweeping.design import PLAN, robot_of, specification_text
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.sweep.measures import Measure, columns_of, row
from thesis_pin.sweep.study import Cell, Column


def _walked(plan: Plan) -> Judged | None:
    """What the report on the walk found; None where the request isn't met."""
    return plan.walk.judged if plan.walk is not None and plan.met else None


def _of(plan: Plan, name: str) -> float | None:
    judged = _walked(plan)
    return None if judged is None else float(getattr(judged, name))


def _speed(plan: Plan) -> float | None:
    return plan.cycle.speed if plan.met else None


MEASURES: tuple[Measure[Plan], ...] = (
    Measure(
        Column("met", what="there is a walk that keeps every limit asked for", kind="flag"),
        lambda plan: plan.met,
    ),
    Measure(Column("speed", "m/s", "of the walk", "more"), _speed),
    Measure(
        Column("step_length", "m", "from one footfall to the next", "more"),
        lambda plan: plan.cycle.pace.step_length if plan.met else None,
    ),
    Measure(
        Column("step_time", "s", "from one footfall to the next", "less"),
        lambda plan: plan.cycle.pace.step_time if plan.met else None,
    ),
    Measure(
        Column("margin", "m", "least distance of the ZMP inside the support polygon", "more"),
        lambda plan: _of(plan, "margin"),
    ),
    Measure(
        Column("servo_use", "", "largest use of a servo's torque-speed line", "less"),
        lambda plan: _of(plan, "line"),
    ),
    Measure(
        Column("torque_use", "", "largest share of a servo's stall torque", "less"),
        lambda plan: _of(plan, "torque"),
    ),
    Measure(
        Column("speed_use", "", "largest share of a servo's no-load speed", "less"),
        lambda plan: _of(plan, "speed"),
    ),
    Measure(
        Column("in_the_way", what="why there is no walk", kind="text"),
        lambda plan: "; ".join(plan.failures()) or None,
    ),
    Measure(
        Column("mass", "kg", "of the whole robot", "less"),
        lambda plan: plan.cycle.robot.specification.mass,
    ),
)
"""What a plan says of a design."""


@dataclass(frozen=True)
class PlanStudy(Brief):
    """A walk planned for every design; see :func:`scout_pin.study.sweeping.making.plan_study`.

    Attributes:
        base: The specification's data, and those of the request under ``plan``.
        steps: Steps of the walk.
        samples: Evenly spaced samples at which its reports judge.
        inertia: Reading of the inertias.
    """

    base: Mapping[str, object]
    steps: int
    samples: int
    inertia: Reading
    feasible: str = "met"
    aims: tuple[str, str] = ("speed", "servo_use")

    @property
    def columns(self) -> tuple[Column, ...]:
        """What is found of each design."""
        return columns_of(MEASURES)

    @property
    def inputs(self) -> Mapping[str, object]:
        """Everything that decides the rows but for the base, JSON-ready."""
        return {
            "robot": str(self.base["name"]),
            "judge": "a planned walk",
            "steps": self.steps,
            "samples": self.samples,
            "inertia": self.inertia,
        }

    def judge(self, data: object) -> Mapping[str, Cell]:
        """The columns of one design: those of its plan."""
        return row(MEASURES, self.plan(data))

    def plan(self, data: object) -> Plan:
        """The plan of one design.

        Args:
            data: The base with the design's values.
        """
        parts = cast(Mapping[str, object], data)
        robot = robot_of(parts, self.inertia)
        request = request_of(cast(Mapping[str, object], parts[PLAN]))
        return plan_gait(robot, request, steps=self.steps, samples=self.samples, instead=False)

    def written(self, data: object, notes: Sequence[str]) -> Mapping[str, bytes]:
        """The design as a specification; what was asked of its walk stands at its top."""
        parts = cast(Mapping[str, object], data)
        usual = PlanRequest().document()
        asked = {
            key: value
            for key, value in cast(Mapping[str, object], parts[PLAN]).items()
            if value is not None and value != usual[key]
        }
        said = ", ".join(f"{key} = {value}" for key, value in asked.items())
        walk = f"Its walk was planned with {said or 'the usual request'} [SI], {self.steps} steps."
        return {"best.toml": specification_text(parts, [*notes, walk]).encode()}


def request_of(values: Mapping[str, object]) -> PlanRequest:
    """A request of the values of its fields in SI.

    Raises:
        BadInput: They make none.
    """
    given = {key: tuple(v) if isinstance(v, list) else v for key, v in values.items()}
    if given.get("line_reserve") is None:
        given.pop("line_reserve", None)
    try:
        return PlanRequest(**given)  # type: ignore[arg-type]
    except TypeError as error:
        raise BadInput(f"no walk can be asked for so: {error}", where="plan") from None
