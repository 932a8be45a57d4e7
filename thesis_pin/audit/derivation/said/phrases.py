"""Words that say what a symbol must be: "position of link2 along xy", "mass matrix"."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass

from thesis_pin.errors import BadInput, UnknownName

POINTS = ("position", "velocity", "acceleration", "speed")
TURNS = ("rotation", "angular velocity", "angular acceleration")
JACOBIANS = ("jacobian", "linear jacobian", "angular jacobian")
ENERGIES = ("kinetic energy", "potential energy", "lagrangian", "energy")
VECTORS = (
    *("coordinates", "coriolis vector", "gravity vector", "bias vector", "inertial force"),
    *("torque", "momentum"),
)
MATRICES = ("mass matrix", "coriolis matrix")
BODIES = ("mass", "inertia", "inertia tensor")
QUANTITIES = (
    *POINTS,
    *TURNS,
    "transform",
    *JACOBIANS,
    *ENERGIES,
    *VECTORS,
    *MATRICES,
    *BODIES,
    *("distance", "offset", "gravity"),
)
"""All that can be said, in the order of the documentation."""
_NEEDS_OF = (*POINTS, *TURNS, "transform", *JACOBIANS, "mass", "inertia", "inertia tensor")
_BETWEEN_TWO = ("distance", "offset")
_WORDS = {"of": "of", "in": "seen", "along": "axes", "entry": "entry"}
_BETWEEN = {"from": "seen", "to": "to"}
_AXES = re.compile(r"[xyz]{1,3}")


@dataclass(frozen=True)
class Phrase:
    """What a symbol must be.

    Attributes:
        quantity: One of :data:`QUANTITIES`.
        of: The frame, link or joint; empty for the whole robot.
        centre: Whether its centre of mass is meant.
        seen: Frame from whose origin and along whose axes a position or a distance is measured;
            along whose axes the components of all else are; empty for the world.
        to: The other end of a distance.
        axes: Of a vector, which components; of an inertia, which element.
        entry: Numbers of an entry, from 1.
    """

    quantity: str
    of: str = ""
    centre: bool = False
    seen: str = ""
    to: str = ""
    axes: str = ""
    entry: tuple[int, ...] = ()


def parse(text: str, where: str) -> Phrase:
    """Read such words.

    Args:
        text: ``QUANTITY [AXES] [of [centre of] FRAME] [in FRAME] [along AXES] [entry I [J]]``, or
            ``distance from FRAME to FRAME``, ``offset AXIS from FRAME to FRAME``.
        where: File and key, for messages.

    Raises:
        UnknownName: There is no such quantity.
        BadInput: The words after it make no sense.
    """
    words = text.split()
    joined = " ".join(words)
    quantity = max(
        (one for one in QUANTITIES if f"{joined} ".lower().startswith(f"{one} ")),
        key=len,
        default="",
    )
    if not quantity:
        raise UnknownName("quantity", text, QUANTITIES, where=where)
    rest = words[len(quantity.split()) :]
    keys = _BETWEEN if quantity in _BETWEEN_TWO else _WORDS
    found: dict[str, object] = {}
    if rest and _AXES.fullmatch(rest[0]):
        found["axes"] = rest.pop(0)
    while rest:
        word = rest.pop(0)
        if word == "of" and rest[:1] in (["centre"], ["center"]):
            found["centre"] = True
            del rest[:1]
            if rest[:1] != ["of"]:
                continue
            word = rest.pop(0)
        key = keys.get(word)
        if word == "entry" and rest and all(one.isdigit() for one in rest):
            found["entry"] = tuple(map(int, rest))
            rest = []
        elif not found and key is None and _near(joined):
            raise UnknownName("quantity", text, QUANTITIES, where=where)
        elif key is None or not rest or (key in found and key != "of"):
            raise BadInput(
                f"{text!r} can't be understood at {word!r}",
                where=where,
                allowed=f"{', '.join(keys)}, each with what follows it",
            )
        else:
            found[key] = rest.pop(0)
    phrase = Phrase(quantity, **found)  # type: ignore[arg-type]
    _check(phrase, text, where)
    return phrase


def _near(text: str) -> bool:
    """Whether another quantity resembles the first words."""
    words = " ".join(text.lower().split()[:2])
    return bool(difflib.get_close_matches(words, QUANTITIES, n=1, cutoff=0.8))


def _check(phrase: Phrase, text: str, where: str) -> None:
    wrong = ""
    if phrase.quantity in _NEEDS_OF and not (phrase.of or phrase.centre):
        wrong = "of what? Say: of FRAME, or of centre of LINK"
    elif phrase.axes and not _AXES.fullmatch(phrase.axes):
        wrong = f"{phrase.axes!r} aren't axes: some of x, y and z"
    elif phrase.quantity == "inertia" and len(phrase.axes) != len("xx"):
        wrong = "which element? Say: inertia zz of LINK, or inertia tensor of LINK"
    elif phrase.quantity in _BETWEEN_TWO and not (phrase.seen and phrase.to):
        wrong = "from where to where? Say: from FRAME to FRAME"
    elif phrase.quantity == "offset" and len(phrase.axes) != 1:
        wrong = "along which axis? Say: offset x from FRAME to FRAME"
    elif any(number < 1 for number in phrase.entry) or len(phrase.entry) > len("ij"):
        wrong = "entries are counted from 1, and have one number or two"
    if wrong:
        raise BadInput(f"{text!r} says too little: {wrong}", where=where)
