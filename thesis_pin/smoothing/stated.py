"""What the user says of the resolution of samples: nothing, to ignore it, or what it is."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import shown

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9}
ANGLES = {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180.0, "°": math.pi / 180.0}

_NUMBER = re.compile(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*([a-zµμ°]+)\s*")


@dataclass(frozen=True)
class Stated:
    """How samples are to be read.

    Attributes:
        through: Whether curves pass through every sample, whatever its resolution.
        length: Resolution of lengths [m], where the samples' own isn't coarser; 0 if unsaid.
        angle: The same of angles [rad].
    """

    through: bool = False
    length: float = 0.0
    angle: float = 0.0


def stated(text: str) -> Stated:
    """Read ``auto``, ``none``, a length such as ``0.1mm``, an angle, or both with a comma.

    Raises:
        BadInput: It is none of these.
    """
    if text == "auto":
        return Stated()
    if text == "none":
        return Stated(through=True)
    found = {"length": 0.0, "angle": 0.0}
    for part in text.split(",") if isinstance(text, str) else [""]:
        match = _NUMBER.fullmatch(part)
        unit = match[2].replace("μ", "µ") if match else ""
        kind, factor = "length", LENGTHS.get(unit)
        if factor is None:
            kind, factor = "angle", ANGLES.get(unit)
        try:
            value = float(match[1]) * factor if match and factor else 0.0
        except ValueError:
            value = 0.0
        if not (0.0 < value < 1e3) or found[kind]:
            raise BadInput(
                f"smooth is {shown(text)}",
                allowed="auto, none, or the samples' resolution: a length such as 0.1mm, an "
                "angle such as 0.05deg, or both as 0.1mm,0.05deg",
            )
        found[kind] = value
    return Stated(False, **found)
