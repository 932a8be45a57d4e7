"""The geometry of paths without their timing: the places are those that the path goes through."""

from pathlib import Path

import numpy as np
import pytest

import pollard_pin
from pollard_pin.motion.chain import Chain
from pollard_pin.motion.curves import arc, joined, line
from pollard_pin.motion.feed import at_speed
from pollard_pin.motion.placing import Placement, place_path
from pollard_pin.motion.samples import through
from pollard_pin.motion.untimed import untimed
from thesis_pin.errors import TrajectoryError

EXAMPLES = Path(__file__).parents[3] / "examples"
START, END = [0.45, -0.15, 0.0, 0.1, 0.0, 0.0], [0.45, 0.15, 0.05, 0.0, 0.25, 0.1]


def fed():
    time = np.linspace(0, 1, 30)[:, None]
    position = np.hstack([0.45 + 0 * time, 0.2 * time, 0.05 * np.sin(3 * time)])
    return at_speed(position, np.broadcast_to(np.eye(3), (30, 3, 3)), 0.1)


def tabled(rest=True):
    """Samples over time of a wave from rest to rest."""
    time = np.linspace(0, 3.0, 301)
    tau = time / 3.0
    s = tau**3 * (10 - 15 * tau + 6 * tau**2) if rest else tau
    poses = np.zeros((len(time), 6))
    poses[:, 0], poses[:, 1], poses[:, 2] = 0.45, 0.3 * s - 0.15, 0.05 * np.sin(8 * s)
    poses[:, 4] = 0.2 * s
    return through(time, poses, "free")


PATHS = {
    "appendix B": lambda: pollard_pin.appendix_b(timing="rest-to-rest"),
    "line": lambda: line(START, END, 2.0),
    "arc": lambda: arc(START, [0.5, 0.0, 0.12], END, 2.0, "ramped"),
    "segments": lambda: pollard_pin.load_path(EXAMPLES / "spray_arch.toml"),
    "at a speed": fed,
    "table": tabled,
    "table, not at rest": lambda: tabled(rest=False),
    "placed": lambda: place_path(
        pollard_pin.load_path(EXAMPLES / "spray_arch.toml"),
        Placement.of((0.02, 0.01, -0.03), 0.3, True),
    ),
    "placed appendix B": lambda: place_path(
        pollard_pin.appendix_b(), Placement.of((0.05, 0.0, 0.1))
    ),
}


@pytest.mark.parametrize("name", PATHS)
def test_the_geometry_goes_where_the_path_goes(name):
    path = PATHS[name]()
    chain = Chain.of(untimed(path)[0])
    whole, _ = chain(np.linspace(0, chain.ends[-1], 20_001))
    motion = path.sample(101)
    turned = (whole.rotation - motion.tool.rotation[:, None]).reshape(101, -1, 9)
    apart = np.linalg.norm(whole.position - motion.tool.position[:, None], axis=-1)
    both = np.hypot(apart, 0.1 * np.linalg.norm(turned, axis=-1))
    steps = np.linalg.norm(np.diff(whole.position, axis=0), axis=-1)
    assert both.min(axis=1).max() <= steps.max() + 2e-6
    for place, own in ((0, 0), (-1, -1)):
        np.testing.assert_allclose(whole.position[place], motion.tool.position[own], atol=1e-9)
        np.testing.assert_allclose(whole.rotation[place], motion.tool.rotation[own], atol=1e-9)


@pytest.mark.parametrize("name", PATHS)
def test_derivatives_are_those_of_the_places(name):
    chain = Chain.of(untimed(PATHS[name]())[0])
    middle = (chain.ends[:-1] + chain.ends[1:]) / 2 + 0.013 * np.diff(chain.ends)
    step = 1e-5 * chain.ends[-1]
    before, here, after = (chain(middle + k * step)[0] for k in (-1, 0, 1))
    np.testing.assert_allclose(
        (after.position - before.position) / (2 * step), here.velocity, atol=1e-5
    )
    np.testing.assert_allclose(
        (after.velocity - before.velocity) / (2 * step), here.acceleration, rtol=1e-4, atol=1e-3
    )
    np.testing.assert_allclose(
        (after.omega - before.omega) / (2 * step), here.alpha, rtol=1e-4, atol=1e-3
    )
    assert np.linalg.norm(here.velocity, axis=1).min() > 0


def test_a_table_that_rests_at_its_ends_has_a_geometry_that_does_not():
    curves, notes = untimed(tabled())
    assert len(curves) == 1
    s = np.linspace(0, curves[0].length, 2001)
    speed = np.linalg.norm(curves[0].function(s)[0].velocity, axis=1)
    assert 0.9 < speed.min() <= speed.max() < 1.1
    assert "leaves the given path by up to" in notes[0]


def test_a_table_that_turns_a_corner_at_rest_has_two_pieces():
    tau = np.linspace(0, 1, 101)
    s = tau**3 * (10 - 15 * tau + 6 * tau**2)
    poses = np.zeros((201, 6))
    poses[:, 0] = 0.45
    poses[:101, 1], poses[100:, 1] = 0.1 * s, 0.1
    poses[100:, 2] = 0.1 * s
    path = through(np.linspace(0, 4, 201), poses, "free")
    chain = Chain.of(untimed(path)[0])
    assert len(chain.curves) == 2
    assert chain.stops.tolist() == [True, True, True]
    np.testing.assert_allclose(chain(chain.ends[1:2])[0].position[0], [0.45, 0.1, 0], atol=1e-5)


def test_a_table_that_waits_and_goes_on_is_one_piece():
    tau = np.linspace(0, 1, 101)
    s = tau**3 * (10 - 15 * tau + 6 * tau**2)
    poses = np.zeros((300, 6))
    poses[:, 0] = 0.45
    poses[:, 1] = 0.1 * np.concatenate([s, np.ones(98), 1 + s])
    path = through(np.linspace(0, 6, 300), poses, "free")
    chain = Chain.of(untimed(path)[0])
    assert len(chain.curves) == 1
    assert chain.ends[-1] == pytest.approx(0.2, rel=1e-6)


def test_a_path_that_stays_where_it_is_is_refused():
    poses = np.tile([0.45, 0.0, 0.0, 0.0, 0.0, 0.0], (5, 1))
    with pytest.raises(TrajectoryError, match="stays where it is"):
        untimed(through(np.arange(5.0), poses, "free"))


def test_pieces_go_on_at_one_rate_where_their_direction_is_one():
    parts = [line(START, [0.45, 0.0, 0.025, 0.1, 0, 0], 1.0)]
    parts.append(line([0.45, 0.0, 0.025, 0.1, 0, 0], [0.45, 0.3, 0.075, 0.1, 0, 0], 1.0))
    chain = Chain.of(joined(parts).curves)
    assert chain.stops.tolist() == [True, False, True]
    first, second = (chain.piece(k, chain.ends[1:2])[0].velocity for k in (0, 1))
    np.testing.assert_allclose(first, second, atol=1e-12)
