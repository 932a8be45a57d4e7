"""Which frames the thesis's vectors are seen from and its rotations turn between.

A superscript says from which frame: ``k_4^4`` is (0, 0, 1), ``k_4^0`` is R_4^0 times that.
A translation turns nothing, so a frame after one is parallel to the frame before it and
carries its name here. The vectors k, r_G … that have no superscript are seen from the base.

Source: Pollard thesis, 2.4.1, 2.7.1, 3.2, 3.4, appendix A.
"""

from __future__ import annotations

from thesis_pin.equations.formula import Node, Sum, Symbol
from thesis_pin.equations.frames import (
    ANY,
    Frames,
    columns_seen_from,
    seen_from,
    swapped,
    turning,
)

WORLD = "0"
_PARALLEL = {
    **{"0": WORLD, "1": WORLD, "2": "2", "3": "2", "4": "4", "5": "5", "14": "5", "15": "5"},
    **{"16": "16", "17": "17", "18": "18", "p": "p"},
}
_PARALLEL_I = {
    **{"1": WORLD, "2": "2", "3": "2", "4": "2", "5": "5", "6": "6", "7": "7", "8": "7"},
    **{"11": "13", "12": "13", "13": "13"},
}
"""Frame of a side chain without its i → the one it is parallel to."""


def frame(name: str, i: str = "") -> str | None:
    """Name of the frame parallel to one, "3i" → "2(1)" on chain 1; None if there is none.

    Args:
        name: As printed, or with the chain's number for its i: "3i", "31".
        i: The chain, where the name says i.
    """
    if name in _PARALLEL:
        return _PARALLEL[name]
    number, chain = name[:-1], i if name.endswith("i") else name[-1:]
    if number not in _PARALLEL_I or chain not in ("1", "2"):
        return None
    found = _PARALLEL_I[number]
    return found if found == WORLD else f"{found}({chain})"


def _turns() -> dict[str, tuple[str, Frames]]:
    """Angle → axis it turns about, frames its rotation turns between."""
    found = {
        **{"theta_21": ("y", "0", "2"), "theta_43": ("y", "2", "4"), "theta_54": ("z", "4", "5")},
        **{"theta_1615": ("x", "5", "16"), "theta_1716": ("z", "16", "17")},
        **{"theta_1817": ("x", "17", "18"), "theta": ("x", "0", "theta")},
        **{"psi": ("y", "theta", "psi"), "phi": ("z", "psi", "p")},
    }
    for i in "12":
        found |= {
            f"theta_21{i}": ("z", "0", f"2({i})"),
            f"beta_54{i}": ("x", f"2({i})", f"5({i})"),
            f"theta_65{i}": ("y", f"5({i})", f"6({i})"),
            f"theta_76{i}": ("z", f"6({i})", f"7({i})"),
            f"beta_1413{i}": ("z", f"13({i})", "5"),  # 2.7.4 turns by −β
        }
    return {angle: (axis, turning((to, of))) for angle, (axis, to, of) in found.items()}


_TURNS = _turns()


def of_rotation(axis: str, argument: Node, indices: dict[str, str]) -> Frames:
    """Frames of a rotation by an angle or by minus an angle."""
    back = isinstance(argument, Sum) and len(argument.terms) == 1 and argument.terms[0][0] == "-"
    inner = argument.terms[0][1] if isinstance(argument, Sum) and back else argument
    if not isinstance(inner, Symbol) or inner.dots:
        return ANY
    about, frames = _TURNS.get(inner.bound(indices).name, ("", ANY))
    if about != axis:
        return ANY
    return swapped(frames) if back else frames


def joint(axis: str, name: str, i: str = "") -> str | None:
    """The angle of the joint that turns about "x", "y" or "z" of a frame; None if none does.

    Both arms turn about the base's z: which one, a frame of its side chain says.
    """
    start = frame(name, i)
    chain = "" if name in _PARALLEL else i if name.endswith("i") else name[-1:]
    asked = f"theta_21{chain}" if start == WORLD and chain else ""
    for angle, (about, between) in _TURNS.items():
        ((to, _),) = between
        if (about, to) == (axis, start) and angle.startswith(asked or "theta_"):
            return angle
    return None


def of_symbol(symbol: Symbol, tail: tuple[int, ...], i: str) -> Frames:
    """What a symbol whose value has a shape is seen from or turns between."""
    base, seen = symbol.base, frame(symbol.sup or WORLD, i)
    if tail == (3,) and base in (*"ijkrvgJ", "omega"):
        return seen_from(seen) if seen else ANY
    if tail == (3, 3) and base == "R":
        inner = frame(symbol.sub, i)
        return turning((seen, inner)) if seen and inner else ANY
    if tail == (3, 3) and base == "J" and symbol.sup:
        return turning((seen, seen)) if seen else ANY
    if tail in ((3, 3), (3, 6)) and base in ("J", "M") and symbol.sub != "tau":
        return columns_seen_from(WORLD)
    return ANY


def own_axis(symbol: Symbol, i: str) -> bool:
    """Whether an axis is drawn in its own frame: ``k_4^4``, or ``k_0`` of the base."""
    return symbol.sub == (symbol.sup or WORLD) and frame(symbol.sub, i) is not None
