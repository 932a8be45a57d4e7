"""A leg in the neutral pose with its lengths x_0 to y_6 and constant angles β_1 to β_8, as SVG.

Every point and every arc is worked out from the chain of :mod:`scout_pin.kinematics.forward`,
so that the picture is of this leg and no other.

Source: Scout thesis, appendix B.2 and B.3.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from html import escape
from itertools import pairwise

import numpy as np

from scout_pin.kinematics.forward import leg_frames
from scout_pin.model import Scout
from scout_pin.specification import SIDES
from thesis_pin.numeric.checks import choice
from thesis_pin.tolerances import TOLERANCES

_WIDTH, _HEIGHT, _TOP, _EDGE = 420, 600, 62, 60
_INK, _MUTED, _BONE, _ANGLE, _SOLE = "#1a1a1a", "#6b7580", "#0072B2", "#b34700", "#00795c"
_VIEWS = (
    ("seen from behind", (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    ("seen from the right", (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    ("seen from above", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
)
"""Title, and what points right and up in the picture, in the torso's axes."""


@dataclass(frozen=True, eq=False)
class _Angle:
    """A constant angle: it turns ``start`` about ``axis`` at ``at``."""

    name: str
    degrees: float
    at: np.ndarray
    axis: np.ndarray
    start: np.ndarray


@dataclass
class _Panel:
    """One view, with the boxes of the labels that stand in it already."""

    right: np.ndarray
    up: np.ndarray
    scale: float
    centre: np.ndarray
    left: float
    taken: list[tuple[float, float, float, float]] = field(default_factory=list)

    def at(self, points: np.ndarray) -> np.ndarray:
        """Points in the torso's frame → pixels, shape ``(..., 2)``."""
        flat = np.stack([points @ self.right, points @ self.up], axis=-1) - self.centre
        middle = np.array([self.left + _WIDTH / 2, _TOP + _HEIGHT / 2])
        # Rounded, so that another processor's last bit doesn't move a label.
        return np.asarray(np.round(middle + flat * (self.scale, -self.scale), 6))

    def block(self, spot: np.ndarray, size: float) -> None:
        """Let no label stand on a spot."""
        x, y = float(spot[0]), float(spot[1])
        self.taken.append((x - size, y - size, x + size, y + size))

    def free(self, spot: np.ndarray, away: np.ndarray, width: float) -> tuple[float, float]:
        """Where a label of some width stands near a spot, clear of lines and of the others."""
        turns = (0.0, 0.5, -0.5, 1.0, -1.0, 2.2, -2.2, np.pi)
        for step in range(30):
            for turn in turns:
                c, s = np.cos(turn), np.sin(turn)
                way = np.array([c * away[0] - s * away[1], s * away[0] + c * away[1]])
                reach = 9.0 + 7.0 * step + abs(way[0]) * width / 2 + abs(way[1]) * 8.0
                x, y = np.round(spot + way * reach, 6)
                box = (x - width / 2, y - 9.0, x + width / 2, y + 9.0)
                inside = self.left + 4 < box[0] and box[2] < self.left + _WIDTH - 4
                if inside and not any(_meet(box, one) for one in self.taken):
                    self.taken.append(box)
                    return float(x), float(y)
        return float(x), float(y)


