"""Gaits that go on: what of an end fits the start, and gaits several times over."""

from dataclasses import replace

import numpy as np
import pytest

import scout_pin
from scout_pin.motion.cycles import closure, repeat_gait
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import BODIES, Phase
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.interpolation import polynomial

from ..conftest import EXAMPLES
from .test_contact import write_log

POSE = ("x", "y", "z", "pitch", "roll", "yaw")


@pytest.fixture
def walk():
    return load_gait(EXAMPLES / "walk.toml")


def changed(gait, body, coordinate, curve):
    curves = list(gait.curves[body])
    curves[POSE.index(coordinate)] = curve
    return replace(gait, curves=gait.curves | {body: tuple(curves)})


def part(gait, start, end):
    """The gait between two times, phases and all."""
    phases = tuple(
        Phase(start=max(p.start, start), end=min(p.end, end), support=p.support)
        for p in gait.phases
        if p.start < end and p.end > start
    )
    return replace(gait, phases=phases)


def test_a_walk_that_ends_as_it_began_closes_a_step_further(walk):
    found = closure(walk)
    assert found.closed
    assert found.gaps == ()
    np.testing.assert_allclose(found.displacement, [0.0, 0.02], atol=1e-12)


@pytest.mark.parametrize(
    ("coordinate", "coefficients", "what", "size"),
    [
        # End less start over the 30 units of 0.2 s; the middle of three bodies sets the step.
        ("z", [3e-3 / 30, 0.216], "position", 3e-3),
        ("yaw", [0.02 / 30, 0.0], "position", 0.02),
        ("x", [1e-3 / 30**2, -1e-3 / 30, 0.0], "rate", 2e-3 / 30 / 0.2),
        ("x", [0.6 / 30**3, -0.9 / 30**2, 0.3 / 30, 0.0], "acceleration", 3.6 / 900 / 0.04),
    ],
)
def test_what_does_not_fit_is_named_with_its_size(walk, coordinate, coefficients, what, size):
    found = closure(changed(walk, "torso", coordinate, polynomial(0, 30, coefficients)))
    (gap,) = [gap for gap in found.gaps if gap.what == what]
    assert (gap.body, gap.coordinate) == ("torso", coordinate)
    assert gap.size == pytest.approx(size, rel=1e-5)
    assert found.closed == (what == "acceleration")
    assert f"torso {coordinate} {what} by" in gap.words


def test_a_repeated_gait_is_the_gait_again_a_step_further(walk):
    thrice = repeat_gait(walk, 3)
    t = np.linspace(0.01, 29.99, 101)
    for body in BODIES:
        once = walk.body(body, t)
        for k in range(3):
            again = thrice.body(body, t + 30 * k)
            for name in ("rotation", "velocity", "acceleration", "omega", "alpha"):
                np.testing.assert_allclose(getattr(again, name), getattr(once, name), atol=1e-9)
            moved = once.position + np.array([0.0, 0.02 * k, 0.0])
            np.testing.assert_allclose(again.position, moved, atol=1e-12)
    assert [phase.support for phase in thrice.phases] == [
        *("double", "left", "double", "right"),
        *("double", "left", "double", "right"),
        *("double", "left", "double", "right", "double"),
    ]
    assert len(thrice.touchdowns()) == 6
    assert thrice.rate_jumps() == []


def test_repeating_from_the_middle_of_a_motion_gives_the_same_walk(scout, walk):
    """From one double support to the next cycle's: cut out of two, it repeats to the same."""
    twice = part(repeat_gait(walk, 3), 22.0, 52.0)
    found = closure(twice)
    assert found.closed
    report = scout_pin.gait_report(scout, repeat_gait(twice, 2), samples=201)
    once = scout_pin.gait_report(scout, walk, samples=401)
    assert report.can_walk
    assert report.margin.min() == pytest.approx(once.margin.min(), abs=1e-5)


def test_a_gait_that_does_not_return_cannot_be_repeated(walk):
    with pytest.raises(
        TrajectoryError, match=r"repeated 2 times.*doesn't fit.*right foot z position by 10 mm"
    ):
        repeat_gait(part(walk, 0.0, 8.0), 2)
    with pytest.raises(TrajectoryError, match=r"torso yaw position by 5\.73°"):
        repeat_gait(changed(walk, "torso", "yaw", polynomial(0, 30, [0.1 / 30, 0.0])), 2)
    with pytest.raises(TrajectoryError, match="phases"):
        repeat_gait(walk, 3000)


def test_rates_that_do_not_fit_jump_in_the_repeated_gait(walk):
    bent = changed(walk, "torso", "x", polynomial(0, 30, [1e-3 / 30**2, -1e-3 / 30, 0.0]))
    (jump,) = repeat_gait(bent, 2).rate_jumps()
    assert (jump.t, jump.body, jump.coordinate) == (30.0, "torso", "x")
    assert jump.size == pytest.approx(2e-3 / 30 / 0.2)


def sampled(path, gait, rate, digits):
    """The gait as a table of rounded samples, read again."""
    t = np.minimum(np.arange(0.0, 6.0 + 1e-9, 1.0 / rate) / gait.time_unit, gait.end)
    return load_gait(write_log(path, gait, t, gait.support(t), digits))


@pytest.mark.parametrize(("rate", "digits"), [(60, 4), (100, 3), (100, 5)])
def test_what_rounding_leaves_open_is_no_gap(walk, tmp_path, rate, digits):
    found = closure(sampled(tmp_path / "log.csv", walk, rate, digits))
    assert found.gaps == ()
    np.testing.assert_allclose(found.displacement, [0.0, 0.02], atol=10.0**-digits)


def test_a_gap_wider_than_what_rounding_leaves_open_is_one_at_every_seam(walk, tmp_path):
    """2 cm over a cycle's 6 s: what its rate changes by from end to start."""
    bent = changed(walk, "torso", "x", polynomial(0, 30, [1e-2 / 30**2, -1e-2 / 30, 0.0]))
    log = sampled(tmp_path / "log.csv", bent, 100, 5)
    (gap,) = [gap for gap in closure(log).gaps if gap.what == "rate"]
    assert gap.size == pytest.approx(0.02 / 6, rel=0.01)
    jumps = repeat_gait(log, 3).rate_jumps()
    assert [(jump.body, jump.coordinate) for jump in jumps] == [("torso", "x")] * 2
    assert [jump.t for jump in jumps] == pytest.approx([6.0, 12.0])
    assert [jump.size for jump in jumps] == pytest.approx([0.02 / 6] * 2, rel=0.01)
