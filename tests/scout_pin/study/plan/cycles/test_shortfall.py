"""Why a request isn't met, and how long anybody searches for it."""

import pytest

from scout_pin.study.plan.cycle import plan_cycle
from scout_pin.study.plan.cycles import nearest as near
from scout_pin.study.plan.cycles import search as searches
from scout_pin.study.plan.cycles import shortfall as module
from scout_pin.study.plan.cycles.nearest import Change, Offer, raised
from scout_pin.study.plan.cycles.search import Search
from scout_pin.study.plan.request import PlanRequest

FAST = PlanRequest(speed=3.0)


@pytest.fixture(scope="module")
def hopeless(scout):
    """A search for what can't be, and what it came to."""
    search = Search(scout, FAST, lambda: None)
    return search, search.first(FAST)


@pytest.fixture
def searched(hopeless):
    """The same, as it was before others went on with it."""
    search, found = hopeless
    used, allowed = search.iterations, search.allowed
    yield search, found, used
    search.iterations, search.allowed = used, allowed


def test_where_nothing_more_may_be_searched_the_reason_is_what_was_found(searched, monkeypatch):
    search, found, used = searched
    monkeypatch.setattr(searches, "AFFORDED", {1: used, 2: used})
    why = module.shortfall(search, FAST, found)
    assert search.iterations == used
    assert why.nearest == {}
    assert why.binding
    worst = {one.kind: one for one in found.worsts()}
    assert all(not one.alone and one.worst == worst[one.worst.kind] for one in why.binding)


def test_no_more_steps_are_taken_than_are_afforded_and_a_descent(searched, monkeypatch):
    search, found, used = searched
    monkeypatch.setattr(searches, "AFFORDED", {1: used + 100, 2: used + 100})
    module.shortfall(search, FAST, found)
    assert used < search.iterations < used + 100 + searches._ROUNDS * searches._TRIED


def test_what_is_met_needs_no_time_for_reasons(scout, monkeypatch):
    monkeypatch.setattr(searches, "AFFORDED", {1: 0, 2: 0})
    assert plan_cycle(scout, PlanRequest(margin=0.008)).met


def test_turns_come_first_and_slower_steps_last_of_what_may_be_offered(scout, monkeypatch):
    asked = []

    def nearest(search, request, found, change):
        asked.append((change.name, search.allowed - search.iterations, search.left))
        search.iterations += 100
        return Offer(change, 1.0, request)

    monkeypatch.setattr(module, "nearest", nearest)
    monkeypatch.setattr(module, "raised", lambda _search, _request, offer, **_: offer)
    monkeypatch.setattr(module, "_near", lambda *_, **__: [module.Binding])
    request = PlanRequest(turn=1.0, side=0.05, step_length=0.03)
    search = Search(scout, request, lambda: None)
    start = next(searches.starts(search.build, search.steps, search.cyclic, 0.03))
    found = search.solved(request, searches.Unknowns(start, searches.SHARE, 0.03), most=1)
    why = module.shortfall(search, request, found)
    names = [name for name, _, _ in asked]
    assert set(names[:2]) == {"turn", "side"}
    assert names[-1] == "step_time"
    assert list(why.nearest) == ["step_length", "step_time", "margin", "side", "turn"]
    for _, allowed, left in asked:
        assert allowed == pytest.approx(left / 3)


class Counted:
    """As much of a search as proofs ask for."""

    def __init__(self, left):
        self.iterations, self.end = 0, left

    @property
    def left(self):
        return self.end - self.iterations


@pytest.mark.parametrize(
    ("costs", "share", "asked"),
    [
        ({1.0: 300, 0.85: 10}, 1.0, [(1.0, 360.0)]),
        ({1.0: 370, 0.85: 10}, 0.85, [(1.0, 360.0), (0.85, 20.0)]),
        ({1.0: 370, 0.85: 30}, 0.6, [(1.0, 360.0), (0.85, 20.0)]),
    ],
)
def test_an_offer_grows_to_the_largest_share_that_the_steps_left_prove(
    monkeypatch, costs, share, asked
):
    """Where one isn't proven in its steps, what is left of them goes into less."""
    request, tried = PlanRequest(turn=0.5), []

    def again(search, asked, most):
        part = next(p for p in costs if asked.turn == pytest.approx(0.4 * p, rel=2e-3))
        tried.append((part, pytest.approx(most)))
        search.iterations += min(costs[part], most)
        return costs[part] <= most

    monkeypatch.setattr(near, "_again", again)
    change = Change("turn", lambda part: 0.5 * part)
    proven = change.request(request, 0.6 * 0.8)
    found = raised(Counted(400), request, Offer(change, 0.8, proven))
    assert found.request.turn == pytest.approx(0.4 * share, rel=2e-3)
    assert [(part, most.expected) for part, most in tried] == asked


def test_larger_offers_are_proven_when_all_of_a_kind_have_a_safe_one(scout, monkeypatch):
    told = []

    def nearest(search, request, found, change):
        told.append(("safe", change.name))
        return Offer(change, 1.0, request)

    def raised(search, request, offer, *, most):
        told.append((most, offer.change.name))
        return offer

    monkeypatch.setattr(module, "nearest", nearest)
    monkeypatch.setattr(module, "raised", raised)
    monkeypatch.setattr(module, "_near", lambda *_, **__: [])
    request = PlanRequest(turn=1.0, side=0.05)
    search = Search(scout, request, lambda: None)
    start = next(searches.starts(search.build, search.steps, search.cyclic, 0.03))
    found = search.solved(request, searches.Unknowns(start, searches.SHARE, 0.03), most=1)
    module.shortfall(search, request, found)
    both = [("safe", "side"), ("safe", "turn"), (1 / 2, "side"), (1.0, "turn")]
    assert told[:4] == both
    assert told[-2:] == [("safe", "step_time"), (1.0, "step_time")]
