"""Ways over the floor: arcs that compose, and what counts along them."""

import numpy as np
import pytest

from scout_pin.study.plan.way import Way

WAYS = [Way(0.0, 0.03, 0.0), Way(0.01, 0.0, 0.0), Way(0.01, 0.03, 0.3), Way(0.0, 0.0, -0.2)]


@pytest.mark.parametrize("way", WAYS)
def test_steps_compose_and_come_apart_again(way):
    one, whole = way.motion(1), way.motion(5)
    found = one
    for _ in range(4):
        found = one.after(found)
    for name in ("x", "y", "turn"):
        assert getattr(found, name) == pytest.approx(getattr(whole, name), abs=1e-15)
    again = Way.of(whole, 5)
    np.testing.assert_allclose(
        [again.aside, again.ahead, again.turn], [way.aside, way.ahead, way.turn], atol=1e-15
    )
    assert way.straight == (way == WAYS[0])


@pytest.mark.parametrize("way", WAYS)
def test_a_way_is_the_integral_of_the_turning_direction(way):
    u = np.linspace(0.0, 3.0, 30001)
    direction = (way.aside + 1j * way.ahead) * np.exp(1j * way.turn * u)
    place, heading = way.after(u)
    middles = (direction[1:] + direction[:-1]) / 2 * np.diff(u)
    np.testing.assert_allclose(place[1:, 0] + 1j * place[1:, 1], np.cumsum(middles), atol=1e-10)
    np.testing.assert_allclose(heading, way.turn * u)
    assert way.length == pytest.approx(np.abs(np.diff(place @ [1, 1j])).sum() / 3.0)


@pytest.mark.parametrize("way", WAYS)
def test_jets_in_the_world_are_the_motion_differenced_and_slopes_follow(way, rng):
    h, time = 1e-4, 0.7
    polynomial = rng.normal(size=(3, 6))

    def local(u):
        p, v, a = polynomial
        return np.stack([p + v * u + a * u**2, v + 2 * a * u, 2 * a], axis=0)

    def world(u):
        return way.into_world(local(u)[None], np.array([u]), time)[0].reshape(3, 6)

    u = 0.6
    here = world(u)
    ends = [world(u + each)[0] for each in (-h, h)]
    np.testing.assert_allclose(here[1], (ends[1] - ends[0]) / (2 * h * time), atol=1e-6)
    second = (ends[1] - 2 * here[0] + ends[0]) / (h * time) ** 2
    np.testing.assert_allclose(here[2], second, atol=1e-5)
    # A weighted sum of the world's jets, by steps, changes with local ones as its slopes say.
    weights = rng.normal(size=(1, 3, 6))
    scale = time ** np.arange(3.0)[:, None]
    found = way.from_world(weights, np.array([u]))[0]
    for n, k in np.ndindex(3, 6):
        moved = local(u)
        moved[n, k] += 1.0
        there = way.into_world(moved[None], np.array([u]), time)[0].reshape(3, 6)
        change = (weights[0] * scale * (there - here)).sum()
        assert found[n, k] == pytest.approx(change, abs=1e-12)
