"""Checks of the thesis's tables, splines and program.

Each function is called by the equation whose ``claim`` names it, and returns
residuals; a number printed in the thesis is read from that equation, not
repeated here. Rounded numbers are compared to within their last digit: only
what exceeds it counts.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from scout_pin.kinematics.inverse import leg_inverse_kinematics
from scout_pin.model import Scout, load
from scout_pin.motion.files import load_gait
from scout_pin.motion.gait import Gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import Specification
from thesis_pin.audit.verdicts import ClaimResult
from thesis_pin.equations.catalogue import Catalogue
from thesis_pin.numeric.interpolation import quadratic

_HERE = Path(__file__).parents[1] / "printed"
_STEP = 52.26  # mm, the length every error of a spline is compared with
_CURVES = {
    "y_B": ("torso", 1),
    "y_1": ("left_foot", 1),
    "z_1": ("left_foot", 2),
    "y_2": ("right_foot", 1),
    "z_2": ("right_foot", 2),
}
# A term of a printed polynomial: sign, coefficient (decimal or \frac), power of t.
_TERM = re.compile(r"([+-]?)\s*(?:\\frac\{(\d+)\}\{(\d+)\}|(\d+(?:\.\d+)?))?(t\^2|t)?")


def claims(catalogue: Catalogue) -> dict[str, Callable[[], ClaimResult]]:
    """The checks by name."""
    robot, exact, program = load(), load_gait("thesis"), load_gait("thesis-program")
    found: dict[str, Callable[[], ClaimResult]] = {
        f"spline_{name}": partial(_spline, catalogue, name, number, exact)
        for number, name in enumerate(_CURVES, start=2)
    }
    return found | {
        "left_foot_sign": partial(_left_foot_sign, robot),
        "gait_constants": partial(_gait_constants, robot),
        "table_5_1": partial(_table, exact),
        "constant_angles": _constant_angles,
        "spline_system": _spline_system,
        "figure_c_1": partial(_figure_c_1, catalogue),
        "program_beta": partial(_program_beta, robot.specification),
        "program_y_b": partial(_program_y_b, catalogue),
        "program_splines": partial(_program_splines, catalogue, program),
        "initial_angles": partial(_printed_angles, robot, program, first_only=True),
        "printed_angles": partial(_printed_angles, robot, program, first_only=False),
        "diagonal_fixes_pose": partial(_diagonal, robot),
    }


def beyond(error: np.ndarray | float, allowed: np.ndarray | float, scale: float) -> float:
    """What an error exceeds rounding by, relative to a scale."""
    return float(np.max(np.maximum(np.abs(error) - allowed, 0.0), initial=0.0)) / scale


# -- chapter 5 ------------------------------------------------------------------


def printed_pieces(formula: str) -> list[tuple[float, float, np.ndarray, np.ndarray]]:
    """Pieces of a printed spline: from, to, coefficients of t², t, 1, half their last digit."""
    inside = formula.split(r"\begin{cases}")[1].split(r"\end{cases}")[0]
    pieces = []
    for line in inside.split(r"\\"):
        text, interval = line.split(r"; &")
        start, end = re.fullmatch(r"\s*(\d+) \\leq t (?:<|\\leq) (\d+)\s*", interval).groups()  # type: ignore[union-attr]
        pieces.append((float(start), float(end), *_polynomial(text)))
    return pieces


def _polynomial(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of t², t, 1 and half their last digit."""
    values, half = np.zeros(3), np.zeros(3)
    for sign, above, below, decimal, power in _TERM.findall(text):
        if not (above or decimal or power):
            continue
        k = {"t^2": 0, "t": 1, "": 2}[power]
        value = float(above) / float(below) if above else float(decimal or 1)
        values[k] = -value if sign == "-" else value
        half[k] = 0.5 * 10.0 ** -len(decimal.partition(".")[2]) if "." in decimal else 0.0
    return values, half


def _spline(catalogue: Catalogue, name: str, number: int, exact: Gait) -> ClaimResult:
    """A printed spline is the one of appendix C through the nodes it was built from."""
    body, axis = _CURVES[name]
    worst = 0.0
    for start, end, values, half in printed_pieces(catalogue[f"scout:5:5.{number}"].printed[0]):
        t = np.linspace(start, end, 50, endpoint=False)
        powers = np.stack([t**2, t, np.ones_like(t)])
        truth = exact.curves[body][axis](t) * 1e3
        # 38.5 and the like are the table's own numbers; they carry no rounding.
        worst = max(worst, beyond(values @ powers - truth, half @ powers, _STEP))
    return ClaimResult(worst, note="the spline through its own nodes, to the digits printed")