def _meet(one: Sequence[float], other: Sequence[float]) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def leg_drawing(robot: Scout, side: str) -> str:
    """The drawing of a leg, as an SVG element that stands by itself.

    Args:
        robot: The biped.
        side: ``left`` or ``right``.

    Raises:
        UnknownName: There is no such side.
    """
    leg = robot.legs[choice("side", side, SIDES)]
    frames = leg_frames(leg, np.zeros((1, 6)))
    points = np.vstack([np.zeros(3), frames.points[:, :, 0], frames.sole[:, 0]])
    sole = robot.sole_vertices(side, robot.neutral_feet()[side])
    everything = np.vstack([points, sole])
    panels, total = [], 3 * _WIDTH
    spans = [
        (np.ptp(everything @ np.array(right)), np.ptp(everything @ np.array(up)))
        for _, right, up in _VIEWS
    ]
    scale = min(
        min((_WIDTH - 2 * _EDGE) / max(w, 1e-9), (_HEIGHT - 2 * _EDGE) / max(h, 1e-9))
        for w, h in spans
    )
    for k, (_, right, up) in enumerate(_VIEWS):
        r, u = np.array(right), np.array(up)
        flat = np.stack([everything @ r, everything @ u])
        centre = (flat.min(axis=1) + flat.max(axis=1)) / 2
        panels.append(_Panel(r, u, scale, centre, k * _WIDTH))
    parts = [*_headings(spec_name=robot.specification.name, side=side)]
    for panel in panels:
        parts += _skeleton(panel, points, sole)
    for angle in _angles(robot, side):
        parts += _arc(panels, angle)
    values = (leg.x_0, leg.z_1, leg.x_2, leg.x_3, leg.x_4, leg.x_5, leg.y_6)
    names = ("x_0", "z_1", "x_2", "x_3", "x_4", "x_5", "y_6")
    for k, (name, value) in enumerate(zip(names, values, strict=True)):
        parts += _length(panels, name, abs(value), points[k], points[k + 1], everything)
    for name, point in zip(leg.names, points[1:7], strict=True):
        parts += _joint(panels[0], name, point)
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {_TOP + _HEIGHT}" '
        f'width="100%" role="img" font-family="system-ui, sans-serif" font-size="13">\n'
        f"<title>{escape(f'{robot.specification.name}: {side} leg in the neutral pose')}</title>\n"
        f'<rect width="{total}" height="{_TOP + _HEIGHT}" fill="#ffffff"/>\n'
    )
    return head + "\n".join(parts) + "\n</svg>\n"


def _headings(spec_name: str, side: str) -> Iterator[str]:
    text = f"{spec_name}: {side} leg, all servos in the middle (neutral pose)"
    yield _text(16, 24, text, _INK, "start", 'font-size="17" font-weight="600"')
    for k, (title, _, _) in enumerate(_VIEWS):
        yield _text(k * _WIDTH + 16, 50, title, _MUTED, "start")


def _skeleton(panel: _Panel, points: np.ndarray, sole: np.ndarray) -> Iterator[str]:
    yield _path(panel.at(np.vstack([sole, sole[:1]])), _SOLE, 1.5, 'fill="#00795c22"')
    yield _path(panel.at(points), _BONE, 3.0)
    for k, (x, y) in enumerate(panel.at(points[:-1])):
        radius = 3.0 if k == 0 else 5.0
        yield f'<circle cx="{x:z.1f}" cy="{y:z.1f}" r="{radius}" fill="#fff" stroke="{_INK}"/>'
    for line in (points, np.vstack([sole, sole[:1]])):
        for one, other in pairwise(panel.at(line)):
            for part in np.linspace(0.0, 1.0, 2 + int(np.linalg.norm(other - one) / 5.0)):
                panel.block(one + part * (other - one), 4.0)


def _length(
    panels: Sequence[_Panel],
    name: str,
    value: float,
    start: np.ndarray,
    end: np.ndarray,
    everything: np.ndarray,
) -> Iterator[str]:
    """Name and size of a length beside its line, in the view that shows it longest."""
    if not value > 0.0:
        return
    line = np.stack([start, end])
    shown = [float(np.linalg.norm(np.diff(panel.at(line), axis=0))) for panel in panels]
    panel = panels[int(np.argmax(np.round(shown, 3)))]
    one, other = panel.at(np.stack([start, end]))
    middle = (one + other) / 2
    along = (other - one) / max(float(np.linalg.norm(other - one)), 1e-9)
    away = np.array([-along[1], along[0]])
    if away @ (middle - panel.at(everything).mean(axis=0)) < 0.0:
        away = -away
    text = f"{name} = {value * 1e3:.4g} mm"
    x, y = panel.free(middle, away, 7.2 * len(text))
    yield _text(x, y + 4, text, _BONE)


def _joint(panel: _Panel, name: str, point: np.ndarray) -> Iterator[str]:
    """A joint's name beside its centre."""
    text = name.split("_", 1)[1].replace("_", " ")
    x, y = panel.free(panel.at(point), np.array([-1.0, 0.0]), 7.0 * len(text))
    yield _text(x, y + 4, text, _MUTED)


