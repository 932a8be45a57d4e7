"""Requests next to one that can't be met."""

import math
from dataclasses import dataclass, field
from types import SimpleNamespace

import pytest

from scout_pin.study.plan.cycles import nearest as module
from scout_pin.study.plan.cycles.feet import least_spacing
from scout_pin.study.plan.cycles.nearest import Change, changes, nearest, raised
from scout_pin.study.plan.cycles.search import Search
from scout_pin.study.plan.request import GAP, STEP_TIME, PlanRequest
from thesis_pin.errors import NoSupportForce

SPEED = Change("speed", lambda share: share * 0.3)
ASKED = PlanRequest(speed=0.3)


@dataclass
class Found:
    """What a search that needs no robot came to."""

    request: PlanRequest
    kept: bool
    most: float = 0.1

    @property
    def known(self):
        return self.request.speed


def of_speeds(monkeypatch, most, met_anew):
    """Searches that get to a speed only from near it; those that begin anew know another limit."""

    def attempt(search, request, start):
        return Found(request, request.speed <= min(1.35 * start, most))

    def fresh(search, request, found):
        return Found(request, True) if request is not None and request.speed < 0.1 else None

    monkeypatch.setattr(module, "attempt", attempt)
    monkeypatch.setattr(module, "_fresh", fresh)
    asked = []

    def again(search, request, most):
        asked.append((request.speed, most))
        return request.speed <= met_anew

    monkeypatch.setattr(module, "_again", again)
    return asked


def offered(asked, found, change):
    """What is offered in the end, of a search of which nothing is done yet."""
    search = Limited(0.0)
    offer = nearest(search, asked, found, change)
    return None if offer is None else raised(search, asked, offer).request


def test_what_fails_from_afar_is_met_step_by_step(monkeypatch):
    of_speeds(monkeypatch, 0.18, 1.0)
    met = offered(ASKED, Found(ASKED, False), SPEED)
    assert 0.97 * 0.18 < met.speed <= 0.18


def test_what_is_not_met_anew_is_not_offered_but_the_next_less_ambitious(monkeypatch):
    of_speeds(monkeypatch, 0.18, 0.175)
    assert 0.14 < offered(ASKED, Found(ASKED, False), SPEED).speed <= 0.175
    of_speeds(monkeypatch, 0.18, 0.0)
    assert offered(ASKED, Found(ASKED, False), SPEED) is None


def test_a_request_is_offered_where_only_much_less_than_the_edge_is_met_anew(monkeypatch):
    of_speeds(monkeypatch, 0.18, 0.12)
    assert 0.1 < offered(ASKED, Found(ASKED, False), SPEED).speed <= 0.12


def test_what_is_safe_is_searched_anew_before_what_may_take_all_the_time(monkeypatch):
    asked = of_speeds(monkeypatch, 0.18, 0.12)
    assert offered(ASKED, Found(ASKED, False), SPEED).speed == asked[0][0]
    speeds, steps = zip(*asked, strict=True)
    assert speeds[0] < speeds[2] < speeds[1]
    assert all(0.0 < most < Limited.left for most in steps), "something is left for the next"
    asked = of_speeds(monkeypatch, 0.18, 1.0)
    assert offered(ASKED, Found(ASKED, False), SPEED).speed == max(asked)[0]
    assert len(asked) == 2, "nothing lies between"


@dataclass
class Limited:
    """A search of which so much is done, of so much that is allowed."""

    iterations: float
    allowed: float = math.inf
    left: float = 300.0
    sampler: object = field(default_factory=lambda: SimpleNamespace(robot=None))
    tick: object = None

    @property
    def spent(self):
        return self.iterations >= self.allowed

    def solved(self, request, start, **_):
        self.iterations += 30
        return Found(request, True)

    def first(self, request):
        while not self.spent:
            self.solved(request, None)
        raise NoSupportForce("nothing is regular")


def test_a_search_anew_takes_the_steps_that_it_may_and_is_counted(monkeypatch):
    anew = []

    def search(robot, request, tick):
        anew.append(Limited(0.0))
        return anew[-1]

    monkeypatch.setattr(module, "Search", search)
    of = Limited(1000.0)
    assert not module._again(of, ASKED, 150.0)
    assert anew[0].allowed == 150.0
    assert of.iterations == 1150.0
    assert not module._again(of, ASKED, 0.0)
    assert len(anew) == 1, "where nothing is left nobody searches"


def test_no_descent_begins_after_what_is_allowed():
    search = Limited(0.0, allowed=70.0)
    found = [module.attempt(search, ASKED, None) for _ in range(5)]
    assert [one is not None for one in found] == [True, True, True, False, False]
    assert search.iterations == 90.0