def _table_rows() -> list[dict[str, str]]:
    lines = (_HERE / "table_5_1.csv").read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def _table(exact: Gait) -> ClaimResult:
    """Which values of table 5.1 the splines miss, and that the nodes are met."""
    missed, at_nodes, worst = [], 0.0, 0.0
    for row in _table_rows():
        t = float(row["t"])
        for name, (body, axis) in _CURVES.items():
            if row[name] == "-":
                continue
            curve = exact.curves[body][axis]
            # At a node two pieces meet; the table's value is the end of one of them.
            gap = min(abs(float(curve(at)) * 1e3 - float(row[name])) for at in (t, t - 1e-12))
            worst = max(worst, gap)
            if np.isclose(curve.x, t).any() and (name, t) != ("y_B", 25.0):
                at_nodes = max(at_nodes, gap)
            if gap > 1e-6:
                missed.append(f"{name}({t:g}) by {gap:.2f} mm")
    return ClaimResult(
        worst / _STEP,
        beyond(at_nodes, 1e-9, _STEP),
        "missed: " + ", ".join(missed),
        {"foot's path [m]": worst * 1e-3},
    )


def _left_foot_sign(robot: Scout) -> ClaimResult:
    """With joints 1, 2 and 6 at zero the left foot stays at x = −x_0."""
    place = robot.neutral_feet()["left"][0, 3] * 1e3
    effect = {"left foot's place [m]": abs(place - 44.54) * 1e-3}
    return ClaimResult(abs(place - 44.54) / 44.54, abs(place + 44.54) / 44.54, effect=effect)


def _gait_constants(robot: Scout) -> ClaimResult:
    """At the angles printed for t = 0 the soles are where (5.1) and table 5.1 put them."""
    angles, half = _angles()
    feet = robot.forward_kinematics(np.radians(angles[0]))
    gap = max(
        np.abs(feet[side][:3, 3] - [sign * 44.54e-3, -38.5e-3, -234.37e-3]).max()
        for side, sign in (("left", -1), ("right", 1))
    )
    return ClaimResult(beyond(gap, 6 * 0.3 * np.radians(half[0]).max(), 0.2))


def _angles() -> tuple[np.ndarray, np.ndarray]:
    """The printed angles [deg] ``(41, 12)`` and half their last digit."""
    lines = (_HERE / "printed_angles.csv").read_text(encoding="utf-8").splitlines()
    rows = [line.split(",")[1:] for line in lines if line[0].isdigit()]
    half = [[0.5 * 10.0 ** -len(cell.partition(".")[2]) for cell in row] for row in rows]
    # "0." is Mathematica's machine zero, not a rounded number.
    exact = [
        [0.0 if float(cell) == 0 else h for cell, h in zip(row, halves, strict=True)]
        for row, halves in zip(rows, half, strict=True)
    ]
    return np.array(rows, dtype=float), np.array(exact)


def _constant_angles() -> ClaimResult:
    angles, _ = _angles()
    return ClaimResult(float(np.abs(angles[:, [0, 1, 5, 6, 7, 11]]).max()))


def _printed_angles(robot: Scout, program: Gait, *, first_only: bool) -> ClaimResult:
    """The printed angles come out of the program's splines by closed-form kinematics."""
    angles, half = _angles()
    t = np.arange(1.0 if first_only else 41.0)
    found = np.degrees(joint_trajectory(robot, program.sample(t)).q)
    gap = np.abs(found - angles[: len(t)])
    # The program's own solver stops short of the root by up to 2e-6 degrees.
    residual = beyond(gap, half[: len(t)] + 2e-6, 1.0)
    return ClaimResult(
        residual, note=f"{angles[: len(t)].size} angles, largest gap {gap.max():.1e}°"
    )


# -- appendices C and D -----------------------------------------------------------