def _angles(robot: Scout, side: str) -> Iterator[_Angle]:
    """The eight constant angles, each with the axis it turns, in the torso's frame."""
    spec, leg = robot.specification.leg(side), robot.legs[side]
    frames = leg_frames(leg, np.zeros((1, 6)))
    p, axes = frames.points[:, :, 0], frames.axes[:, :, 0]
    j3, e, a = axes[1], axes[2], axes[5]
    i3, j11 = np.cross(j3, e), frames.foot_link[1, :, 0]
    c1, s1 = np.cos(leg.beta[0]), np.sin(leg.beta[0])
    thigh, shank = (p[k + 1] - p[k] for k in (2, 3))
    up = np.array([0.0, 0.0, 1.0])
    starts = (
        (p[0], up, np.array([1.0, 0.0, 0.0])),
        (p[1], j3, np.array([c1, s1, 0.0])),
        (p[2], e, i3),
        (p[3], e, thigh / leg.x_3),
        (p[4], e, shank / leg.x_4),
        (p[5], a, np.cross(e, a)),
    )
    for k, (at, axis, start) in enumerate(starts):
        yield _Angle(f"β_{k + 1}", spec.beta_deg[k], at, axis, start)
    at, k11 = frames.sole[:, 0], np.cross(a, j11)
    yield _Angle("β_7", spec.beta_7_deg, at, k11, a)
    turned = robot.neutral_feet()[side][:3, :3]
    yield _Angle("β_8", spec.beta_8_deg, at, turned[:, 1], np.cross(turned[:, 1], k11))


def _arc(panels: Sequence[_Panel], angle: _Angle) -> Iterator[str]:
    """An angle as an arc from the dashed axis it turns, in the view along its own axis."""
    facing = [abs(float(np.cross(panel.right, panel.up) @ angle.axis)) for panel in panels]
    panel = panels[int(np.argmax(np.round(facing, 6)))]
    turn = np.radians((angle.degrees + 180.0) % 360.0 - 180.0)
    if abs(turn) < TOLERANCES.spelled:
        turn = 0.0
    size = 24.0 / panel.scale
    part = np.linspace(0.0, turn, 25)[:, None]
    side = np.cross(angle.axis, angle.start)
    rays = np.cos(part) * angle.start + np.sin(part) * side
    ends = panel.at(angle.at + np.stack([0.0 * rays[0], 1.5 * size * rays[0]]))
    yield _path(ends, _MUTED, 1.2, 'stroke-dasharray="4 3"')
    yield _path(panel.at(angle.at + np.stack([0.0 * rays[0], 1.5 * size * rays[-1]])), _ANGLE, 1.2)
    arc = panel.at(angle.at + size * rays)
    for spot in arc:
        panel.block(spot, 4.0)
    if turn:
        yield _path(arc, _ANGLE, 1.6)
        yield _tip(arc)
    middle, centre = arc[len(arc) // 2], panel.at(angle.at)
    away = (middle - centre) / max(float(np.linalg.norm(middle - centre)), 1e-9)
    text = f"{angle.name} = {angle.degrees:.5g}°"
    x, y = panel.free(middle, away, 7.4 * len(text))
    yield _text(x, y + 4, text, _ANGLE)


def _tip(arc: np.ndarray) -> str:
    """An arrow's head at the end of an arc."""
    along = arc[-1] - arc[-3]
    along = along / max(float(np.linalg.norm(along)), 1e-9)
    across = np.array([-along[1], along[0]])
    back = arc[-1] - 7 * along
    head = np.stack([arc[-1], back + 3.5 * across, back - 3.5 * across])
    corners = " ".join(f"{x:z.1f},{y:z.1f}" for x, y in head)
    return f'<polygon points="{corners}" fill="{_ANGLE}"/>'


def _path(points: np.ndarray, colour: str, width: float, more: str = "") -> str:
    corners = " ".join(f"{x:z.1f},{y:z.1f}" for x, y in points)
    fill = "" if "fill=" in more else ' fill="none"'
    return (
        f'<polyline points="{corners}" stroke="{colour}" stroke-width="{width}" '
        f'stroke-linejoin="round"{fill} {more}/>'
    )


def _text(
    x: float, y: float, text: str, colour: str, anchor: str = "middle", more: str = ""
) -> str:
    halo = 'paint-order="stroke" stroke="#ffffff" stroke-width="4"'
    return (
        f'<text x="{x:z.1f}" y="{y:z.1f}" fill="{colour}" text-anchor="{anchor}" {halo} {more}>'
        f"{escape(text)}</text>"
    )