def test_a_request_in_another_unit_is_led_back_to_what_can_be_met(monkeypatch):
    of_speeds(monkeypatch, 0.18, 1.0)
    asked = PlanRequest(speed=10.0)
    change = Change("speed", lambda share: share * 10.0)
    assert 0.01 <= offered(asked, Found(asked, False, 50.0), change).speed <= 0.18


def test_hardly_anything_that_fails_is_the_last_of_its_kind_but_of_time(monkeypatch):
    tried = []
    monkeypatch.setattr(module, "_fresh", lambda search, request, found: tried.append(request))
    assert offered(ASKED, Found(ASKED, False), SPEED) is None
    assert [one.speed for one in tried] == [0.03]
    slower = Change("step_time", lambda share: 0.8 / share, unit=1.0, up=True)
    asked, tried = PlanRequest(step_time=0.8), []
    monkeypatch.setattr(module, "_fresh", lambda search, request, found: tried.append(request))
    assert offered(asked, Found(asked, False), slower) is None
    assert [one.step_time for one in tried] == [1.6, 3.2, 8.0]


@pytest.mark.parametrize(
    ("asked", "names"),
    [
        ({}, ["step_length", "step_time", "margin"]),
        ({"margin": 0.0}, ["step_length", "step_time"]),
        ({"speed": 0.2}, ["speed", "margin"]),
        ({"speed": 0.2, "step_length": 0.04}, ["speed", "step_length", "margin"]),
        ({"speed": 0.2, "step_time": 0.3}, ["speed", "margin"]),
        ({"objective": "fastest"}, ["margin"]),
        ({"objective": "fastest", "step_length": 0.04}, ["step_length", "margin"]),
        ({"side": -0.02}, ["step_time", "margin", "side"]),
        (
            {"turn": 0.2, "step_length": 0.03},
            ["step_length", "step_time", "margin", "turn"],
        ),
        ({"foot_spacing": 0.09}, ["step_length", "step_time", "margin", "foot_spacing"]),
    ],
)
def test_one_thing_changes_and_all_else_stays_as_it_was_said(scout, asked, names):
    request = PlanRequest(**asked)
    found = list(changes(Search(scout, request, lambda: None), request))
    assert [one.name for one in found] == names
    was, usual = request.document(), least_spacing(scout) + GAP
    for one in found:
        less = one.request(request, 0.7)
        now = less.document()
        assert {key for key in was if now[key] != was[key]} == {one.name}
        amount, value = getattr(request, one.name), getattr(less, one.name)
        expected = {
            "step_time": STEP_TIME / 0.7,
            "step_length": 0.7 * request.first_length,
            "foot_spacing": usual + 0.7 * ((amount or 0.0) - usual),
        }.get(one.name, 0.7 * (amount or 0.0))
        assert value == pytest.approx(expected, rel=5e-3)
        if one.name == "turn":
            assert math.degrees(value) == pytest.approx(8.02, rel=1e-12)  # of 8.0214°


def test_never_more_is_offered_than_was_asked_for(monkeypatch):
    of_speeds(monkeypatch, 1.0, 1.0)
    assert 0.25 < offered(ASKED, Found(ASKED, False), SPEED).speed <= 0.3


@pytest.mark.parametrize(
    ("change", "share", "told"),
    [
        (Change("margin", lambda share: share * 0.01, digits=3), 0.40625, 4.06e-3),
        (Change("margin", lambda share: share * 0.01, digits=3), 0.40699, 4.06e-3),
        (Change("step_time", lambda share: 0.8 / share, unit=1.0, up=True), 0.7, 1.143),
        (Change("step_time", lambda share: 0.8 / share, unit=1.0, up=True), 0.5, 1.6),
        (Change("side", lambda share: share * -0.02, digits=3), 0.40699, -8.13e-3),
        (SPEED, 0.48437, 145.3e-3),
    ],
)
def test_what_is_told_is_on_the_safe_side(change, share, told):
    found = getattr(change.request(PlanRequest(), share), change.name)
    assert found == pytest.approx(told, rel=1e-14)


def test_what_cannot_be_asked_for_is_not_offered():
    asked = PlanRequest(step_time=20.0, step_length=0.0005, margin=0.0005)
    slower = Change("step_time", lambda share: 20.0 / share, unit=1.0, up=True)
    assert slower.request(asked, 0.1) is None
    assert Change("step_length", lambda share: share * 0.0005).request(asked, 0.1) is None
    assert Change("margin", lambda share: share * 0.0005).request(asked, 0.1) is None
