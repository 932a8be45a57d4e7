"""Interpolation of tabulated curves as piecewise polynomials with exact derivatives.

Every method returns a :class:`~thesis_pin.numeric.piecewise.Piecewise`, so that values, rates
and accelerations come from one object; its ``ppoly`` is SciPy's, for all of SciPy's tools.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.splines import resting_cubic, resting_quintic, solvable
from thesis_pin.tolerances import TOLERANCES

MOST_COEFFICIENTS = 32
"""Coefficients of a polynomial at most; more can't be evaluated in doubles anyway."""


def _nodes(t: ArrayLike, value: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and values of a curve, checked; each ``(n,)``."""
    nodes, values = finite_array("t", t, None), finite_array("value", value, None)
    if nodes.ndim != 1 or values.shape != nodes.shape or nodes.size < 2:
        raise TrajectoryError(
            f"{nodes.size} nodes and {values.size} values",
            allowed="as many values as nodes, at least 2",
        )
    short = ~(np.diff(nodes) >= TOLERANCES.step)
    if short.any():
        k = int(np.argmax(short))
        raise TrajectoryError(
            f"time goes from {nodes[k]:.12g} to {nodes[k + 1]:.12g} at node {k + 1}",
            allowed=f"strictly increasing t, in steps of at least {TOLERANCES.step:g}",
        )
    return nodes, values


def quadratic(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Quadratic spline whose first piece is a straight line; C¹.

    Args:
        t: Nodes, strictly increasing, shape ``(n,)``, n ≥ 2.
        value: Values at the nodes, shape ``(n,)``.

    Returns:
        Piecewise polynomial in t.

    Source: Scout thesis, appendix C, equations C.2–C.5. The 3m equations are
    solved piece by piece: each piece starts with the slope of the one before.
    """
    nodes, values = _nodes(t, value)
    width, rise = np.diff(nodes), np.diff(values)
    coefficients = np.zeros((3, len(width)))
    slope = rise[0] / width[0]
    for k in range(len(width)):
        curvature = (rise[k] - slope * width[k]) / width[k] ** 2 if k else 0.0
        coefficients[:, k] = curvature, slope, values[k]
        slope += 2 * curvature * width[k]
    return Piecewise(coefficients, nodes)


def linear(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Straight lines between the nodes; C⁰, so rates jump at every node."""
    nodes, values = _nodes(t, value)
    return Piecewise(np.stack([np.diff(values) / np.diff(nodes), values[:-1]]), nodes)


def cubic(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Cubic spline, C², at rest at both ends."""
    nodes, values = _nodes(t, value)
    if solvable(nodes):
        return resting_cubic(nodes, values)
    from scipy.interpolate import CubicSpline

    return _ours(CubicSpline(nodes, values, bc_type="clamped"))


def free(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Cubic spline through samples of a motion that goes on at both ends (not-a-knot), C²."""
    from scipy.interpolate import CubicSpline

    return _ours(CubicSpline(*_nodes(t, value), bc_type="not-a-knot"))


def quintic(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Quintic spline, C⁴, with zero rate and acceleration at both ends."""
    nodes, values = _nodes(t, value)
    if solvable(nodes):
        return resting_quintic(nodes, values)
    from scipy.interpolate import PPoly, make_interp_spline

    ends = [(1, 0.0), (2, 0.0)]
    return _ours(PPoly.from_spline(make_interp_spline(nodes, values, k=5, bc_type=(ends, ends))))


def free_quintic(t: ArrayLike, value: ArrayLike) -> Piecewise:
    """Quintic spline through samples of a motion that goes on at both ends, C⁴; cubic below six."""
    nodes, values = _nodes(t, value)
    if len(nodes) < 6:
        return free(nodes, values)
    from scipy.interpolate import PPoly, make_interp_spline

    return _ours(PPoly.from_spline(make_interp_spline(nodes, values, k=5)))


def hermite(t: ArrayLike, ends: Sequence[tuple[np.ndarray, np.ndarray]]) -> Piecewise:
    """Quintic pieces with given values, rates and accelerations at both of their ends.

    Args:
        t: Knots, strictly increasing, shape ``(n + 1,)``.
        ends: Values, then rates, then accelerations, each where pieces begin and where they
            end, ``(n,)``.
    """
    knots = np.asarray(t, dtype=float)
    h = np.diff(knots)
    (a, b), (da, db), (dda, ddb) = ends
    rise = (b - a - da * h - dda * h**2 / 2) / h**3
    slope = (db - da - dda * h) / h**2
    bend = (ddb - dda) / h
    rows = [
        (6 * rise - 3 * slope + bend / 2) / h**2,
        (-15 * rise + 7 * slope - bend) / h,
        10 * rise - 4 * slope + bend / 2,
        dda / 2,
        da,
        a,
    ]
    return Piecewise(np.stack(rows), knots)


def _ours(curve: Any) -> Piecewise:
    """One of SciPy's splines as one of ours, without its pieces of no length."""
    lasts = np.diff(curve.x) > 0
    return Piecewise(curve.c[:, lasts], np.append(curve.x[:-1][lasts], curve.x[-1]))


METHODS: dict[str, Callable[[ArrayLike, ArrayLike], Piecewise]] = {
    "linear": linear,
    "quadratic": quadratic,
    "cubic": cubic,
    "free": free,
    "quintic": quintic,
}
"""Methods by the names used in files and on the command line."""


def interpolate(t: ArrayLike, value: ArrayLike, method: str = "quadratic") -> Piecewise:
    """Curve through nodes by a named method.

    Args:
        t: Nodes, strictly increasing, shape ``(n,)``, n ≥ 2.
        value: Values at the nodes, shape ``(n,)``.
        method: One of :data:`METHODS`.

    Returns:
        Piecewise polynomial in t; at an inner node the piece on its right holds.

    Raises:
        UnknownName: No such method.
        TrajectoryError: Too few nodes, unequal lengths or t not increasing.
        NotFinite: A node or value is NaN or infinite.
    """
    choice("interpolation", method, list(METHODS))
    return METHODS[method](t, value)


def constant(start: float, end: float, value: float) -> Piecewise:
    """A curve that stays at one value."""
    return Piecewise(np.array([[value]]), np.array([start, end]))


def polynomial(start: float, end: float, coefficients: Sequence[float]) -> Piecewise:
    """One piece given by its coefficients in t itself, highest power first.

    The theses print their splines that way; ours count from a piece's start.
    """
    if len(coefficients) > MOST_COEFFICIENTS:
        raise TrajectoryError(
            f"a polynomial has {len(coefficients)} coefficients",
            allowed=f"at most {MOST_COEFFICIENTS}",
        )
    with np.errstate(over="ignore", invalid="ignore"):
        shifted = np.poly1d(coefficients)(np.poly1d([1.0, start]))
    if not np.isfinite(np.poly1d(shifted).coeffs).all():
        raise TrajectoryError(
            f"a polynomial overflows between t = {start:g} and {end:g}",
            remedy="Give coefficients and times of usual size",
        )
    return Piecewise(np.atleast_1d(np.poly1d(shifted).coeffs)[:, None], np.array([start, end]))


def jumps(curve: Piecewise, order: int = 0) -> np.ndarray:
    """Jumps of a curve, or of a derivative, at its inner knots, shape ``(knots − 2,)``."""
    derivative = curve.derivative(order) if order else curve
    width = np.diff(curve.x)[:-1]
    before = np.zeros(len(width))
    for coefficient in derivative.c[:, :-1]:
        before = before * width + coefficient
    return np.asarray(derivative(curve.x[1:-1]) - before)


def join(pieces: Sequence[Piecewise]) -> Piecewise:
    """Curves that follow each other, as one piecewise polynomial.

    Args:
        pieces: Each begins where the one before ends.

    Returns:
        One curve; values may jump at a joint, where the later piece holds.
    """
    order = max(piece.c.shape[0] for piece in pieces)
    padded = [
        np.concatenate([np.zeros((order - len(piece.c), *piece.c.shape[1:])), piece.c])
        for piece in pieces
    ]
    knots = np.concatenate([pieces[0].x, *(piece.x[1:] for piece in pieces[1:])])
    return Piecewise(np.concatenate(padded, axis=1), knots)
