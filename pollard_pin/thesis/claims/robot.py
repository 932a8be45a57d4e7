"""Checks of the robot's numbers: degrees of freedom, lengths, masses, inertias.

A number printed in the thesis is read from its equation, not repeated here.

Source: Pollard thesis, 2.1, 2.2, chapter 4.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from pollard_pin.dynamics.inverse import inverse_dynamics_at
from pollard_pin.model import Pollard, load
from pollard_pin.motion.curves import appendix_b
from pollard_pin.specification import LINK_NAMES, SKEWED_PATH, Specification
from pollard_pin.thesis.references import References
from thesis_pin.audit.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation, index_values
from thesis_pin.equations.evaluation import evaluate
from thesis_pin.equations.formula import FormulaError, Node, Symbol
from thesis_pin.equations.values import Value, scalar
from thesis_pin.model.mechanism.inertia import parallel_axis

Check = Callable[[Catalogue, Equation, References], ClaimResult]

thesis_robot = functools.cache(load)
"""The thesis's robot, loaded once."""


class Given:
    """An environment of a few named numbers."""

    columns = 6

    def __init__(self, **values: float | np.ndarray) -> None:
        self.values = values

    def lookup(self, symbol: Symbol, indices: dict[str, str]) -> Value:
        """Value of a symbol."""
        name = replace(symbol, kept="").bound(indices).name
        if name not in self.values:
            raise FormulaError(f"the symbol {name} isn't given")
        return scalar(self.values[name])

    def partial(self, of: Node, by: Symbol | None, indices: dict[str, str]) -> Value:
        """Nothing here moves."""
        raise FormulaError("a derivative of given numbers")


def value_of(catalogue: Catalogue, text: str, given: Given) -> np.ndarray:
    """Value of a printed formula; a side chain's is that of chain 1."""
    node = catalogue.parse(text)
    indices = next(index_values(node))
    return evaluate(node, given, indices).array


# -- 2.1, 2.2 ---------------------------------------------------------------------


def _moves(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """Which of T_z1 … T_z6 turn, and about which axis, by the matrices printed below."""
    found = []
    for k in range(1, 7):
        (printed,) = catalogue[f"pollard:2.1:T_z{k}"].printed
        matrix = evaluate(catalogue.parse(printed), closed, {}).array[0]
        turned = matrix[:3, :3] - np.eye(3)
        axis = np.flatnonzero(np.abs(matrix[:3, 3]) if k < 4 else ~turned.any(axis=1))
        found.append(("R" if turned.any() else "T") + "_" + "xyz"[int(axis[0])])
    shares = [
        np.mean([a != b for a, b in zip(text.strip("()").split(", "), found, strict=True)])
        for text in (equation.printed[0], equation.right[1])
    ]
    return ClaimResult(float(shares[0]), float(shares[1]), f"the matrices are {', '.join(found)}")


def counts(robot: Pollard) -> dict[str, int]:
    """Links, joints and their freedoms, counted from the model as the thesis counts.

    Joints of the model without an offset between them are one joint: two revolute ones a
    universal joint, three the wrist. Each loop adds a ball joint.
    """
    offset = [np.linalg.norm(place.translation) for place in robot.model.jointPlacements[1:]]
    root = [parent == 0 for parent in list(robot.model.parents)[1:]]
    joints = sum(bool(far > 1e-9 or first) for far, first in zip(offset, root, strict=True))
    balls = robot.equations // 3
    return {
        "links": joints + 1,
        "joints": joints + balls,
        "freedoms": robot.model.nv + 3 * balls,
    }


def _count(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    number = counts(thesis_robot())[equation.claim.split(":")[1]]
    return ClaimResult(abs(float(equation.printed[0]) - number) / number, note=f"counted: {number}")


@functools.cache
def freedoms() -> dict[str, set[int]]:
    """Degrees of freedom by rank of the loops' Jacobian, at 50 random poses of two robots."""
    generator, found = np.random.default_rng(22), {}
    for robot in (thesis_robot(), load(SKEWED_PATH)):
        poses = np.zeros((200, 6))
        poses[:, :3] = generator.uniform((0.3, -0.2, -0.2), (0.6, 0.2, 0.2), (200, 3))
        poses[:, 3:] = generator.uniform(-0.5, 0.5, (200, 3))
        solved = robot.inverse_kinematics(poses)
        some = solved.angles[solved.valid][:50]
        found[robot.specification.name] = {robot.mobility(q).freedom for q in some}
    return found


def _freedoms(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """The formula gives what the loops leave, robot by robot."""
    worst = 0.0
    for name, ranked in freedoms().items():
        counted = counts(thesis_robot() if name == "pollard" else load(SKEWED_PATH))
        given = Given(b=counted["links"], g=counted["joints"])
        for member in equation.printed:
            text = member.replace(r"\sum_k f_k", str(counted["freedoms"]))
            number = float(value_of(catalogue, text, given))
            worst = max(worst, *(abs(number - freedom) / freedom for freedom in ranked))
    return ClaimResult(worst, note="by rank of the loops at 50 random poses of each of two robots")


# -- chapter 4 --------------------------------------------------------------------


def _expected(specification: Specification) -> Mapping[str, list[float]]:
    """The numbers in use, in the order of the thesis's lists."""
    chain = specification.chain_0
    found = {
        "4.1:chain_0": [chain.z_10, chain.x_32, chain.x_65],
        "4.4:m": [link.mass for link in chain.links],
    }
    names = ("y_10", "z_32", "x_43", "beta_54_deg", "x_87", "x_1211", "z_1312", "beta_1413_deg")
    for k, side in enumerate(specification.side_chains, start=1):
        own = [float(getattr(side, name)) for name in names]
        found[f"4.1:chain_{k}"] = [*own, chain.x_1514, chain.x_1918]
    first, second = ([link.mass for link in side.links] for side in specification.side_chains)
    # One list is printed for both side chains; NaN fails if they should differ.
    found["4.4:m_i"] = first if first == second else [math.nan] * 2
    return found


def _numbers(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """Printed lists against the numbers in use."""
    printed = np.array([float(x) for x in equation.printed[0].strip("()").split(",")])
    used = np.array(_expected(thesis_robot().specification)[equation.id.partition(":")[2]])
    return ClaimResult(float(np.abs(printed - used).max()), note="the numbers in use")


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


def _inertia(catalogue: Catalogue, equation: Equation, closed: References) -> ClaimResult:
    """A printed matrix as chapter 3 uses it, about the centre of gravity of its link."""
    specification, name = thesis_robot().specification, equation.claim.split(":")[1]
    link = name if name in specification.links else f"chain1_{name}"
    mass, span = specification.links[link].mass, specification.span(link)
    given = Given(m_21=mass, x_871=span * 1e3)
    tensor = value_of(catalogue, equation.printed[0], given) * 1e-6
    used = np.array(specification.links[link].inertia)
    differs = float(np.abs(tensor - used).max() / np.abs(used).max())
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


CHECKS: Mapping[str, Check] = {
    "moves": _moves,
    "count": _count,
    "freedoms": _freedoms,
    "numbers": _numbers,
    "inertia": _inertia,
}
"""Checks by the first part of a claim's name."""
