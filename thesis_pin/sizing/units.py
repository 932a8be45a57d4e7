"""Units of data sheets, as people write them behind or beside a quantity's name."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

POUND, OUNCE, INCH = 0.45359237, 0.45359237 / 16, 25.4e-3
"""International pound and ounce [kg], inch [m]."""
STANDARD_GRAVITY = 9.80665
"""Of which a kilogram-force is made [m/s²]; not the gravity that the robots stand in."""
KILOGRAM_CENTIMETRE = STANDARD_GRAVITY / 100
"""A kilogram-force at a centimetre [N·m]."""
RPM = 2 * math.pi / 60
"""A turn a minute [rad/s]."""
_TORQUE = {
    "nm": 1.0,
    "mnm": 1e-3,
    "ncm": 1e-2,
    "kgcm": KILOGRAM_CENTIMETRE,
    "kgfcm": KILOGRAM_CENTIMETRE,
    "kgm": STANDARD_GRAVITY,
    "kgfm": STANDARD_GRAVITY,
    "gcm": KILOGRAM_CENTIMETRE / 1000,
    "gfcm": KILOGRAM_CENTIMETRE / 1000,
    "ozin": OUNCE * STANDARD_GRAVITY * INCH,
    "inoz": OUNCE * STANDARD_GRAVITY * INCH,
    "ozfin": OUNCE * STANDARD_GRAVITY * INCH,
    **dict.fromkeys(
        ("lbin", "lbsin", "inlb", "inlbs", "lbfin", "inlbf"), POUND * STANDARD_GRAVITY * INCH
    ),
    **dict.fromkeys(
        ("lbft", "lbsft", "ftlb", "ftlbs", "lbfft", "ftlbf"), POUND * STANDARD_GRAVITY * 12 * INCH
    ),
}
_SPEED = {
    **dict.fromkeys(("rads", "radsec"), 1.0),
    **dict.fromkeys(("degs", "degsec"), math.pi / 180),
    **dict.fromkeys(("rpm", "rmin", "revmin", "1min", "min1"), RPM),
    **dict.fromkeys(("rps", "revs"), 2 * math.pi),
    **dict.fromkeys(("s60deg", "sec60deg", "s60", "sec60"), math.nan),  # the other way round
}
_MASS = {"kg": 1.0, "g": 1e-3, "grams": 1e-3, "oz": OUNCE, "lb": POUND, "lbs": POUND}
_INERTIA = {"kgm2": 1.0, "kgcm2": 1e-4, "gcm2": 1e-7, "kgmm2": 1e-6, "gmm2": 1e-9}
_LENGTH = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": INCH}
_VOLTAGE = {"v": 1.0, "mv": 1e-3}


@dataclass(frozen=True)
class Quantity:
    """What a column may hold.

    Attributes:
        names: What it is called, letters and digits only.
        units: Unit → its size in SI, written likewise; NaN for seconds in 60°.
        si: What it is taken for without a unit; empty if nobody has to be told.
        example: Units that people write behind it, for messages.
    """

    names: tuple[str, ...]
    units: Mapping[str, float]
    si: str = ""
    example: str = ""


QUANTITIES = {
    "name": Quantity(("name", "model", "servo", "motor", "actuator", "part", "type"), {}),
    "stall_torque": Quantity(
        ("stalltorque", "torque", "maxtorque", "peaktorque", "maximumtorque"),
        _TORQUE,
        "N·m",
        "_Nm, _kgcm, [oz·in] and the like",
    ),
    "no_load_speed": Quantity(
        ("noloadspeed", "speed", "maxspeed", "maximumspeed", "operatingspeed"),
        _SPEED,
        "rad/s",
        "_rad_s, _rpm, [s/60°] and the like",
    ),
    "rated_torque": Quantity(("ratedtorque", "nominaltorque", "continuoustorque"), _TORQUE, "N·m"),
    "voltage": Quantity(("voltage", "volts", "supply"), _VOLTAGE),
    "mass": Quantity(("mass", "weight"), _MASS, "kg"),
    "rotor_inertia": Quantity(("rotorinertia", "motorinertia", "inertia"), _INERTIA, "kg·m²"),
    "armature": Quantity(("armature", "reflectedinertia"), _INERTIA, "kg·m²"),
    "gear_ratio": Quantity(("gearratio", "gear", "reduction", "ratio"), {}),
    "size": Quantity(("size", "dimensions"), _LENGTH),
    "length": Quantity(("length",), _LENGTH),
    "width": Quantity(("width",), _LENGTH),
    "height": Quantity(("height", "depth"), _LENGTH),
}
"""Quantity → how it is called, the likeliest first, and in which units."""

_BRACKETS = re.compile(r"[\[(]([^\])]*)[\])]")
_ORDER = re.compile(r"^l\s*[x×*]\s*w\s*[x×*]\s*h\b")
_VOLTS = re.compile(r"(?<![a-z\d.])(?:at|@)?[ _]*(\d+(?:[.,]\d+)?)[ _]*v(?![a-z])")


@dataclass(frozen=True)
class Heading:
    """What a column holds.

    Attributes:
        quantity: A key of :data:`QUANTITIES`.
        factor: Size of its unit in SI; NaN for seconds in 60°.
        plain: Whether it names no unit though its quantity has some.
        voltage: At which its values hold [V]; None if it says none.
    """

    quantity: str
    factor: float = 1.0
    plain: bool = False
    voltage: float | None = None

    def si(self, value: float) -> float:
        """A value in SI."""
        return math.pi / 3 / value if math.isnan(self.factor) else value * self.factor


def understood(heading: str) -> Heading | None:
    """What a heading means; None if it is none of :data:`QUANTITIES`.

    Units stand in brackets or behind the name, with or without ``_``: ``stall_torque_kgcm``,
    ``Torque (oz-in)``, ``speed [s/60°]``. A voltage may stand anywhere: ``torque 6V (kg·cm)``.
    """
    text = heading.strip().lower()
    volts = None
    if match := _VOLTS.search(text):
        volts = float(match[1].replace(",", "."))
        text = text[: match.start()] + " " + text[match.end() :]
    units = [_ORDER.sub("", unit.strip()) for unit in _BRACKETS.findall(text)]
    name, unit = bare(_BRACKETS.sub(" ", text)), bare("".join(units))
    for quantity, known in QUANTITIES.items():
        for called in known.names:
            ending = name.removeprefix(called)
            if not name.startswith(called) or (ending and unit):
                continue
            written = ending or unit
            if not written:
                return Heading(quantity, 1.0, bool(known.units), volts)
            if written in known.units:
                return Heading(quantity, known.units[written], False, volts)
    return None


def bare(text: str) -> str:
    """A unit or name with letters and digits only, in one spelling."""
    text = text.lower().replace("sec", "s")
    for sign, word in (
        ("°", "deg"),
        ("º", "deg"),
        ("˚", "deg"),
        ("²", "2"),
        ("^2", "2"),
        ("per", ""),
        ("degrees", "deg"),
    ):
        text = text.replace(sign, word)
    return re.sub(r"[^a-z0-9]", "", text)
