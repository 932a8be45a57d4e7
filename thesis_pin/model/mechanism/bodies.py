"""Whether bodies can be: mass and inertia of what moves as one, and their sizes.

A body is judged after everything fixed to it is merged into it, for only then does
it stand in the equations: frames without mass, sensors of rounding's mass and rotors
given as inertia alone are common in files and harmless.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.mechanism.description import (
    Array,
    Description,
    Link,
    MovingBody,
    moving_bodies,
)
from thesis_pin.model.mechanism.inertia import parallel_axis

ROUNDING = 1e-12
"""Part of an inertia that sums make by rounding."""

DIGITS = 1e-3
"""Part of an inertia that its rounded decimals may be wrong by; more is refused. Also the
part of the robot's mass and largest inertia below which a body is too small to matter."""


def check_bodies(description: Description, *, free_root: bool = False) -> None:
    """Refuse a moving body that can't be, unless it is too small to matter.

    Args:
        description: What was read; its joints are a tree.
        free_root: Whether the root moves too.

    Raises:
        NonPhysicalInertia: With the link, its eigenvalues and by how much.
    """
    bodies = list(moving_bodies(description))
    for body in bodies:
        if (body.joint or free_root) and not _negligible(body, bodies):
            _check(body, description)


def odd_bodies(description: Description) -> Iterator[str]:
    """What is odd about links and bodies that needn't be wrong, each with its place."""
    reach = _reach(description)
    carrying = _carrying(description)
    for link in description.links.values():
        if link.inertial is not None and _link_excess(link) > ROUNDING:
            yield (
                f"{_place(description, link)}: no body has its inertia; only that of all "
                "that is fixed together counts"
            )
    for body in moving_bodies(description):
        name = _link_of(body, description)
        where = _place(description, description.links[name])
        if body.joint and body.mass == 0.0:
            if np.any(body.tensor):
                yield f"{where}: it has inertia and no mass"
            elif name not in carrying:
                yield f"{where}: it moves and has no mass"
        if not body.mass > 0.0:
            continue
        _, tensor = _centroidal(body)
        excess = _excess(tensor, _scale(body))
        if excess > ROUNDING:
            yield f"{where}: no body has the inertia that moves with it; it is off by {excess:.1g}"
        gyration = float(np.sqrt(max(np.linalg.eigvalsh(tensor)[-1], 0.0) / body.mass))
        if 0.0 < reach < gyration:
            yield (
                f"{where}: its radius of gyration is {gyration:.3g} m in a robot that reaches "
                f"{reach:.3g} m; are mass and inertia in kg and kg·m²?"
            )


def _check(body: MovingBody, description: Description) -> None:
    name = _link_of(body, description)
    link = description.links[name]
    tensor = body.tensor if body.mass == 0.0 else _centroidal(body)[1]
    scale = _scale(body)
    if body.mass >= 0.0 and _excess(tensor, scale) <= DIGITS:
        return
    bad = [one for one in _fixed_to(name, description) if _link_excess(one) > DIGITS]
    named = bad[0] if bad else link
    second = 0.5 * np.trace(tensor) * np.eye(3) - tensor
    eigenvalues = np.sort([*np.linalg.eigvalsh(second), body.mass])
    raise NonPhysicalInertia(
        named.name,
        eigenvalues.tolist(),
        np.linalg.eigvalsh(tensor).tolist(),
        where=f"{description.where}:{named.line}",
    )


def _negligible(body: MovingBody, bodies: Sequence[MovingBody]) -> bool:
    """Whether a body's inertia can't be told from none among those of the robot."""
    mass = sum(one.mass for one in bodies)
    largest = max(_scale(one) for one in bodies if one is not body) if len(bodies) > 1 else 0.0
    return 0.0 <= body.mass <= DIGITS * mass and _scale(body) <= DIGITS * largest


def _centroidal(body: MovingBody) -> tuple[Array, Array]:
    com = body.moment / body.mass
    return com, np.asarray(body.tensor - parallel_axis(body.mass, com))


def _scale(body: MovingBody) -> float:
    """Size of the numbers that the centroidal tensor is a difference of."""
    return float(np.abs(body.tensor).max())


def _excess(tensor: Array, scale: float) -> float:
    """By what part of itself an inertia breaks the rules; 0 for rounding and none at all."""
    principal = np.linalg.eigvalsh(tensor)
    least = min(principal[0], principal[0] + principal[1] - principal[2])
    size = float(np.abs(principal).max())
    if least >= -ROUNDING * scale or size == 0.0:
        return 0.0
    return float(-least / size)


def _link_excess(link: Link) -> float:
    if link.inertial is None:
        return 0.0
    if link.inertial.mass < 0.0:
        return np.inf
    size = float(np.abs(link.inertial.tensor).max())
    return _excess(link.inertial.tensor, max(size, link.inertial.mass))


def _link_of(body: MovingBody, description: Description) -> str:
    if body.joint:
        return description.joints[body.joint].child
    children = {joint.child for joint in description.joints.values()}
    return next(name for name in description.links if name not in children)


def _fixed_to(name: str, description: Description) -> Iterator[Link]:
    waiting = [name]
    while waiting:
        link = waiting.pop()
        yield description.links[link]
        waiting += [
            joint.child
            for joint in description.joints.values()
            if joint.parent == link and joint.kind == "fixed"
        ]


def _carrying(description: Description) -> set[str]:
    """Links that something with mass hangs on, through whatever joints."""
    above = {joint.child: joint.parent for joint in description.joints.values()}
    found: set[str] = set()
    for name, link in description.links.items():
        while link.inertial is not None and link.inertial.mass and name in above:
            if (name := above[name]) in found:
                break
            found.add(name)
    return found


def _reach(description: Description) -> float:
    """Upper bound of the distance of any two points that the file names [m]."""
    total = sum(
        float(np.linalg.norm(joint.placement[:3, 3])) for joint in description.joints.values()
    )
    return total + sum(
        2.0 * float(np.linalg.norm(link.inertial.placement[:3, 3]))
        for link in description.links.values()
        if link.inertial is not None
    )


def _place(description: Description, link: Link) -> str:
    return f"{description.where}:{link.line}: link {link.name!r}"
