"""Requests next to one that can't be met: one thing of it changed, as little as was found."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, ROUND_DOWN, Context
from types import MappingProxyType

from scout_pin.study.plan.cycles.feet import Steps
from scout_pin.study.plan.cycles.problem import Unknowns
from scout_pin.study.plan.cycles.search import ATTEMPTS, FAR, Candidate, Search
from scout_pin.study.plan.cycles.starts import SHARE, starts
from scout_pin.study.plan.limits import KINDS
from scout_pin.study.plan.request import LEAST, STEP_TIME, PlanRequest
from thesis_pin.errors import BadInput, ThesisPinError

_SHARES = (0.5, 0.25, 0.1)  # of a length, speed or margin that are tried
_TINY = (0.01, 0.001)  # of one as far from what can be met as another unit makes it
_CLIMBS = 10  # from the first that is met towards what was asked for
_FIRST, _FINE = 0.16, 0.02  # relative steps of it: the first one, and when it is given up
_FASTER, _SLOWER = 1.5, 0.4
_SAFE = 0.6  # of what was met from nearby, what is searched anew first
_LARGER = {1.0: 9 / 10, 0.85: 1 / 2}
"""Shares of it that are searched anew then; of the steps there are, what each may take."""

OFFERS = 4 * (2 * len(_SHARES) + _CLIMBS + ATTEMPTS)
"""Descents at most, or so."""


@dataclass(frozen=True)
class Change:
    """One thing of a request that may be less ambitious.

    Attributes:
        name: The field of the request.
        value: What it may be instead, by a share of the ambition that there was.
        unit: What one is in words and on the command line [SI].
        digits: Of it that are told.
        least: What is too little to be asked for [SI].
        up: Whether more is less ambitious.
    """

    name: str
    value: Callable[[float], float]
    unit: float = 1e-3
    digits: int = 4
    least: float = 1e-4
    up: bool = False

    def request(self, request: PlanRequest, share: float) -> PlanRequest | None:
        """The request with a share of the ambition, or a little less: to the digits that are told.

        Who asks for what is told then asks for the same to the last bit. None where so little,
        or so much, can't be asked for.
        """
        rounding = Context(self.digits, ROUND_CEILING if self.up else ROUND_DOWN)
        told = float(rounding.create_decimal(f"{self.value(share) / self.unit:.12g}"))
        try:
            changed = request.changed(**{self.name: told * self.unit})
        except BadInput:
            return None
        return changed if abs(told * self.unit) >= self.least else None


def changes(search: Search, request: PlanRequest) -> Iterator[Change]:
    """What may be changed of a request, so that all else that was said of it stays."""
    speed, time = request.speed, float(request.step_time or STEP_TIME)
    if speed is not None:
        yield Change("speed", lambda share: share * speed, least=1e-3)
    if (
        request.first_length
        and not request.free_length
        and (speed is None or request.step_time is None)
    ):
        yield Change("step_length", lambda share: share * request.first_length)
    if speed is None and request.objective != "fastest":
        yield Change("step_time", lambda share: time / share, unit=1.0, up=True)
    if request.margin > 0.0:
        yield Change("margin", lambda share: share * request.margin, digits=3)
    for name, unit in (("side", 1e-3), ("turn", math.pi / 180)):
        if amount := float(getattr(request, name)):
            yield Change(name, _of(amount), unit=unit, least=LEAST[name], digits=3)
    given = request.foot_spacing
    usual = Steps.of(search.sampler.robot, request.changed(foot_spacing=None)).across[1] * 2
    if given is not None and given > usual:
        yield Change("foot_spacing", lambda share: usual + share * (given - usual))


def _of(amount: float) -> Callable[[float], float]:
    return lambda share: share * amount


@dataclass(frozen=True)
class Offer:
    """What may be asked for instead.

    Attributes:
        change: The one thing that is changed.
        share: Of the ambition in it that was met from nearby.
        request: The request with the largest share that is met if asked for; None if none is yet.
    """

    change: Change
    share: float
    request: PlanRequest | None


def nearest(search: Search, request: PlanRequest, found: Candidate, change: Change) -> Offer | None:
    """How much of a request is met from nearby; and what is safe of that, searched anew.

    Args:
        search: Where it was searched.
        request: What was asked for.
        found: The cycle that passes limits least.
        change: What may be less of it.

    Returns:
        The offer; None if nothing was found.
    """
    begun = _begun(search, request, found, change)
    if begun is None:
        return None
    (low, there), step = begun, _FIRST
    # Little by little: what fails from afar is often met from nearby.
    for _ in range(_CLIMBS):
        share = low + min(low * step, (1.0 - low) / 2)
        asked = change.request(request, share)
        more = None if asked is None else attempt(search, asked, there.known)
        if more is not None and more.kept:
            low, there, step = share, more, _FASTER * step
        else:
            step = _SLOWER * (share / low - 1.0)
            if step < _FINE:
                break
    return raised(search, request, Offer(change, low, None), {_SAFE: 1 / 2})


def raised(
    search: Search,
    request: PlanRequest,
    offer: Offer,
    shares: Mapping[float, float] = MappingProxyType(_LARGER),
    most: float = 1.0,
) -> Offer:
    """An offer with the first of larger shares that is met anew, as not all from nearby are.

    Args:
        search: Where it was searched.
        request: What was asked for.
        offer: The offer.
        shares: Shares of what was met from nearby; of the steps it may take, what each may.
        most: Share of the steps that are left that all of it may take.
    """
    end = search.iterations + most * search.left
    for part, some in shares.items():
        asked = offer.change.request(request, part * offer.share)
        if asked is not None and _again(search, asked, some * (end - search.iterations)):
            return replace(offer, request=asked)
    return offer


def _begun(
    search: Search, request: PlanRequest, found: Candidate, change: Change
) -> tuple[float, Candidate] | None:
    """A share to begin with that is met, and its cycle; None if none was found."""
    tiny = _TINY if found.most > FAR else ()
    first, shares = None, (*_SHARES, *tiny)
    if not change.up:
        # Where hardly anything fails more needn't be tried; more of time isn't easier.
        shares = _SHARES[:-1]
        for share in (_SHARES[-1], *tiny):
            if there := _fresh(search, change.request(request, share), found):
                first = share, there
                break
        else:
            return None
    for share in shares:
        if there := _fresh(search, change.request(request, share), found):
            return share, there
    return first


def _again(search: Search, request: PlanRequest, most: float) -> bool:
    """Whether a request is met by who knows nothing of this search.

    Args:
        search: The search.
        request: The request.
        most: Steps after which it begins no further descent.
    """
    if most <= 0.0:
        return False
    anew = None
    try:
        anew = Search(search.sampler.robot, request, search.tick)
        anew.allowed = most
        return anew.first(request).kept
    except (ThesisPinError, ArithmeticError):
        return False
    finally:
        search.iterations += anew.iterations if anew else 0


def _fresh(search: Search, request: PlanRequest | None, found: Candidate) -> Candidate | None:
    """A cycle that keeps a request's limits, from what was found or from the first start."""
    if request is None:
        return None
    length = request.first_length
    first = next(starts(search.build, search.steps, search.cyclic, length))
    beginnings = [found.known, Unknowns(first, SHARE, length)]
    for known in beginnings if found.most <= FAR else beginnings[1:]:
        there = attempt(search, request, known)
        if there is not None and there.kept:
            return there
    return None


def attempt(
    search: Search,
    request: PlanRequest,
    start: Unknowns,
    held: frozenset[str] = frozenset(KINDS),
) -> Candidate | None:
    """What a descent leads to; None where nothing can be said, or enough was searched.

    Args:
        search: Where it is searched.
        request: What it is to be.
        start: Where to begin.
        held: Kinds of limits that count.
    """
    if search.spent:
        return None
    try:
        return search.solved(request, start, held=held)
    except (ThesisPinError, ArithmeticError):
        return None
