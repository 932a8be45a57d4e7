"""Bodies moved and turned over the floor, against SciPy's rotations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from scout_pin.motion.over_floor import OverFloor, turn_between, turned_jets, turned_state
from thesis_pin.numeric.interpolation import free_quintic
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tolerances import TOLERANCES

T = np.linspace(0.0, 2.0, 9)


def body(rng, level):
    """Six curves, each with its own knots."""
    six = []
    for k in range(6):
        t = T if k % 2 else np.linspace(0.0, 2.0, 7)
        values = 0.2 * rng.normal(size=len(t)) * (0 if level and k in (3, 4) else 1)
        six.append(free_quintic(t, values))
    return six


def placed(six, t):
    values = np.stack([one(t) for one in six], axis=1)
    return values[:, :3], Rotation.from_euler("XYZ", values[:, 3:])


@pytest.mark.parametrize("level", [True, False])
@pytest.mark.parametrize("by", [OverFloor(0.1, -0.2), OverFloor(0.3, 0.1, 2.5)])
def test_a_moved_body_is_turned_about_the_origin_then_shifted(rng, by, level):
    six = body(rng, level)
    t = np.linspace(0.0, 2.0, 301)
    place, turn = placed(six, t)
    there, turned = placed(by.moved(six), t)
    about = Rotation.from_euler("z", by.turn)
    np.testing.assert_allclose(there, about.apply(place) + np.array([by.x, by.y, 0.0]), atol=1e-12)
    off = ((about * turn).inv() * turned).magnitude().max()
    assert off < (1e-12 if level or not by.turn else 3 * TOLERANCES.turned_curve)


def test_the_knots_of_turned_angles_have_exact_rates_and_accelerations(rng):
    six, by = body(rng, level=False), OverFloor(turn=1.0)
    moved = by.moved(six)
    for t in six[3].x[1:-1]:
        jets = np.array([[[float(one(t, n)) for one in six[3:]]] for n in range(3)])
        expected = turned_jets(jets, np.array([1.0]))[:, 0]
        found = np.array([[float(one(t, n)) for one in moved[3:]] for n in range(3)])
        np.testing.assert_allclose(found, expected, atol=1e-9)


def test_turned_jets_are_the_turned_motion_differenced(rng):
    angles, h, rate = rng.uniform(-0.4, 0.4, (3, 3)), 1e-3, 0.5

    def at(t):
        own = Rotation.from_euler("XYZ", angles[0] + angles[1] * t + angles[2] * t**2 / 2)
        return (Rotation.from_euler("z", 0.7 + rate * t) * own).as_euler("XYZ")

    found = turned_jets(angles[:, None], np.array([0.7]), rate)[:, 0]
    before, here, after = (at(t) for t in (-h, 0.0, h))
    np.testing.assert_allclose(found[0], here, atol=1e-12)
    np.testing.assert_allclose(found[1], (after - before) / (2 * h), atol=1e-6)
    np.testing.assert_allclose(found[2], (after - 2 * here + before) / h**2, atol=1e-5)


def test_yaw_goes_on_beyond_half_a_turn():
    level = [Piecewise([[0.0]], [0.0, 1.0])] * 3 + [Piecewise([[0.1]], [0.0, 1.0])] * 3
    assert float(OverFloor(turn=7.0).moved(level)[5](0.5)) == pytest.approx(7.1, abs=0.05)


def test_motions_compose_and_undo_each_other():
    one, other = OverFloor(0.1, 0.2, 0.3), OverFloor(-0.3, 0.05, -0.7)
    z = complex(0.4, -0.2)

    def moved(by, z):
        return complex(by.x, by.y) + np.exp(1j * by.turn) * z

    assert moved(one.after(other), z) == pytest.approx(moved(one, moved(other, z)))
    assert moved(one.inverse, moved(one, z)) == pytest.approx(z)
    thrice = one.times(3)
    assert moved(thrice, z) == pytest.approx(moved(one, moved(one, moved(one, z))))
    assert thrice.turn == pytest.approx(0.9)
    assert OverFloor(0.1, 0.2).times(3) == OverFloor(3 * 0.1, 3 * 0.2)


@pytest.mark.parametrize("turn", [0.4, -2.5, 3.5, -7.0])
def test_a_turned_state_is_the_whole_motion_turned_and_its_turn_is_found_again(rng, turn):
    start = rng.uniform(-0.4, 0.4, (3, 6, 3))
    end = turned_state(start, turn)
    about = Rotation.from_euler("z", turn).as_matrix()
    np.testing.assert_allclose(end[:, :3], about @ start[:, :3], atol=1e-12)
    for before, after in zip(start[:, 3:], end[:, 3:], strict=True):
        own = Rotation.from_euler("XYZ", before[:, 0]).as_matrix()
        found = Rotation.from_euler("XYZ", after[:, 0]).as_matrix()
        np.testing.assert_allclose(found, about @ own, atol=1e-12)
        assert after[2, 0] - before[2, 0] == pytest.approx(turn, abs=0.5)  # not a whole turn less
        expected = turned_jets(before.T[:, None], np.array([turn]))[:, 0]
        np.testing.assert_allclose(after.T, expected, atol=1e-12)
    assert turn_between(start, end) == pytest.approx(turn, abs=1e-12)
    # What two of three bodies say holds.
    end[0, 5, 0] += 0.3
    assert turn_between(start, end) == pytest.approx(turn, abs=1e-12)


def test_turned_angles_may_jump_where_their_curves_do():
    jump = Piecewise([[0.1, 0.0], [0.2, -0.3]], [0.0, 1.0, 2.0])
    level = Piecewise([[0.0]], [0.0, 2.0])
    found = OverFloor(turn=0.8).moved([level, level, level, jump, level, level])[3:]
    for t, pitch in ((np.nextafter(1.0, 0.0), 0.3), (1.0, -0.3)):
        own = Rotation.from_euler("z", 0.8) * Rotation.from_euler("XYZ", [pitch, 0.0, 0.0])
        np.testing.assert_allclose([one(t) for one in found], own.as_euler("XYZ"), atol=1e-9)
