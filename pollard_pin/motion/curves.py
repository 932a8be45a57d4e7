"""Curves to follow: appendix B's, lines, arcs, and several in a row.

Source: Pollard thesis, appendix B.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from pollard_pin.coordinates import pose_rotation
from pollard_pin.motion.orientation import named_alike, turn_between, turning
from pollard_pin.motion.path import Curve, Sampled, ToolPath, driven, timing_law
from pollard_pin.specification import Specification
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.arrays import vector
from thesis_pin.numeric.checks import instance, shown
from thesis_pin.numeric.trajectory import BodyMotion
from thesis_pin.tolerances import TOLERANCES

_REACH = 60 * math.pi  # the parameter of appendix B runs from −60π to 60π
_MM = 1e-3

Points = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Points [m] over s and their first and second derivatives, each ``(n, 3)``."""


def appendix_b(
    specification: Specification | None = None,
    *,
    placement: Sequence[float] | None = None,
    orientation: Sequence[float] | None = None,
    duration: float | None = None,
    timing: str | None = None,
) -> ToolPath:
    """The thesis's spray path, placed and timed.

    Printed in millimetres and without a time: x = −0.001 t², y = t,
    z = 100 sin(0.3 t), t from −60π to 60π. As printed it can't be reached with any
    orientation of the tool: at t = 0 the wrist is too near the shoulder.

    Args:
        specification: Gives what is None below; None for the thesis's robot.
        placement: What is added to (x, y, z) [m].
        orientation: ψ, θ, φ, kept all along [rad].
        duration: [s].
        timing: Law for t: ``"constant-rate"`` or ``"rest-to-rest"``.

    Source: Pollard thesis, appendix B.
    """
    if specification is not None:
        instance("specification", specification, Specification, "Specification.read()")
    assumed = (specification or Specification.read()).assumptions
    place = vector("placement", assumed.placement.position if placement is None else placement, 3)
    tool = vector(
        "orientation",
        np.radians(assumed.placement.orientation_deg) if orientation is None else orientation,
        3,
    )
    seconds = assumed.motion.duration if duration is None else duration
    law = assumed.motion.timing if timing is None else timing
    timing_law(law, seconds, np.zeros(1))

    pose = np.concatenate([place, tool])
    curve = partial(_appendix_b_curve, pose, pose_rotation(pose))
    return ToolPath(
        "appendix B",
        seconds,
        partial(driven, curve, partial(timing_law, law, seconds)),
        {
            "path": "appendix B",
            "placement": place.tolist(),
            "orientation": tool.tolist(),
            "duration": seconds,
            "timing": law,
        },
        curves=(Curve(1.0, curve),),
    )


def _appendix_b_curve(origin: np.ndarray, tool: np.ndarray, s: np.ndarray) -> Sampled:
    u, span = _REACH * (2 * s - 1), 2 * _REACH
    value, first, second = np.zeros((3, 3, len(s)))  # components first: each is one array
    value[0], value[1], value[2] = -0.001 * u**2, u, 100 * np.sin(0.3 * u)
    first[0], first[1], first[2] = -0.002 * u, 1.0, 30 * np.cos(0.3 * u)
    second[0], second[2] = -0.002, -0.09 * value[2]
    value, first, second = value * _MM, first * (_MM * span), second * (_MM * span**2)
    points = value.T + origin[:3], first.T, second.T
    rotation, *rates = turning(tool, np.zeros(3), s)
    return BodyMotion(rotation, *points, *rates), np.broadcast_to(origin[3:], (len(s), 3))


def line(
    start: ArrayLike, end: ArrayLike, duration: float, timing: str = "rest-to-rest"
) -> ToolPath:
    """A straight line between two poses (x, y, z, ψ, θ, φ).

    The tool turns about one axis, the shorter way.

    Raises:
        TrajectoryError: The orientations are half a turn apart, and the angles don't say which
            way round.
    """
    first, last = vector("start", start, 6), vector("end", end, 6)
    return _single("line", partial(_line_curve, first[:3], last[:3]), first, last, duration, timing)


def _line_curve(first: np.ndarray, last: np.ndarray, s: np.ndarray) -> Points:
    step = np.broadcast_to(last - first, (len(s), 3))
    return first + s[:, None] * step, step, np.zeros_like(step)


def arc(
    start: ArrayLike,
    via: ArrayLike,
    end: ArrayLike,
    duration: float,
    timing: str = "rest-to-rest",
) -> ToolPath:
    """A circular arc; the tool turns about one axis, the shorter way.

    Args:
        start: First pose (x, y, z, ψ, θ, φ).
        via: Point [m] the arc passes through.
        end: Last pose.
        duration: [s].
        timing: Timing law.

    Raises:
        TrajectoryError: The three points lie on a line.
    """
    first, last = vector("start", start, 6), vector("end", end, 6)
    middle = vector("via", via, 3)
    one, two = middle - first[:3], last[:3] - first[:3]
    normal = np.cross(one, two)
    area = float(np.linalg.norm(normal))
    if area < TOLERANCES.straight * max(float(one @ one), float(two @ two)):
        raise TrajectoryError(
            "start, via and end of an arc lie on a line", remedy="Use a line, or move via"
        )
    normal = normal / area
    to_centre = np.cross((two @ two) * one - (one @ one) * two, normal) / (2 * area)
    # Circumcentre of 0, a, b: (|a|² b − |b|² a) × (a × b) / (2 |a × b|²).
    centre = first[:3] - to_centre
    radius = first[:3] - centre
    side = np.cross(normal, radius)
    gap = last[:3] - centre
    angle = math.atan2(float(gap @ side), float(gap @ radius)) % (2 * math.pi)
    curve = partial(_arc_curve, centre, radius, side, angle)
    return _single("arc", curve, first, last, duration, timing)


