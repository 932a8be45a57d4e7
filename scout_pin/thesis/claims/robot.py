"""Checks of appendix B and of the numbers that the program of appendix D repeats.

A number is held against another print that rests on it: masses against their sum,
a link against its twin in the other leg.
"""

from __future__ import annotations

import re
from functools import partial

import numpy as np

from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.model import Scout, load
from scout_pin.specification import LINK_NAMES, Specification
from scout_pin.thesis.claims.texts import (
    Check,
    array,
    beyond,
    both,
    components,
    quantity,
    statements,
    unreadable,
)
from thesis_pin.audit.judging.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue, Equation
from thesis_pin.errors import NonPhysicalInertia
from thesis_pin.model.mechanism.inertia import check_physical
from thesis_pin.numeric.rotations import rotation

_SIZE = 0.1  # m, the length every error of a length is compared with
_LAST_DIGIT = 0.01e-6  # kg·m², of the printed inertias
_MIRRORS = {"mirrored": np.diag([-1.0, 1.0, 1.0]), "turned": np.diag([-1.0, -1.0, 1.0])}
"""What takes a left link to its twin: the sagittal plane, or half a turn about the vertical."""


def claims(catalogue: Catalogue) -> dict[str, Check]:
    """The checks by name."""
    robot = load()
    return {
        "mass_sum": partial(_mass_sum, catalogue),
        "twin_inertia": partial(_twin_inertia, catalogue),
        "twin_centre": partial(_twin_centre, catalogue),
        "program_lengths": partial(_program_lengths, catalogue),
        "program_beta": partial(_program_beta, catalogue),
        "inertias_as_tensors": statements(
            partial(_as_tensors, robot.specification),
            r"\\text\{inertia tensors about \} \\mathbf\{p\}_\{ni\}",
            r"\\text\{products of inertia about \} .*, off-diagonals positive\}",
        ),
        "diagonal_fixes_pose": statements(
            partial(_diagonal, robot),
            r"\\text\{the position and the diagonal of \} .* \\text\{ fix the pose.*\}",
            r"\\text\{all of \} .* \\text\{ has to be compared\}",
        ),
    }


# -- masses, inertias, centres of mass -------------------------------------------------


