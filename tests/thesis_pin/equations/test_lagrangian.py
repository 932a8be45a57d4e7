"""D, V and C of mechanisms small enough to do by hand."""

import numpy as np

from thesis_pin.equations import lagrangian
from thesis_pin.equations.values import STEP


def pendulum(q, length=0.7, mass=1.3, inertia=0.02):
    """A bob on a rod in the xz plane, q from the downward vertical."""
    zero, one = np.zeros_like(q), np.ones_like(q)
    centre = length * np.stack([np.sin(q), zero, -np.cos(q)], axis=-1)
    linear = length * np.stack([np.cos(q), zero, np.sin(q)], axis=-1)[..., None]
    angular = np.stack([zero, -one, zero], axis=-1)[..., None]
    return lagrangian.Body(
        np.asarray(mass),
        np.broadcast_to(inertia * np.eye(3), (*q.shape, 3, 3)),
        linear,
        angular,
        centre,
    )


def test_a_pendulum_has_the_terms_of_the_textbook():
    q, rate = np.array([0.4, 2.0]), np.array([[1.5], [-0.3]])
    bodies = [pendulum(q)]
    time, varied = (
        lagrangian.exact_rates([pendulum(q + 1j * STEP * step)]) for step in (rate[:, 0], 1.0)
    )
    terms = lagrangian.assemble(bodies, time, varied[:, None], rate)
    np.testing.assert_allclose(terms.mass[:, 0, 0], 1.3 * 0.7**2 + 0.02)
    np.testing.assert_allclose(terms.velocity, 0, atol=1e-15)
    np.testing.assert_allclose(terms.gravity[:, 0], 1.3 * 9.81 * 0.7 * np.sin(q))
    energy = lagrangian.kinetic_energy(bodies[0], rate)
    np.testing.assert_allclose(energy, 0.5 * terms.mass[:, 0, 0] * rate[:, 0] ** 2)


def sliding(q):
    """A point that slides along a turning rod: q = (angle, distance)."""
    angle, distance = q[..., 0], q[..., 1]
    zero = np.zeros_like(angle)
    along = np.stack([np.cos(angle), np.sin(angle), zero], axis=-1)
    across = np.stack([-np.sin(angle), np.cos(angle), zero], axis=-1)
    linear = np.stack([distance[..., None] * across, along], axis=-1)
    nothing = np.zeros((*angle.shape, 3, 3), dtype=q.dtype)
    return lagrangian.Body(
        np.asarray(2.0), nothing, linear, np.zeros_like(linear), distance[..., None] * along
    )


def test_a_sliding_point_feels_centrifugal_and_coriolis_forces():
    q, v = np.array([[0.3, 0.8]]), np.array([[1.2, -0.5]])
    time = lagrangian.exact_rates([sliding(q + 1j * STEP * v)])
    varied = lagrangian.exact_rates([sliding(q[:, None] + 1j * STEP * np.eye(2))])
    terms = lagrangian.assemble([sliding(q)], time, varied, v)
    force = (terms.velocity @ v[..., None])[0, :, 0]
    expected = [2.0 * 2 * 0.8 * 1.2 * -0.5, -2.0 * 0.8 * 1.2**2]
    np.testing.assert_allclose(force, expected, rtol=1e-12)
    np.testing.assert_allclose(terms.rate[0], np.diag([2.0 * 2 * 0.8 * -0.5, 0.0]), atol=1e-14)
