"""Times from the speed of the tool along a curve through positions.

The curve is a spline over the length of its chords. Along it the tool moves at the speed
that is asked for, between the ramps of a timing law at its ends.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from pollard_pin.motion.path import (
    PEAK,
    Curve,
    Sampled,
    Timing,
    ToolPath,
    Triple,
    driven,
    timing_law,
)
from pollard_pin.motion.samples import through_orientations
from thesis_pin.errors import TrajectoryError, WrongShape
from thesis_pin.numeric.arrays import finite_array
from thesis_pin.numeric.checks import choice
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.numeric.splines import hermite_quintic
from thesis_pin.tolerances import TOLERANCES

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

Speed = float | np.ndarray
"""One tool speed, or one at each position [m/s]."""

_PIECES = 8  # parts of a chord over which time is integrated …
_MOST = 200_000  # … unless a path had more parts than this

_BACK = 0.05
"""Length of a spline over that of its chord below which it turns back on itself."""


def at_speed(
    position: np.ndarray,
    rotation: np.ndarray,
    speed: Speed,
    timing: Timing = "ramped",
    *,
    written: np.ndarray | None = None,
    where: Callable[[int], str] = "pose {}".format,
    name: str = "positions at a speed",
) -> ToolPath:
    """A path through positions and orientations at a tool speed.

    Args:
        position: Of the spray tip [m], shape ``(n, 3)``.
        rotation: Orientations of the tool, shape ``(n, 3, 3)``.
        speed: Of the spray tip [m/s]: one, or one at each position, between which it
            changes smoothly.
        timing: ``"ramped"`` or ``"rest-to-rest"``, where the speed is the highest, or
            ``"constant-rate"``, where it is the speed from beginning to end.
        written: ψ, θ, φ as they were given, see
            :func:`pollard_pin.motion.samples.through_orientations`.
        where: Says where a pose stands, given its number, for messages.
        name: For reports.

    Raises:
        TrajectoryError: Two positions in a row are one, the path turns back on itself, or a
            speed isn't positive.
    """
    choice("timing", timing, tuple(PEAK))
    position = finite_array("position", position, None, 3)
    speeds = finite_array("speed", speed)
    if speeds.shape not in ((), (len(position),)):
        raise WrongShape("speed", speeds.shape, f"() or ({len(position)},), as positions")
    speeds = np.broadcast_to(speeds, (len(position),))
    if not (speeds > 0).all():
        k = int(np.argmin(speeds > 0))
        raise TrajectoryError(
            f"the tool speed is {speeds[k]:g} m/s", where=where(k), allowed="a positive speed"
        )
    chords = np.linalg.norm(np.diff(position, axis=0), axis=1)
    if (chords < TOLERANCES.step).any():
        raise TrajectoryError(
            "the spray tip stays where it was, and a speed gives that no time",
            where=where(int(np.argmax(chords < TOLERANCES.step)) + 1),
            remedy="Leave the pose out, or give times instead of a speed",
        )
    along = np.concatenate([[0.0], np.cumsum(chords)])
    shape = through_orientations(
        along, position, rotation, "free", written=written, where=where, name=name
    )
    law = _steady(shape.function, along, speeds, where)
    whole = float(law.x[-1])
    duration = whole * PEAK[timing]
    steady = partial(driven, shape.function, partial(_scaled, law, whole))
    made = {
        "tool_speed": [float(speeds.min()), float(speeds.max())],
        "timing": timing,
        "duration": duration,
    }
    return ToolPath(
        name,
        duration,
        partial(driven, steady, partial(timing_law, timing, duration)),
        shape.parameters | made,
        (*shape.notes, _told(speeds, timing, _bulge(shape.function, along, position))),
        curves=(Curve(float(along[-1]), shape.function),),
    )


def _bulge(
    curve: Callable[[np.ndarray], Sampled], along: np.ndarray, position: np.ndarray
) -> float:
    """How far the middles of the curve's pieces lie from those of their chords, at most [m]."""
    middle = curve((along[1:] + along[:-1]) / 2)[0].position
    return float(np.linalg.norm(middle - (position[1:] + position[:-1]) / 2, axis=1).max())


def _told(speeds: np.ndarray, timing: Timing, bulge: float) -> str:
    least, most = speeds.min() * 1e3, speeds.max() * 1e3
    speed = f"{most:.6g}" if f"{least:.6g}" == f"{most:.6g}" else f"{least:.6g} to {most:.6g}"
    ends = {
        "ramped": "from rest to rest, with ramps over the first and last tenth of the time",
        "rest-to-rest": "from rest to rest, which is reached halfway only",
        "constant-rate": "from beginning to end",
    }
    return (
        f"times are made from a tool speed of {speed} mm/s, {ends[timing]}; the curve through the "
        f"positions leaves the straight lines between them by up to {bulge * 1e3:.3g} mm"
    )


def _steady(
    curve: Callable[[np.ndarray], Sampled],
    along: np.ndarray,
    speeds: np.ndarray,
    where: Callable[[int], str],
) -> Piecewise:
    """The parameter of a curve over the time it takes at its speeds, without ramps.

    Of the quintic that has value, rate and acceleration at each part's ends.
    """
    pieces = max(1, min(_PIECES, _MOST // len(along)))
    steps = np.diff(along)[:, None] * (np.arange(pieces) / pieces)
    places = np.append((along[:-1, None] + steps).ravel(), along[-1])
    # Gauss-Legendre with three points, exact to the sixth order of a part's length.
    width, root = np.diff(places), np.sqrt(0.15)
    points = places[:-1, None] + width[:, None] * np.array([0.5 - root, 0.5, 0.5 + root])
    from scipy.interpolate import PchipInterpolator

    speed = PchipInterpolator(along, speeds)
    rate, _ = _pace(curve, speed, points.ravel(), along, where)
    slowness = (1.0 / rate).reshape(points.shape) @ np.array([5, 8, 5]) / 18
    time = np.cumsum(width * slowness)
    first, second = _pace(curve, speed, places, along, where)
    return hermite_quintic(np.concatenate([[0.0], time]), places, first, second)


def _pace(
    curve: Callable[[np.ndarray], Sampled],
    speed: PchipInterpolator,
    at: np.ndarray,
    along: np.ndarray,
    where: Callable[[int], str],
) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative over time of the parameter, at the speeds there."""
    tool = curve(at)[0]
    slope, bend = tool.velocity, tool.acceleration  # over the parameter
    size = np.linalg.norm(slope, axis=-1)
    if (size < _BACK).any():
        k = int(np.searchsorted(along, at[int(np.argmax(size < _BACK))]))
        raise TrajectoryError(
            "the path turns back on itself, where the tool can't keep its speed",
            where=where(min(k, len(along) - 1)),
            remedy="Give times, at which the tool stops there, or round the corner off",
        )
    value, change = speed(at), speed(at, 1)
    rate = value / size
    stretch = (slope * bend).sum(axis=-1) / size
    return rate, rate * (change - value * stretch / size) / size


def _scaled(law: Piecewise, whole: float, s: np.ndarray) -> Triple:
    """The parameter over s in [0, 1], which takes a whole time."""
    return law(s * whole), law(s * whole, 1) * whole, law(s * whole, 2) * whole**2