def _mass_sum(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """m_T is the torso's mass and twice that of each link."""
    rows = {
        e.left: e.printed[0]
        for e in catalogue.equations
        if e.claim == "mass_sum" and e.id != equation.id
    }
    # Given twice, another mass would be given not at all.
    if equation.left in rows or not re.fullmatch(r"m_(B|T|\{[1-6]i\})", equation.left):
        raise unreadable(equation.left)

    def residual(text: str, left: str) -> float:
        said = {left: quantity(x)[0] for left, x in {**rows, equation.left: text}.items()}
        total = said.pop("m_T")
        links = sum(2 * mass for name, mass in said.items() if name != "m_B")
        return abs(said["m_B"] + links - total) / abs(total)

    return both(equation, residual, "the masses of B.5 add up to m_T")


def _axes(catalogue: Catalogue, number: int, leg: str) -> np.ndarray:
    """Axes of a link's frame in the torso's, servos neutral, by the angles of B.3."""
    turned = np.eye(3)
    for n, axis in zip(range(1, number + 1), "zyzzzx", strict=False):
        angle, _ = quantity(catalogue[f"scout:B.3:beta_{n}{leg}"].printed[0])
        turned = turned @ rotation(axis, np.radians(angle))
    return turned


def _link(left: str) -> tuple[int, str]:
    """Number and leg of the link that a symbol of B.6 or B.7 belongs to."""
    found = re.fullmatch(
        r"\\mathbf\{(?:I\}_\{|r\}_\{G)([1-6])([12])\}\^\{(1|3|5|7|9|11)([12])\}", left
    )
    if not found or found[2] != found[4] or int(found[3]) != 2 * int(found[1]) - 1:
        raise unreadable(left)
    return int(found[1]), found[2]


def _other(catalogue: Catalogue, section: str, kind: str, number: int, leg: str) -> str:
    other = "2" if leg == "1" else "1"
    name = f"scout:{section}:{kind}{number}{other}^{2 * number - 1}{other}"
    return catalogue[name].printed[0]


def _turn(catalogue: Catalogue, number: int, leg: str, kind: str) -> np.ndarray:
    """What takes a link's own axes to its twin's own axes: they differ in signs alone."""
    other = "2" if leg == "1" else "1"
    mine, theirs = (_axes(catalogue, number, side) for side in (leg, other))
    return np.diag(np.round(theirs.T @ _MIRRORS[kind] @ mine))


def _twinned(catalogue: Catalogue, mine: np.ndarray, number: int, leg: str, kind: str) -> float:
    """How far a matrix is from its twin's, zeros' printed signs included; relative."""
    theirs = array(_other(catalogue, "B.6", "I_", number, leg))
    signs = _turn(catalogue, number, leg, kind)
    expected = mine * np.outer(signs, signs)
    zeros = (expected == 0.0) & (theirs == 0.0)
    unlike = zeros & (np.signbit(expected) != np.signbit(theirs))
    gap = float(np.abs(expected - theirs).max()) + _LAST_DIGIT * float(unlike.any())
    return gap / float(np.abs(theirs).max())


def _kind(catalogue: Catalogue, number: int, leg: str) -> str:
    """Whether a link is its twin mirrored or turned, by the matrices of both."""
    mine = array(catalogue[f"scout:B.6:I_{number}{leg}^{2 * number - 1}{leg}"].printed[0])
    gaps = {kind: _twinned(catalogue, mine, number, leg, kind) for kind in _MIRRORS}
    return min(gaps, key=lambda kind: gaps[kind])


def _twin_inertia(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A link's matrix is its twin's, mirrored or turned."""
    number, leg = _link(equation.left)
    kind = _kind(catalogue, number, leg)

    def residual(text: str, left: str) -> float:
        mine = array(text)
        if mine.shape != (3, 3):
            raise unreadable(text)
        return _twinned(catalogue, mine, number, leg, kind)

    return both(equation, residual, f"its twin's, {kind}")


def _twin_centre(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """A link's centre of mass is its twin's, mirrored or turned as its matrix is."""
    number, leg = _link(equation.left)
    kind, other = _kind(catalogue, number, leg), "2" if leg == "1" else "1"
    frame = 2 * number - 1
    theirs = components(_other(catalogue, "B.7", "r_G", number, leg), f"{frame}{other}")
    signs = _turn(catalogue, number, leg, kind)

    def residual(text: str, left: str) -> float:
        gap = components(text, f"{frame}{leg}") * signs - theirs
        return float(np.abs(gap).max() / np.abs(theirs).max())

    return both(equation, residual, f"its twin's, {kind}")


def _as_tensors(specification: Specification) -> ClaimResult:
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


# -- the program's numbers ------------------------------------------------------------------


def _program_lengths(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """The program's lengths [mm] are those of B.2."""
    one = r"\\mathtt\{([xyz])(\d)1\}"
    if not re.fullmatch(rf"\({one}(, {one})*\)", equation.left):
        raise unreadable(equation.left)
    names = re.findall(one, equation.left)
    rows = [catalogue[f"scout:B.2:{x}_{n}i"] for x, n in names]
    theirs = np.array([quantity(row.printed[0])[0] for row in rows])

    def residual(text: str, left: str) -> float:
        if not re.fullmatch(r"\([\d.]+(, [\d.]+)*\)", text):
            raise unreadable(text)
        mine = np.array([float(x) for x in text[1:-1].split(", ")]) * 1e-3
        if mine.shape != theirs.shape:
            raise unreadable(text)
        return beyond(mine - theirs, 1e-12, _SIZE)

    return both(equation, residual)


def _program_beta(catalogue: Catalogue, equation: Equation) -> ClaimResult:
    """The program's constant angles are those of joints 2 to 5."""
    named = re.fullmatch(r"\\beta_\{n([12])\}", equation.left)
    if not named:
        raise unreadable(equation.left)
    leg = named[1]
    rows = [catalogue[f"scout:B.3:beta_{n}{leg}"] for n in range(2, 6)]
    theirs = np.array([quantity(row.printed[0])[0] for row in rows])

    def residual(text: str, left: str) -> float:
        words = re.fullmatch(
            r"\\text\{the program’s \} \\beta_\{1(?P<leg>\d)\} \\ldots \\beta_\{4(?P=leg)\} = "
            r"(?P<angles>\d+°(?:, \d+°){3}) "
            r"\\text\{ are \} \\beta_\{2(?P=leg)\} \\ldots \\beta_\{5(?P=leg)\} "
            r"\\text\{ of B.3\}",
            text,
        )
        if not words or words["leg"] != leg:
            raise unreadable(text)
        mine = np.array([float(x) for x in re.findall(r"\d+(?=°)", words["angles"])])
        return float(np.abs(mine - theirs).max()) / 360

    return both(equation, residual)


def _diagonal(robot: Scout) -> ClaimResult:
    """A rotation and its transpose have one diagonal; a foot can often reach both."""
    generator = np.random.default_rng(4)
    angles = generator.uniform(-0.8, 0.8, (200, 6))
    poses = robot.leg_forward_kinematics("left", angles)
    turned = poses.copy()
    turned[:, :3, :3] = np.swapaxes(poses[:, :3, :3], -1, -2)
    reached = leg_inverse_kinematics(robot.legs["left"], turned).reachable.any(axis=-1)
    apart = np.abs(poses - turned).max(axis=(-1, -2))
    solutions = leg_inverse_kinematics(robot.legs["left"], poses)
    best = np.where(solutions.reachable, solutions.rotation_residual, np.inf).min(axis=-1)
    note = f"in {int(reached.sum())} of 200 random poses the transposed rotation is reachable too"
    wrong = float(apart[reached].max(initial=0.0))
    return ClaimResult(wrong, float(best.max()), note, {"sole's rotation [-]": wrong})
