"""A specification as TOML, with a word on every number."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from scout_pin.specification import LINK_NAMES, SIDES, Leg, Link, Specification

_LENGTHS = {
    "x_0": "middle to hip yaw axis, sideways",
    "z_1": "down to the hip roll axis",
    "x_2": "along link 2 to hip pitch",
    "x_3": "thigh: hip pitch to knee",
    "x_4": "shank: knee to ankle pitch",
    "x_5": "ankle pitch along the ankle roll axis",
    "y_6": "from that axis to the sole's origin",
}


def toml(specification: Specification, notes: Sequence[str] = ()) -> str:
    """A specification's text; reading it gives the same to the last bit.

    Args:
        specification: The specification.
        notes: What stands at its top as comments.
    """
    return "\n".join(_lines(specification, notes)) + "\n"


def _lines(spec: Specification, notes: Sequence[str]) -> Iterator[str]:
    yield "# A biped of Scout's kind; see docs/scout.md and docs/your_biped.md."
    yield "# SI units; angles in degrees where the key says so."
    for note in notes:
        yield from (f"# {line}" for line in _wrapped(note))
    yield ""
    yield "format = 1"
    yield f"name = {_text(spec.name)}"
    yield f"source = {_text(spec.source)}"
    yield f"inertia_convention = {_text(spec.inertia_convention)}"
    yield from _branch_keys(spec)
    for name, servo in spec.servos.items():
        yield ""
        yield f"[servos.{_text(name)}]"
        yield f"stall_torque = {servo.stall_torque!r} # N·m"
        yield f"no_load_speed = {servo.no_load_speed!r} # rad/s"
        yield f"size = {_list(servo.size)} # m, to draw it and to judge its power by"
        if servo.rotor_inertia:
            yield f"rotor_inertia = {servo.rotor_inertia!r} # kg·m², about the motor's axis"
            yield f"gear_ratio = {servo.gear_ratio!r}"
    assumptions: dict[str, Any] = spec.assumptions.model_dump()
    for name, one in assumptions.items():
        yield ""
        yield f"[assumptions.{name}]"
        yield from (f"{key} = {_value(value)}" for key, value in one.items())
    yield ""
    yield "[torso]"
    yield from _link(spec.torso)
    for side in SIDES:
        yield ""
        yield f"[legs.{side}]"
        yield from _leg(spec.leg(side))
        for name, link in zip(LINK_NAMES, spec.leg(side).links, strict=True):
            yield ""
            yield f"[[legs.{side}.links]] # {name}"
            yield from _link(link)


def _branch_keys(spec: Specification) -> Iterator[str]:
    for key in ("knee", "branch"):
        if (value := getattr(spec, key)) is not None:
            yield f"{key} = {_text(value)}"
    if spec.neutral_soles != "flat":
        yield f"neutral_soles = {_text(spec.neutral_soles)} # flat is the rule"


def _leg(leg: Leg) -> Iterator[str]:
    for key, what in _LENGTHS.items():
        yield f"{key} = {getattr(leg, key)!r} # {what}"
    yield f"beta_deg = {_list(leg.beta_deg)}"
    yield f"beta_7_deg = {leg.beta_7_deg!r}"
    yield f"beta_8_deg = {leg.beta_8_deg!r}"
    yield f"servo = {_value(leg.servo)}"
    yield "sole = ["
    yield from (f"  {_list(corner)}," for corner in leg.sole)
    yield "]"


def _link(link: Link) -> Iterator[str]:
    yield f"mass = {link.mass!r}"
    yield f"com = {_list(link.com)}"
    yield "inertia = ["
    yield from (f"  {_list(row)}," for row in link.inertia)
    yield "]"


def _list(values: Sequence[object]) -> str:
    return "[" + ", ".join(_value(value) for value in values) + "]"


def _value(value: object) -> str:
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, list | tuple):
        return _list(value)
    return repr(value)


def _text(value: str) -> str:
    """A basic string; what TOML would read otherwise as an escape."""
    out = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in out) + '"'


def _wrapped(text: str) -> list[str]:
    import textwrap

    return textwrap.wrap("".join(c if c.isprintable() else " " for c in text), 96) or [""]
