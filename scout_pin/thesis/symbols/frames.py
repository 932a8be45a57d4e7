"""Which frames the thesis's vectors are seen from and its rotations turn between (3.1, 3.2).

The thesis numbers a frame after each elementary transform of 3.1. A translation turns
nothing, so frames 0i, 2i … 12i are parallel to the ones before them and carry their names
here. An axis without superscript is seen from its own frame, in which it's (1, 0, 0),
(0, 1, 0) or (0, 0, 1): ``R_11i^0 k_11i``.

Source: Scout thesis, 3.1, (3.7), (3.10), (3.11), 4.6.
"""

from __future__ import annotations

import re
from dataclasses import replace

from thesis_pin.equations.formula import Node, Sum, Symbol, symbols
from thesis_pin.equations.frames import ANY, Frames, columns_seen_from, seen_from, swapped, turning

WORLD = "0"
_LAST = 14
"""Number of a sole's frame, which the thesis also calls i."""
_EULER = {"itheta": "", "jphi": "theta", "kpsi": "phi"}
"""Axes of Euler angles: each is drawn in the frame that the angles before it turned."""


def frame(name: str) -> str | None:
    """Name of the frame parallel to one, "21" → "11"; None if there is no such frame."""
    if name in (WORLD, "B"):
        return name
    if name in ("1", "2"):
        return f"{_LAST}{name}"
    match = re.fullmatch(r"(\d{1,2})([12])", name)
    if not match or int(match[1]) > _LAST:
        return None
    number = int(match[1])
    if number % 2 or number == _LAST:
        return name
    return f"{number - 1}{match[2]}" if number else "B"


def own_frame(name: str) -> str | None:
    """Frame in which an axis without superscript is drawn: "k111" → "111", "jphiB" → "thetaB"."""
    for start, before in _EULER.items():
        if name.startswith(start) and name.removeprefix(start) in ("B", "1", "2"):
            return before + name.removeprefix(start) if before else WORLD
    return frame(name[1:])


def _turns() -> dict[str, tuple[str, Frames]]:
    """Angle → axis it turns about, frames its rotation turns between."""
    found: dict[str, tuple[str, Frames]] = {}
    for foot, last in (("B", "B"), ("1", "141"), ("2", "142")):
        found[f"theta_{foot}"] = "x", turning((WORLD, f"theta{foot}"))
        found[f"phi_{foot}"] = "y", turning((f"theta{foot}", f"phi{foot}"))
        found[f"psi_{foot}"] = "z", turning((f"phi{foot}", last))
    for i in "12":
        for n, axis in enumerate("zyzzzx", start=1):
            before = "B" if n == 1 else f"{2 * n - 3}{i}"
            found[f"theta_{n}{i}"] = axis, turning((before, f"{2 * n - 1}{i}"))
    found["beta_7"] = "z", turning(("111", "131"), ("112", "132"))
    found["beta_8"] = "y", turning(("131", "141"), ("132", "142"))
    return found


_TURNS = _turns()


_ABOUT = {"theta_B": "ithetaB", "phi_B": "jphiB", "psi_B": "kpsiB"} | {
    f"theta_{n}{i}": f"{start}{i}"
    for i in "12"
    for n, start in enumerate(("k0", "j2", "k4", "k6", "k8", "i10"), start=1)
}
"""Angle → name of the thesis's vector that it turns about."""


def axis_of(axis: str, argument: Node, indices: dict[str, str]) -> str | None:
    """The vector that a printed rotation, or Ω of a rate, turns about; None if no joint does."""
    if isinstance(argument, Symbol) and argument.dots:
        argument = replace(argument, dots=0)
    angle, _ = _angle(axis, argument, indices)
    return _ABOUT.get(angle)


def of_rotation(axis: str, argument: Node, indices: dict[str, str]) -> Frames:
    """Frames of a rotation by an angle, its constant part beside it or not."""
    angle, back = _angle(axis, argument, indices)
    found = _TURNS[angle][1] if angle else ANY
    return swapped(found) if back else found


def _angle(axis: str, argument: Node, indices: dict[str, str]) -> tuple[str, bool]:
    """The one known angle in an argument, "" if none turns about the axis; whether it's minus."""
    named = {symbol.bound(indices).name: symbol for symbol in symbols(argument) if not symbol.dots}
    angles = [name for name in named if name in _TURNS]
    if len(angles) != 1 or _TURNS[angles[0]][0] != axis:
        return "", False
    return angles[0], isinstance(argument, Sum) and ("-", named[angles[0]]) in argument.terms


def of_symbol(symbol: Symbol, tail: tuple[int, ...]) -> Frames:
    """What a symbol whose value has a shape is seen from or turns between."""
    world = symbol.sup == WORLD
    if tail == (3,):
        own = symbol.base in "ijk" and not symbol.sup
        seen = own_frame(symbol.base + symbol.sub) if own else frame(symbol.sup)
        seen = WORLD if symbol.base == "g" else seen
        return seen_from(seen) if seen else ANY
    if tail == (3, 3) and symbol.base in "RI":
        inner = frame(symbol.sub) if symbol.base == "R" else frame(symbol.sup)
        outer = WORLD if symbol.base == "R" and world else inner
        return turning((outer, inner)) if outer and inner else ANY
    if tail == (3, 18) and symbol.base in "JW":
        return columns_seen_from(WORLD)
    return ANY
