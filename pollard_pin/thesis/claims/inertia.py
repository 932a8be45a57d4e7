"""Check of the printed inertias: whose they are, and whether they can be a body's.

Source: Pollard thesis, 4.4.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.model import load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import LINK_NAMES, Specification
from pollard_pin.thesis.claims.given import Check, Given, thesis_robot, value_of
from pollard_pin.thesis.references import References
from pollard_pin.thesis.symbols.bodies import BODIES, own_frame
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.equations.formula import FormulaError
from thesis_pin.model.mechanism.inertia import parallel_axis

_SAMPLES = 101  # of the default path
WRIST = ("wrist_roll_link", "wrist_yaw_link", "tool")
"""Bodies whose ends the thesis doesn't give."""


def impossibility(tensor: np.ndarray, mass: float, length: float | None) -> float:
    """By how much a tensor about the centre of gravity is no body's; 0 if it can be one's.

    Args:
        tensor: [kg·m²], shape ``(3, 3)``.
        mass: [kg].
        length: Of a body between its ends on the x axis [m]; None if not known.
    """
    scale = float(np.trace(tensor))
    moments = np.linalg.eigvalsh(tensor)
    worst = max(0.0, -moments[0], moments[2] - moments[0] - moments[1]) / scale
    if length is not None:
        worst = max(worst, spread(tensor, mass) / (length / 2) - 1.0)
    return float(worst)


def spread(tensor: np.ndarray, mass: float) -> float:
    """Root mean square distance of the mass from the tensor's point along x [m]."""
    second = (tensor[1, 1] + tensor[2, 2] - tensor[0, 0]) / 2
    return math.sqrt(max(0.0, second) / mass)  # a negative one shows in the moments


def _inertia(catalogue: Catalogue, closed: References, equation: Equation) -> ClaimResult:
    """A printed matrix as chapter 3 uses it, about the centre of gravity of its link."""
    specification, name = thesis_robot().specification, equation.claim.split(":")[1]
    link = name if name in specification.links else f"chain1_{name}"
    if link_of(catalogue, equation.left) != link:
        raise FormulaError(f"{equation.left} isn't the inertia of the {name} in its own frame")
    mass, span = specification.links[link].mass, specification.span(link)
    given = Given(m_21=mass, x_871=span * 1e3)
    tensor = value_of(catalogue, equation.printed[0], given) * 1e-6
    # The matrix as transcribed, or what the robot has in its place.
    known = np.array(specification.links[link].inertia), specification.centroidal(link)
    differs = min(float(np.abs(tensor - one).max() / np.abs(one).max()) for one in known)
    length = None if name in WRIST else span
    printed = max(differs, impossibility(tensor, mass, length))
    far = spread(tensor, mass) * 1e3
    if length is None:
        note = f"the mass lies {far:.0f} mm from the centre of gravity in the mean: a body of at "
        note += f"least {2 * far:.0f} mm, and the thesis gives its size nowhere"
        return ClaimResult(printed, note=note + _twin(specification, link))
    middle = np.array([span / 2, 0.0, 0.0])
    readings = {
        "its centre of gravity": tensor,
        "its joint": tensor - parallel_axis(mass, middle),
    }
    possible = [name for name, of in readings.items() if impossibility(of, mass, span) == 0]
    note = (
        f"the mass lies {far:.0f} mm from the tensor's point in the mean, on a link of "
        f"{span * 1e3:.0f} mm; with the centre of gravity in the middle it can be meant about "
        + (" or ".join(possible) or "no point: neither its centre of gravity nor its joint")
    )
    if not equation.right:
        return ClaimResult(printed, note=note)
    right = value_of(catalogue, equation.right[1], given) * 1e-6
    bodies = [link] if link == name else [f"chain{k}_{name}" for k in (1, 2)]
    effect: dict[str, float | str] = {
        "path torque [N·m]": torque_change(specification, bodies),
    }
    return ClaimResult(printed, impossibility(right, mass, length), note, effect)


def link_of(catalogue: Catalogue, left: str) -> str:
    """Link whose inertia in its own frame a symbol is: J_2^5 the forearm's, J_1^{2i} an arm's.

    An arm's own frame 3i has the axes of 2i, and 4.4 names the latter.
    """
    symbol = catalogue.notation.symbol(left)
    chain = "1" if symbol.sup.endswith("i") else ""
    body = symbol.sub.removesuffix("i") + chain
    frame = own_frame(body)[0] if body in BODIES else ""
    plain = symbol.base == "J" and not (symbol.dots or symbol.primes)
    known = plain and symbol.sup == ("2i" if frame == "3i" else frame)
    return LINK_NAMES[BODIES.index(body)] if known else ""


def torque_change(specification: Specification, bodies: list[str]) -> float:
    """Largest change of a motor's torque on the default path [N·m] by following the print.

    Args:
        specification: The robot.
        bodies: Those whose printed matrix is then used about the centre of gravity.
    """
    data: dict[str, Any] = specification.model_dump()
    kept = [x for x in data["assumptions"]["replaced_inertias"] if x["link"] not in bodies]
    data["assumptions"]["replaced_inertias"] = kept
    chains = ("chain_0", "chain_1", "chain_2")
    links = [link for chain in chains for link in data[chain]["links"]]
    for name, link in zip(LINK_NAMES, links, strict=True):
        if name in bodies:
            link["inertia_convention"] = "tensor_about_com"
    motion = appendix_b(specification).sample(_SAMPLES)
    torques = []
    for robot in (load(specification), load(Specification.model_validate(data))):
        q, v, a = robot.joint_motion(motion.pose, motion.rate, motion.acceleration)
        torques.append(inverse_dynamics_at(robot, q, v, a).torque)
    return float(np.abs(torques[1] - torques[0]).max())


def _twin(specification: Specification, link: str) -> str:
    own = specification.links[link]
    for other in WRIST:
        body = specification.links[other]
        if body.inertia == own.inertia and body.mass != own.mass:
            return f"; the same to the digit as that of {other}, {body.mass:g} kg for {own.mass:g}"
    return ""


CHECKS: Mapping[str, Check] = {"inertia": _inertia}
"""Checks by the first part of a claim's name."""