def solve_spline_system(t: np.ndarray, value: np.ndarray) -> np.ndarray:
    """(C.3), (C.4), (C.5) as one linear system: coefficients ``(m, 3)`` of t², t, 1."""
    m = len(t) - 1
    system, right = np.zeros((3 * m, 3 * m)), np.zeros(3 * m)
    for i in range(m):  # (C.3)
        for k in (0, 1):
            system[2 * i + k, 3 * i : 3 * i + 3] = t[i + k] ** 2, t[i + k], 1.0
            right[2 * i + k] = value[i + k]
    for i in range(1, m):  # (C.4)
        system[2 * m + i - 1, 3 * i - 3 : 3 * i - 1] = 2 * t[i], 1.0
        system[2 * m + i - 1, 3 * i : 3 * i + 2] = -2 * t[i], -1.0
    system[-1, 0] = 1.0  # (C.5)
    return np.linalg.solve(system, right).reshape(m, 3)


def _nodes(name: str, times: tuple[float, ...]) -> np.ndarray:
    table = {float(row["t"]): row[name] for row in _table_rows()}
    return np.array([float(table[t]) for t in times])


def _spline_system() -> ClaimResult:
    """The printed system determines a spline: it interpolates and is C¹."""
    t = np.array([0.0, 15.0, 20.0, 24.0])
    value = _nodes("y_B", tuple(t))
    found, curve = solve_spline_system(t, value), quadratic(t.tolist(), value.tolist())
    inside = np.linspace(0, 24, 97)[:-1]
    piece = np.searchsorted(t, inside, side="right") - 1
    powers = np.stack([inside**2, inside, np.ones_like(inside)], axis=-1)
    return ClaimResult(float(np.abs((found[piece] * powers).sum(-1) - curve(inside)).max()) / _STEP)


def _figure_c_1(catalogue: Catalogue) -> ClaimResult:
    text = catalogue["scout:C.2:figure_C.1"].printed[0]
    cells = re.findall(r"-?\d+(?:\.\d+)?", text)
    printed = np.array(cells, dtype=float).reshape(3, 3)
    half = np.array([0.5 * 10.0 ** -len(cell.partition(".")[2]) for cell in cells]).reshape(3, 3)
    times = (0.0, 15.0, 20.0, 24.0)
    found = solve_spline_system(np.array(times), _nodes("y_B", times))
    return ClaimResult(beyond(found - printed, half, 1.0))


def _program_beta(specification: Specification) -> ClaimResult:
    printed = {"left": (90, 330, 60, 45), "right": (90, 30, 300, 315)}
    gap = [np.subtract(specification.leg(s).beta_deg[1:5], p) for s, p in printed.items()]
    return ClaimResult(float(np.abs(gap).max()) / 360)


def _program_y_b(catalogue: Catalogue) -> ClaimResult:
    """The program's third piece of y_B against the one (5.2) prints."""
    row = catalogue["scout:D:y_B"]
    _, _, text, text_half = printed_pieces(catalogue["scout:5:5.2"].printed[0])[2]
    (own, half), (right, _) = (_polynomial(formula) for formula in (row.printed[0], row.right[1]))
    t = np.linspace(20, 25, 200, endpoint=False)
    apart = np.abs((own - text) @ np.stack([t**2, t, np.ones_like(t)])).max()
    residual = beyond((own - text) / text, (half + text_half) / np.abs(text), 1.0)
    note = f"other coefficients, though the curves stay within {apart:.3f} mm of each other"
    return ClaimResult(
        residual, float(np.abs(right - text).max()), note, {"torso's path [m]": float(apart) * 1e-3}
    )


def _program_splines(catalogue: Catalogue, program: Gait) -> ClaimResult:
    """Every piece of the program's splines but the third of y_B, as printed in the text."""
    worst, count = 0.0, 0
    for number, (name, (body, axis)) in enumerate(_CURVES.items(), start=2):
        pieces = printed_pieces(catalogue[f"scout:5:5.{number}"].printed[0])
        for k, (start, end, values, _) in enumerate(pieces):
            if (name, k) == ("y_B", 2):
                continue
            t = np.linspace(start, end, 40, endpoint=False)
            own = program.curves[body][axis](t) * 1e3
            apart = np.abs(values @ np.stack([t**2, t, np.ones_like(t)]) - own).max()
            worst, count = max(worst, float(apart)), count + 1
    return ClaimResult(worst / _STEP, note=f"{count} pieces")


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