def _arc_curve(
    centre: np.ndarray, radius: np.ndarray, side: np.ndarray, angle: float, s: np.ndarray
) -> Points:
    c, sn = np.cos(angle * s)[:, None], np.sin(angle * s)[:, None]
    return (
        centre + c * radius + sn * side,
        angle * (c * side - sn * radius),
        -(angle**2) * (c * radius + sn * side),
    )


def _single(
    name: str,
    points: Callable[[np.ndarray], Points],
    first: np.ndarray,
    last: np.ndarray,
    duration: float,
    timing: str,
) -> ToolPath:
    timing_law(timing, duration, np.zeros(1))
    duration, turn = float(duration), turn_between(first, last)
    angles = named_alike(pose_rotation(np.stack([first, last])), first[3:])
    curve = partial(_turning_curve, points, pose_rotation(first), turn, angles)
    size = float(np.linalg.norm(turn))
    written = float(np.abs(last - first)[3:].max())
    note = (
        f"a {name}'s angles are written {math.degrees(written):.4g}° apart, and the tool turns the "
        f"shorter way, by {math.degrees(size):.4g}°"
    )
    return ToolPath(
        name,
        duration,
        partial(driven, curve, partial(timing_law, timing, duration)),
        {"path": name, "duration": duration, "timing": timing, "turn": size},
        (note,) if written > math.pi + TOLERANCES.half_turn else (),
        curves=(Curve(1.0, curve),),
    )


def _turning_curve(
    points: Callable[[np.ndarray], Points],
    rotation: np.ndarray,
    turn: np.ndarray,
    angles: np.ndarray,
    s: np.ndarray,
) -> Sampled:
    near = angles[0] + s[:, None] * (angles[1] - angles[0])
    turned, *rates = turning(rotation, turn, s)
    return BodyMotion(turned, *points(s), *rates), near


def joined(paths: Sequence[ToolPath], *, name: str = "segments") -> ToolPath:
    """Paths that follow each other without a jump in pose or rate.

    Raises:
        TrajectoryError: There is none, or pose or rate jumps between two of them.
    """
    if not isinstance(paths, list | tuple) or not paths:
        raise TrajectoryError(
            f"segments are {'empty' if isinstance(paths, list | tuple) else shown(paths)}",
            allowed="a list of at least one path",
        )
    for path in paths:
        instance("a segment", path, ToolPath, "line(), arc() or through()")
    for number, (before, after) in enumerate(itertools.pairwise(paths), start=1):
        end, start = before.at(before.duration), after.at(0.0)
        one, two = end.tool, start.tool
        apart = float(np.linalg.norm(one.rotation - two.rotation)) / math.sqrt(8)
        turned = 2 * math.asin(min(apart, 1.0))
        for what, gaps in (
            ("pose", (turned, one.position - two.position)),
            ("rate", (one.velocity - two.velocity, one.omega - two.omega)),
        ):
            jump = max(float(np.abs(gap).max()) for gap in gaps)
            if jump > TOLERANCES.path_join:
                raise TrajectoryError(
                    f"the {what} jumps by {jump:.3g} between segments {number} and {number + 1}",
                    remedy="Let the segments meet, and use rest-to-rest timing around corners",
                )
    ends = np.cumsum([path.duration for path in paths])
    function = partial(_joined, tuple(paths), ends)
    parameters = {"path": name, "segments": [path.parameters for path in paths]}
    return ToolPath(
        name,
        float(ends[-1]),
        function,
        {**parameters, "duration": float(ends[-1])},
        tuple(note for path in paths for note in path.notes),
        curves=_all_curves(paths),
    )


def _all_curves(paths: Sequence[ToolPath]) -> tuple[Curve, ...]:
    """The geometry of all of them; none if one has none."""
    if not all(path.curves for path in paths):
        return ()
    return tuple(curve for path in paths for curve in path.curves)


def _joined(paths: Sequence[ToolPath], ends: np.ndarray, at: np.ndarray) -> Sampled:
    which = np.minimum(np.searchsorted(ends, at, side="right"), len(paths) - 1)
    rotation, vectors = np.empty((len(at), 3, 3)), np.empty((6, len(at), 3))
    for k, path in enumerate(paths):
        some = which == k
        local = np.clip(at[some] - (ends[k] - path.duration), 0.0, path.duration)
        tool, near = path.function(local)
        rotation[some] = tool.rotation
        moved = (tool.position, tool.velocity, tool.acceleration, tool.omega, tool.alpha)
        vectors[:, some] = (*moved, near)
    return BodyMotion(rotation, *vectors[:5]), vectors[5]
