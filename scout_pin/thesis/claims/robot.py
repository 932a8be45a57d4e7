"""Checks of appendix B: masses, angles, soles, symmetry, inertias."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

import numpy as np

from scout_pin.model import Scout, load
from scout_pin.specification import LINK_NAMES, Specification
from scout_pin.thesis.claims.tables import beyond
from thesis_pin.audit.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.mechanism.inertia import check_physical


def claims(catalogue: Catalogue) -> dict[str, Callable[[], ClaimResult]]:
    """The checks by name."""
    robot = load()
    return {
        "mass_sum": partial(_mass_sum, catalogue, robot.specification),
        "neutral_pose": partial(_neutral_pose, robot),
        "soles": partial(_soles, robot.specification),
        "mirror": partial(_mirror, robot),
        "inertias_as_tensors": partial(_inertias_as_tensors, robot.specification),
    }


def _mass_sum(catalogue: Catalogue, specification: Specification) -> ClaimResult:
    printed = float(re.match(r"[\d.]+", catalogue["scout:B.5:m_T"].printed[0])[0]) * 1e-3  # type: ignore[index]
    return ClaimResult(abs(specification.mass - printed) / printed)


def _neutral_pose(robot: Scout) -> ClaimResult:
    feet = robot.neutral_feet().values()
    return ClaimResult(max(float(np.abs(foot[:3, :3] - np.eye(3)).max()) for foot in feet))


def _soles(specification: Specification) -> ClaimResult:
    left, right = (sorted(specification.leg(side).sole) for side in ("left", "right"))
    gap = np.array(right) - np.array(left) - [18.15e-3, 0.0]
    return ClaimResult(beyond(gap, 1e-12, 0.1))


def _mirror(robot: Scout) -> ClaimResult:
    """Right links are the left ones mirrored in the sagittal plane, or turned about z."""
    specification, worst, turned = robot.specification, 0.0, []
    flip = {"mirrored": np.diag([-1.0, 1.0, 1.0]), "turned": np.diag([-1.0, -1.0, 1.0])}
    axes = {side: _neutral_axes(specification, side) for side in ("left", "right")}
    for n in range(6):
        gaps = {}
        for kind, change in flip.items():
            sides = []
            for side in ("left", "right"):
                link, R = specification.leg(side).links[n], axes[side][n]
                tensor = link.centroidal(specification.inertia_convention, "physical")
                sides.append((R @ np.array(link.com), R @ tensor @ R.T, link.mass))
            (com, tensor, mass), (other, other_tensor, other_mass) = sides
            gaps[kind] = max(
                float(np.abs(change @ com - other).max()) / 0.05,
                float(np.abs(change @ tensor @ change - other_tensor).max()) / 1e-4,
                abs(mass - other_mass) / mass,
            )
        best = min(gaps, key=lambda kind: gaps[kind])
        worst = max(worst, gaps[best])
        if best == "turned":
            turned.append(LINK_NAMES[n])
    note = f"turned by 180° about the vertical instead of mirrored: {', '.join(turned) or 'none'}"
    return ClaimResult(worst, note=note)


def _neutral_axes(specification: Specification, side: str) -> list[np.ndarray]:
    """Axes of the six link frames in the torso's, servos neutral."""
    from thesis_pin.numeric.rotations import rotation

    turned, frames = np.eye(3), []
    for axis, angle in zip("zyzzzx", specification.leg(side).beta_deg, strict=True):
        turned = turned @ rotation(axis, np.radians(angle))
        frames.append(turned)
    return frames


def _inertias_as_tensors(specification: Specification) -> ClaimResult:
    """How many of the 13 printed matrices no body can have, read either way."""
    bodies = {"torso": specification.torso}
    for side in ("left", "right"):
        bodies |= {
            f"{side} {name}": link
            for name, link in zip(LINK_NAMES, specification.leg(side).links, strict=True)
        }
    impossible: dict[str, list[str]] = {"tensor_about_joint": [], "products_about_joint": []}
    for convention, names in impossible.items():
        for name, link in bodies.items():
            tensor = link.centroidal(convention, "physical")  # type: ignore[arg-type]
            try:
                check_physical(name, link.mass, np.array(link.com), tensor)
            except NonPhysicalInertia:
                names.append(name)
    tensors, products = impossible.values()
    note = f"impossible as tensors: {', '.join(tensors)}"
    return ClaimResult(len(tensors) / len(bodies), len(products) / len(bodies), note)
