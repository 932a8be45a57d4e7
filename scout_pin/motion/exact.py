"""A gait of exact curves as a file: its curves piece by piece, to the bit in SI."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

import numpy as np

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES, Gait
from thesis_pin.errors import BadInput
from thesis_pin.model.limits import LIMITS
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.piecewise import Piecewise
from thesis_pin.tables.units import Unit
from thesis_pin.tables.writing import WrittenUnits, texts

_LONGEST = 26
"""Characters of a number with all its digits, and of what parts it from the next."""


def exact_toml(gait: Gait, header: Sequence[str] = (), units: WrittenUnits | None = None) -> str:
    """A gait in our own format, piece by piece; reading it gives the same curves to the bit.

    Args:
        gait: The gait, made of exact curves.
        header: What stands at its top as comments.
        units: Units of lengths and angles; None is SI, others cost a rounding.

    Raises:
        BadInput: The gait comes from samples of finite resolution, of which curves say too little.
    """
    instance("gait", gait, Gait, "scout_pin.plan_gait()")
    if gait.variants is not None:
        raise BadInput(
            f"gait {gait.name!r} was smoothed from samples",
            allowed="a gait of exact curves",
            remedy="scout-pin convert writes it",
        )
    return "\n".join(_lines(gait, header, units or WrittenUnits())) + "\n"


def fits(gait: Gait) -> bool:
    """Whether a file of all its pieces can be read again."""
    curves = [curve for six in gait.curves.values() for curve in six]
    numbers = sum(curve.c.size + 2 * curve.x.size for curve in curves)
    largest = max(float(np.abs(curve.c).max()) for curve in curves)
    # In millimetres or degrees coefficients are a thousandfold at most.
    return (
        numbers < LIMITS.values
        and _LONGEST * numbers < LIMITS.toml_bytes
        and 1e3 * largest < LIMITS.magnitude
    )


def _lines(gait: Gait, header: Sequence[str], units: WrittenUnits) -> Iterator[str]:
    yield from (f"# {line}".rstrip() for text in header for line in text.splitlines() or [""])
    yield from ("", "format = 1", f"name = {_text(gait.name)}", f"source = {_text(gait.source)}")
    yield f"time_unit = {float(gait.time_unit)!r}"
    if gait.cycle:
        yield "cycle = true"
    if gait.branch:
        yield f"branch = {_text(gait.branch)}"
    if gait.made_for:
        yield gait.made_for.toml
    for body in BODIES:
        yield from ("", f"[{body}]")
        for name, curve in zip(POSE_NAMES, gait.curves[body], strict=True):
            yield from _curve(name, curve, units.length if name in "xyz" else units.angle)
    for phase in gait.phases:
        yield from ("", "[[phases]]", f"start = {phase.start!r}", f"end = {phase.end!r}")
        yield f"support = {_text(phase.support)}"


def _curve(name: str, curve: Piecewise, unit: Unit) -> Iterator[str]:
    key = name + key_ending(unit)
    if len(curve.c) == 1 and (curve.c == curve.c[0, 0]).all():
        yield f"{key} = {toml_number(texts(curve.c[0, :1], unit)[0])}"
        return
    yield f"{key} = [{{ t = [{', '.join(map(_number, curve.x))}], pieces = ["
    for piece in curve.c.T:
        first = next((k for k, value in enumerate(piece.tolist()) if value), len(piece) - 1)
        yield f"  [{', '.join(map(toml_number, texts(piece[first:], unit)))}],"
    yield "] }]"


def key_ending(unit: Unit) -> str:
    """How a key says a unit: SI is said by nothing."""
    return "" if unit.ending in ("_m", "_rad") else unit.ending


def toml_number(text: str) -> str:
    """A number as TOML has it."""
    return text if "." in text or "e" in text else f"{text}.0"


def _number(value: float) -> str:
    return repr(float(value) + 0.0)


def _text(value: str) -> str:
    return json.dumps(value)
