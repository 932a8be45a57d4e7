"""What soles' wrenches ask of the floor: pressure inside the support, friction, yaw moment.

The whole wrench is held against the facets of the sole's own cone, as the judge does. For a
rectangle they are the closed form of Caron, Pham and Nakamura, "Stability of surface contacts for
humanoid robots", ICRA 2015; any other outline has its own.
"""

from __future__ import annotations

import numpy as np

from scout_pin.study.plan.footing import Footing
from scout_pin.study.plan.sampling.sloped import Sloped
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.dynamics import ContactDynamics
from thesis_pin.contacts.polar import beyond_cone
from thesis_pin.numeric.arrays import skew
from thesis_pin.numeric.elementwise import blocks
from thesis_pin.numeric.products import ONE_THREAD
from thesis_pin.numeric.trajectory import BodyMotion

NEAREST = 8
"""Facets of a cone that are looked at a sample, those that the wrench passes or is nearest to."""

_LEAST = 0.05  # of the weight: less pressure is taken for this, or its point runs away


def pressed(
    footing: Footing,
    soles: tuple[BodyMotion, BodyMotion],
    wrench: Sloped,
    moved: np.ndarray | None,
    weight: float,
) -> tuple[Sloped, Sloped]:
    """How far the zero-moment point is inside each edge, and the vertical force.

    Args:
        footing: The feet.
        soles: Where the joints have the soles.
        wrench: Of the floor on each sole, in its axes, ``(n, 2, 6)``.
        moved: Derivatives of the soles' places, world axes, ``(n, 2, 3, 18)``, if wanted.
        weight: Of the robot [N].

    Returns:
        Distances [m], ``(n, h)``, and force relative to the weight, ``(n, 1)``.

    Source: Scout thesis, section 6.2, equation (6.1).
    """
    to_world = np.stack([_to_world(foot.rotation, foot.position) for foot in soles], axis=1)
    total = np.einsum("nkij,nkj->ni", to_world, wrench.value)  # about the world's origin
    share = total[:, 2] / weight
    load = np.maximum(share, _LEAST)
    scaled = np.stack([-total[:, 4], total[:, 3]], axis=1) / (load * weight)[:, None]
    distance = (footing.normals @ scaled[:, :, None])[:, :, 0] - footing.offsets
    if wrench.slope is None:
        return Sloped(distance, None), Sloped(share[:, None], None)
    slope = np.einsum("nkij,nkjl->nil", to_world, wrench.slope)
    if moved is not None and moved.any():  # the same force at another place
        force = np.einsum("nkij,nkj->nki", to_world[:, :, :3, :3], wrench.value[:, :, :3])
        slope[:, 3:] -= np.einsum("nkij,nkjl->nil", skew(force), moved)
    moments = np.stack([-slope[:, 4], slope[:, 3]], axis=1) / (load * weight)[:, None, None]
    pressing = np.where(share > _LEAST, 1.0, 0.0)[:, None] * slope[:, 2] / weight
    moved = moments - scaled[:, :, None] * (pressing / load[:, None])[:, None]
    return Sloped(distance, footing.normals @ moved), Sloped(share[:, None], slope[:, 2:3] / weight)


def contacts(
    soles: tuple[Contact, Contact],
    support: np.ndarray,
    feet: tuple[BodyMotion, BodyMotion],
    dynamics: ContactDynamics,
    wrench: Sloped,
    weight: float,
) -> Sloped:
    """By what wrenches pass the cones of their soles, ``(n, NEAREST)``.

    Args:
        soles: What the floor can do to each sole.
        support: Feet in support, booleans ``(n, 2)``.
        feet: Where the joints have the soles.
        dynamics: Floor wrenches.
        wrench: The same in the soles' axes with slopes.
        weight: Of the robot [N].
    """
    value = np.full((len(support), NEAREST), -1.0)
    slope = None if wrench.slope is None else np.zeros((*value.shape, wrench.slope.shape[-1]))
    double = support.all(axis=1)
    for k, contact in enumerate(soles):
        unit = np.repeat([contact.length, 1.0], 3) / (weight * contact.length)
        for some in _few(np.flatnonzero(support[:, k] & ~double), contact):
            beyond = (wrench.value[some, k] * unit) @ contact.facets.T
            near = np.sort(np.argpartition(beyond, -NEAREST, axis=1)[:, -NEAREST:], axis=1)
            value[some] = np.take_along_axis(beyond, near, axis=1)
            if slope is not None and wrench.slope is not None:
                slope[some] = (contact.facets[near] * unit) @ wrench.slope[some, k]
    size, missing = weight * soles[0].length, double & (dynamics.double_violation > 0.0)
    value[missing, 0] = dynamics.double_violation[missing] / size
    if slope is not None:
        for sample in np.flatnonzero(missing).tolist():
            by = _missing(soles, feet, sample, wrench.part(slice(sample, sample + 1)))
            slope[sample, 0] = by / size
    return Sloped(value, slope)


def _few(samples: np.ndarray, contact: Contact) -> list[np.ndarray]:
    """Samples in portions whose product with the facets wakes no second thread."""
    size = max(1, ONE_THREAD // contact.facets.size)
    return [samples[part] for part in blocks(len(samples), size)]


def _missing(
    soles: tuple[Contact, Contact],
    feet: tuple[BodyMotion, BodyMotion],
    sample: int,
    wrench: Sloped,
) -> np.ndarray:
    """Slope of the least wrench that two soles can't supply together, ``(18,)``.

    The distance of a cone grows along the vector that leads to it. Soles that softened legs move
    against each other are taken to stay.
    """
    one, other = feet
    back = one.rotation[sample].T
    turn = back @ other.rotation[sample]
    offset = back @ (other.position[sample] - one.position[sample])
    second = np.zeros((6, 6))  # wrenches of the second sole in the first one's frame
    second[:3, :3] = second[3:, 3:] = turn
    second[3:, :3] = skew(offset) @ turn
    unit = np.repeat([soles[0].length, 1.0], 3)
    other_unit = np.repeat([soles[1].length, 1.0], 3)
    rays = [soles[0].rays, (soles[1].rays / other_unit) @ second.T * unit]
    total = (wrench.value[0, 0] + second @ wrench.value[0, 1]) * unit
    rest, _ = beyond_cone(np.concatenate(rays).T, total)
    size = float(np.linalg.norm(rest))
    if wrench.slope is None or size == 0.0:
        return np.zeros(18)
    slope = wrench.slope[0, 0] + second @ wrench.slope[0, 1]
    return np.asarray((rest * unit) @ slope / size)


def _to_world(rotation: np.ndarray, position: np.ndarray) -> np.ndarray:
    """Maps from wrenches of a sole to wrenches about the world's origin, ``(n, 6, 6)``."""
    result = np.zeros((len(rotation), 6, 6))
    result[:, :3, :3] = result[:, 3:, 3:] = rotation
    result[:, 3:, :3] = skew(position) @ rotation
    return result
