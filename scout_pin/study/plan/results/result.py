"""A plan as it is handed over: gaits, what judged them, what binds, or why there is none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from scout_pin.motion.gait import Gait
from scout_pin.report.document import GaitReport
from scout_pin.study.plan.cycle import CyclePlan
from scout_pin.study.plan.request import PlanRequest
from scout_pin.study.plan.results.judged import Judged
from scout_pin.study.plan.results.telling import nearest_words, passed_words, way_words
from scout_pin.study.plan.walks.transitions import Transition
from thesis_pin.display.brief import Brief
from thesis_pin.display.cell import Cell

BINDS = -0.03
"""How near to its limit something is that binds a plan, relative."""


@dataclass(frozen=True)
class Walk(Brief):
    """A whole walk from rest to rest.

    Attributes:
        gait: The walk.
        report: Its report.
        judged: What that found.
        margin: The margin it was planned with [m], at least 80 % of the asked one.
    """

    gait: Gait
    report: GaitReport
    judged: Judged
    margin: float

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return (self.gait.end - self.gait.start) * self.gait.time_unit


@dataclass(frozen=True)
class Plan(Brief):
    """What came of a request.

    Attributes:
        cycle: The cycle, and why there is none.
        steps: Steps of the walk.
        start, stop: What leads to the cycle and ends it; None if there is no cycle.
        judged: What the cycle's report found; None if there is no cycle.
        walk: The whole walk; None if there is no cycle, start or stop that keeps the limits.
    """

    cycle: CyclePlan
    steps: int
    start: Transition | None = None
    stop: Transition | None = None
    judged: Judged | None = None
    walk: Walk | None = None

    @property
    def request(self) -> PlanRequest:
        """What was asked for."""
        return self.cycle.request

    @property
    def gait(self) -> Gait:
        """The cycle."""
        return self.cycle.gait

    @property
    def met(self) -> bool:
        """Whether there is a walk, and its reports find every limit kept."""
        return not self.failures()

    def _cell(self) -> Cell:
        found = {"cycle": self.judged, "walk": self.walk.judged if self.walk else None}
        rows = [
            (
                name,
                f"{one.margin * 1e3:.2f} mm",
                f"{one.torque:.1%}",
                f"{one.speed:.1%}",
                f"{one.line:.1%}",
            )
            for name, one in found.items()
            if one is not None
        ]
        heads = ("", "ZMP margin", "torque of stall", "speed of no-load", "torque-speed line")
        return Cell("Plan of a walk", self.verdict(), self.met, heads, rows)

    @property
    def interrupted(self) -> bool:
        """Whether it is the best that there was when it was interrupted."""
        return self.cycle.interrupted

    def failures(self) -> list[str]:
        """Why the request isn't met, in words; empty if it is."""
        return list(self._failures())

    def _failures(self) -> Iterator[str]:
        if self.judged is None or self.start is None or self.stop is None:
            yield from self._short()
            return
        for name, judged, margin in (
            ("the cycle", self.judged, self.request.margin),
            ("the walk", *((self.walk.judged, self.walk.margin) if self.walk else (None, 0.0))),
        ):
            if judged is not None:
                yield from (f"{name}: {why}" for why in judged.failures(self.request, margin))
        for name, part in (("start from rest", self.start), ("stop at rest", self.stop)):
            if not part.kept:
                yield f"no {name} was found that keeps {passed_words(part.worst[0])}"

    def _short(self) -> Iterator[str]:
        shortfall = self.cycle.shortfall
        if shortfall is None or not shortfall.binding:
            yield f"no walk was found that keeps {passed_words(self.cycle.worst[0])}"
            return
        for one in shortfall.binding:
            if one.alone:
                yield f"all other limits could be kept but for {passed_words(one.worst)}"
            elif one.worst.excess > 0.0:
                yield f"what was found passes {passed_words(one.worst)}"
            else:
                yield f"what was found presses against {passed_words(one.worst)}"

    def verdict(self) -> list[str]:
        """The answer in plain sentences, the most important first."""
        name = self.cycle.robot.specification.name.capitalize()
        judged, walk = self.judged, self.walk
        if judged is None or walk is None or not self.met:
            said = [f"{name} can't walk as asked, as far as was found."]
            said += [f"{why[0].upper()}{why[1:]}." for why in self.failures()]
            return said + list(self._instead())
        pace, steps = self.cycle.pace, self.cycle.candidate.problem.steps
        how = (
            f"walks {pace.step_length * 1e3:.4g} mm a step of {pace.step_time:.4g} s, "
            f"{self.cycle.speed * 1e3:.4g} mm/s"
            if self.cycle.way.straight
            else f"goes {way_words(pace, steps)} in two steps of {pace.step_time:.4g} s each"
        )
        said = [
            f"{name} {how}, with both feet on the floor for {pace.share:.0%} of it.",
            f"As a cycle: {self._numbers(judged)}.",
            f"From rest to rest, {self.steps} {'step' if self.steps == 1 else 'steps'} in "
            f"{walk.duration:.4g} s: {self._numbers(walk.judged)}.",
        ]
        binds = [one for one in self.cycle.worst if one.excess > BINDS]
        if binds:
            said.append(f"What binds: {'; '.join(map(passed_words, binds))}.")
        if walk.margin < self.request.margin:
            said.append(f"Start and stop were planned with a margin of {walk.margin * 1e3:.3g} mm.")
        if self.interrupted:
            said.append("The search was interrupted; this is the best so far.")
        return said

    def _instead(self) -> Iterator[str]:
        if self.cycle.shortfall is not None:
            words = nearest_words(self.request, self.cycle.shortfall.nearest)
            yield (
                f"It could be met with {' or with '.join(words)}."
                if words
                else "No request next to it was found that can be met."
            )
        elif self.cycle.met:
            yield "The cycle itself keeps its limits; slower steps or less margin make both easier."

    def _numbers(self, judged: Judged) -> str:
        line = f", torque-speed line up to {judged.line:.1%} ({judged.line_joint})"
        return (
            f"margin at least {judged.margin * 1e3:.2f} mm, torques up to {judged.torque:.1%} of "
            f"stall ({judged.torque_joint}), rates up to {judged.speed:.1%} of no-load speed{line}"
        )
