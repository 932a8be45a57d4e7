"""Why a request can't be met, and which ones next to it can."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from scout_pin.study.plan.cycles.feet import least_spacing
from scout_pin.study.plan.cycles.problem import Unknowns
from scout_pin.study.plan.cycles.search import FAR, Candidate, Search
from scout_pin.study.plan.cycles.starts import SHARE, starts
from scout_pin.study.plan.limits import KINDS, Worst
from scout_pin.study.plan.request import GAP, PlanRequest
from thesis_pin.errors import ThesisPinError

_SHARES = (0.5, 0.25, 0.1)  # of a length, speed or margin that are tried
_HALVINGS = 4
_REACH = frozenset({"knee", "lower", "upper", "posture"})
_BINDING = 0.02  # how near to a limit a compromise presses against it

ALTERNATIVES = 6 + 4 * (1 + _HALVINGS)
"""Descents at most, or so."""


@dataclass(frozen=True)
class Binding:
    """A limit that stands in the way.

    Attributes:
        alone: Whether all would be well if it alone gave way.
        worst: By how much it is passed then, and where; if that isn't enough, by how much it is
            passed where all limits give way together, or how near it is.
    """

    alone: bool
    worst: Worst


@dataclass(frozen=True)
class Shortfall:
    """Why a request wasn't met.

    Attributes:
        binding: What stands in the way; first what would be enough alone, and of that what
            gives way least.
        nearest: Requests that can be met, each with one thing changed, by the name of that field.
    """

    binding: tuple[Binding, ...]
    nearest: dict[str, PlanRequest]


def shortfall(search: Search, request: PlanRequest, found: Candidate) -> Shortfall:
    """Find out why a request isn't met.

    Args:
        search: Where it was searched.
        request: What was asked for.
        found: The cycle that passes limits least.
    """
    far = found.most > FAR
    binding = (_unreached(search, request, found) if far else []) or _near(
        search, request, found, most=1 if far else len(KINDS)
    )
    nearest = {}
    for name, change in _changes(search, request):
        if (met := _nearest(search, found, change)) is not None:
            nearest[name] = met
    return Shortfall(tuple(binding), nearest)


def _near(search: Search, request: PlanRequest, found: Candidate, most: int) -> list[Binding]:
    """Limits that would do alone if they gave way, then those that a compromise presses against.

    Of limits only so many are tried alone.
    """
    binding = []
    for k, one in enumerate(found.worsts()):
        if one.excess <= -_BINDING:
            continue
        others = frozenset(KINDS) - {one.kind}
        there = _attempt(search, request, found, others) if k < most else None
        if there is not None and there.keeps(others):
            passed = next(w for w in there.worsts() if w.kind == one.kind)
            binding.append(Binding(True, passed))
        else:
            binding.append(Binding(False, one))
    return sorted(binding, key=lambda b: (not b.alone, b.worst.excess * (1 if b.alone else -1)))


def _unreached(search: Search, request: PlanRequest, found: Candidate) -> list[Binding]:
    """By how much the legs don't reach even if nothing else counts; nothing if they do."""
    reach = _attempt(search, request, found, _REACH)
    if reach is None or reach.keeps(_REACH):
        return []
    passed = [one for one in reach.worsts() if one.kind in _REACH and one.excess > 0.0]
    return [Binding(False, one) for one in passed]


def _changes(
    search: Search, request: PlanRequest
) -> list[tuple[str, Callable[[float], PlanRequest]]]:
    """What may be changed of a request: its name, and how to a share of it."""
    length = request.first_length
    time = length / request.walking_speed
    found: list[tuple[str, Callable[[float], PlanRequest]]] = []
    if request.free_length:
        speed = request.walking_speed
        found.append(("speed", lambda share: request.changed(speed=share * speed)))
    else:
        fixed = request.changed(step_length=length, step_time=time, speed=None)
        found.append(("step_length", lambda share: fixed.changed(step_length=share * length)))
        found.append(("step_time", lambda share: fixed.changed(step_time=time / share)))
    if request.margin > 0.0:
        margin = request.margin
        found.append(("margin", lambda share: request.changed(margin=share * margin)))
    given, usual = request.foot_spacing, least_spacing(search.sampler.robot) + GAP
    if given is not None and given > usual:
        found.append(
            (
                "foot_spacing",
                lambda share: request.changed(foot_spacing=usual + share * (given - usual)),
            )
        )
    return found


def _nearest(
    search: Search, found: Candidate, change: Callable[[float], PlanRequest]
) -> PlanRequest | None:
    """The request that can be met with the largest share; None if none of them can."""
    met, low, high = None, 0.0, 1.0
    for share in _SHARES:
        met = _fresh(search, change(share), found)
        if met is not None:
            low = share
            break
        high = share
    if met is None:
        return None
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        there = _attempt(search, change(middle), met)
        if there is not None and there.kept:
            met, low = there, middle
        else:
            high = middle
    return met.request


def _fresh(search: Search, request: PlanRequest, found: Candidate) -> Candidate | None:
    """A cycle that keeps a request's limits, from what was found or from the first start."""
    length = request.first_length
    first = next(starts(search.build, search.steps, search.cyclic, length))
    beginnings = [found.known, Unknowns(first, SHARE, length)]
    for known in beginnings if found.most <= FAR else beginnings[1:]:
        there = _attempt(search, request, replace(found, known=known))
        if there is not None and there.kept:
            return there
    return None


def _attempt(
    search: Search,
    request: PlanRequest,
    start: Candidate,
    held: frozenset[str] = frozenset(KINDS),
) -> Candidate | None:
    """What a descent leads to; None where nothing can be said."""
    try:
        return search.solved(request, start.known, held=held)
    except (ThesisPinError, ArithmeticError):
        return None
