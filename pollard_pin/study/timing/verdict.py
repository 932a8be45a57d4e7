"""The answer to how fast a path can be followed, in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from pollard_pin.study.timing.timed import TimedPath
from thesis_pin.timing.binding import FREE

_SOME = 0.005  # share of the time from which a limit is told
_TOLD = 5


def verdict(timed: TimedPath, binding: Mapping[str, float]) -> list[str]:
    """The answer in sentences, the most important first.

    Args:
        timed: A law of motion.
        binding: On which share of its time each limit binds.
    """
    return [_answer(timed), _kept(timed), *_bound(binding)]


def _answer(timed: TimedPath) -> str:
    name = timed.course.robot.specification.name.capitalize()
    seconds, tool = f"{timed.duration:.4g} s", timed.tool_speed
    on = f"{name} on {timed.course.path.name}"
    if timed.aim == "fastest":
        return (
            f"{on}: {seconds} from rest to rest is the fastest within these limits; halving the "
            f"grid's steps once more would save about {max(timed.solved.gain, 0.0):.1%}."
        )
    if timed.aim == "constant-speed":
        return (
            f"{on}: {timed.speed:.4g} m/s is the largest constant tool speed within these limits, "
            f"from beginning to end without a rest; it takes {seconds}."
        )
    if timed.aim == "window":
        window, share = 100 * (timed.window or 0.0), 100 * (timed.share or 0.0)
        return (
            f"{on}: {seconds} from rest to rest at a tool speed of {timed.speed:.4g} m/s, kept "
            f"within {window:.3g}% of itself on {share:.3g}% of the way and never exceeded; "
            f"elsewhere limits bind or the motion rests, and it falls to {tool.min():.3g} m/s."
        )
    what = "torque–speed line" if timed.limits.line else "torque limit"
    return (
        f"{on}: in {seconds} from rest to rest no motor needs more than "
        f"{timed.largest_torque_share:.1%} of its {what}, and no law of that duration asks "
        "for less (measured by the largest share of any motor)."
    )


def _kept(timed: TimedPath) -> str:
    use = timed.solved.use
    k = int(np.argmax(use.peak))
    when = float(np.interp(use.place[k], timed.law.place, timed.law.time))
    looked = f"{use.points} points between any two of {len(timed.law.place)} places"
    peak = f"{use.peak[k]:.2%} (the {use.names[k]}, t = {when:.4g} s)"
    if not timed.within_limits:
        return f"The law doesn't keep its limits: at {looked} it uses up to {peak} of one."
    return f"At {looked} it uses at most {peak} of any limit."


def _bound(binding: Mapping[str, float]) -> Iterator[str]:
    named = [
        f"{name} ({share:.0%})"
        for name, share in binding.items()
        if name != FREE and share >= _SOME
    ]
    if named:
        more = f" and {len(named) - _TOLD} more" if len(named) > _TOLD else ""
        yield f"What binds, by shares of the time: {', '.join(named[:_TOLD])}{more}."
