"""Why a request can't be met, and which ones next to it can."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby

from scout_pin.study.plan.cycles.nearest import OFFERS, Change, attempt, changes, nearest, raised
from scout_pin.study.plan.cycles.search import FAR, Candidate, Search
from scout_pin.study.plan.limits import KINDS, Worst
from scout_pin.study.plan.request import LEAST, PlanRequest

_REACH = frozenset({"knee", "lower", "upper", "posture"})
_BINDING = 0.02  # how near to a limit a compromise presses against it
_CLIMBING = 1 / 3  # of what may still be searched, what one change may take but for its proof

ALTERNATIVES = 6 + OFFERS
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
    search.allowed = search.iterations + search.left
    binding = (_unreached(search, request, found) if far else []) or _near(
        search, request, found, most=1 if far else len(KINDS)
    )
    wanted = list(changes(search, request))
    met: dict[str, PlanRequest | None] = dict.fromkeys(one.name for one in wanted)
    # What is seldom asked for is what fails, and more time seldom helps: it comes last, as there
    # may be no time for all of them.
    for _, alike in groupby(sorted(wanted, key=_rank), _rank):
        offers = []
        for one in alike:
            search.allowed = search.iterations + _CLIMBING * search.left
            if (offer := nearest(search, request, found, one)) is not None:
                offers.append(offer)
        for k, offer in enumerate(offers):
            larger = raised(search, request, offer, most=1 / (len(offers) - k))
            met[offer.change.name] = larger.request
    return Shortfall(tuple(binding), {name: one for name, one in met.items() if one is not None})


def _rank(change: Change) -> tuple[bool, bool]:
    return change.name not in LEAST, change.up


def _near(search: Search, request: PlanRequest, found: Candidate, most: int) -> list[Binding]:
    """Limits that would do alone if they gave way, then those that a compromise presses against.

    Of limits only so many are tried alone.
    """
    binding = []
    for k, one in enumerate(found.worsts()):
        if one.excess <= -_BINDING:
            continue
        others = frozenset(KINDS) - {one.kind}
        there = attempt(search, request, found.known, others) if k < most else None
        if there is not None and there.keeps(others):
            passed = next(w for w in there.worsts() if w.kind == one.kind)
            binding.append(Binding(True, passed))
        else:
            binding.append(Binding(False, one))
    return sorted(binding, key=lambda b: (not b.alone, b.worst.excess * (1 if b.alone else -1)))


def _unreached(search: Search, request: PlanRequest, found: Candidate) -> list[Binding]:
    """By how much the legs don't reach even if nothing else counts; nothing if they do."""
    reach = attempt(search, request, found.known, _REACH)
    if reach is None or reach.keeps(_REACH):
        return []
    passed = [one for one in reach.worsts() if one.kind in _REACH and one.excess > 0.0]
    return [Binding(False, one) for one in passed]
