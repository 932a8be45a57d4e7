"""A replay's answer in plain sentences."""

from __future__ import annotations

import numpy as np

from pollard_pin.study.simulate.result import Outcome
from thesis_pin.tolerances import TOLERANCES

_UNSTABLE = 1e3
"""Factor by which errors have to grow until growth explains why the tool leaves its path."""


def sentences(simulation: Outcome) -> list[str]:
    """The verdict, the most important first: answer, draws, end, what fails and why, what holds."""
    criteria = simulation.criteria
    return [
        "PASS: the simulated robot does what was planned."
        if simulation.passed
        else "FAIL: the simulated robot doesn't do what was planned.",
        *_draws(simulation),
        *_ending(simulation),
        *(one.said for one in criteria if not one.met),
        *reason(simulation),
        *(one.said for one in criteria if one.met),
    ]


def reason(simulation: Outcome) -> list[str]:
    """Why the tool leaves its path, where errors that grow explain it."""
    replay, grown = simulation.replay, simulation.prepared.growth
    if replay.left is None or grown.factor[-1] < np.log(_UNSTABLE):
        return []
    each = grown.time[-1] / grown.factor[-1]
    text = (
        "The reason: nothing corrects errors, and this motion lets them grow, as a pendulum on its "
        f"head does; by the linearised mechanism by a factor of e each {each:.3f} s, by "
        f"10^{grown.factor[-1] / np.log(10):.0f} over the path"
    )
    if replay.slope is not None:
        text += f" (seen: a factor of e each {1 / replay.slope:.3f} s)"
    horizon = grown.horizon(TOLERANCES.replay_deviation)
    if horizon is not None:
        text += (
            f". Even the rounding of numbers of 16 digits becomes a millimetre in {horizon:.1f} s, "
            "so that no engine follows longer than that"
        )
    return [f"{text}. Servos end it: give their stiffness."]


def _ending(simulation: Outcome) -> list[str]:
    when, why = simulation.replay.ended
    whole = simulation.report.path.duration
    return [f"The replay ends at t = {when:.3f} s of {whole:g} s: {why}."] if why else []


def _draws(simulation: Outcome) -> list[str]:
    draws = simulation.draws
    if not draws:
        return []
    good, deviation = sum(not one.failed for one in draws), [one.deviation for one in draws]
    return [
        f"{good} of {len(draws)} robots with drawn errors pass; their tools leave the path by "
        f"{np.median(deviation) * 1e3:.3g} mm in the median, {max(deviation) * 1e3:.3g} mm at "
        "most. What follows is of the first."
    ]
