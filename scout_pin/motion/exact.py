"""A gait of exact curves as a file: its curves to the bit, and how it was made."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence

from scout_pin.coordinates import POSE_NAMES
from scout_pin.motion.gait import BODIES, Gait
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import instance
from thesis_pin.numeric.piecewise import Piecewise


def exact_toml(gait: Gait, header: Sequence[str] = ()) -> str:
    """A gait in our own format, piece by piece; reading it gives the same curves to the bit.

    Args:
        gait: The gait, made of exact curves.
        header: What stands at its top as comments.

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
    return "\n".join(_lines(gait, header)) + "\n"


def _lines(gait: Gait, header: Sequence[str]) -> Iterator[str]:
    yield from (f"# {line}".rstrip() for text in header for line in text.splitlines() or [""])
    yield from ("", "format = 1", f"name = {_text(gait.name)}", f"source = {_text(gait.source)}")
    yield f"time_unit = {float(gait.time_unit)!r}"
    if gait.cycle:
        yield "cycle = true"
    if gait.branch:
        yield f"branch = {_text(gait.branch)}"
    for body in BODIES:
        yield from ("", f"[{body}]")
        for name, curve in zip(POSE_NAMES, gait.curves[body], strict=True):
            yield from _curve(name, curve)
    for phase in gait.phases:
        yield from ("", "[[phases]]", f"start = {phase.start!r}", f"end = {phase.end!r}")
        yield f"support = {_text(phase.support)}"


def _curve(name: str, curve: Piecewise) -> Iterator[str]:
    if len(curve.c) == 1 and (curve.c == curve.c[0, 0]).all():
        yield f"{name} = {_number(curve.c[0, 0])}"
        return
    yield f"{name} = [{{ t = [{', '.join(map(_number, curve.x))}], pieces = ["
    for piece in curve.c.T.tolist():
        first = next((k for k, value in enumerate(piece) if value), len(piece) - 1)
        yield f"  [{', '.join(map(_number, piece[first:]))}],"
    yield "] }]"


def _number(value: float) -> str:
    return repr(float(value) + 0.0)


def _text(value: str) -> str:
    return json.dumps(value)
