"""Numbers with their units, as a derivation's file gives them."""

from __future__ import annotations

import math
import re

from thesis_pin.errors import BadInput

_NUMBER = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)")
_UNITS = {
    "": (1.0, "masses inertias lengths"),
    **{"m": (1.0, "lengths"), "cm": (1e-2, "lengths"), "mm": (1e-3, "lengths")},
    **{"kg": (1.0, "masses"), "g": (1e-3, "masses")},
    **{"rad": (1.0, ""), "deg": (math.pi / 180, ""), "°": (math.pi / 180, "")},
    **{"kgm2": (1.0, "inertias"), "kgcm2": (1e-4, "inertias"), "kgmm2": (1e-6, "inertias")},
    **{"gm2": (1e-3, "inertias"), "gcm2": (1e-7, "inertias"), "gmm2": (1e-9, "inertias")},
    **{"m/s2": (1.0, ""), "ms-2": (1.0, ""), "mm/s2": (1e-3, "")},
}


def number(value: float | str, where: str) -> tuple[float, set[str]] | None:
    """A number in SI, and what of the robot mustn't change for it; None if it isn't one.

    Raises:
        BadInput: It has a unit that isn't known.
    """
    if not isinstance(value, str):
        return float(value), set(_UNITS[""][1].split())
    match = _NUMBER.fullmatch(value.strip())
    if match is None:
        return None
    unit = re.sub(r"[\s·*^]", "", match[2].replace("²", "2"))
    if unit not in _UNITS:
        raise BadInput(
            f"the unit {match[2]!r} isn't known",
            where=where,
            allowed="m, cm, mm, kg, g, rad, deg, kg·m², g·cm² and the like, m/s², or no unit (SI)",
        )
    size, fixed = _UNITS[unit]
    return float(match[1]) * size, set(fixed.split())
