"""The checked forms of the specifications and gaits that ship: ``NAME.json`` beside ``NAME.toml``.

And the wrench cones of Scout's soles, ``scout.cones.json``.

Run ``python docs/shipped.py`` to renew them; a test fails when one is stale.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pollard_pin.specification import POLLARD_PATH
from pollard_pin.specification import Specification as Pollard
from scout_pin.motion.files import GAITS, PRESETS, GaitFile
from scout_pin.specification import CONES_PATH, SCOUT_PATH, SIDES
from scout_pin.specification import Specification as Scout
from thesis_pin.contacts.cones import Contact
from thesis_pin.contacts.known import known_form
from thesis_pin.model.shipped import checked_form
from thesis_pin.model.source import read_text
from thesis_pin.model.specification import read_toml
from thesis_pin.model.strict import Strict

SHIPPED: dict[Path, tuple[str, type[Strict]]] = {
    SCOUT_PATH: ("specification", Scout),
    POLLARD_PATH: ("specification", Pollard),
    **{GAITS / f"{name}.toml": ("gait", GaitFile) for name in PRESETS},
}
"""TOML file → what it is and what it must satisfy."""


def cones() -> list[Contact]:
    """What the floor can do to Scout's soles, found anew."""
    scout = Scout.read()
    friction = scout.assumptions.floor_friction.coefficient
    return [Contact.from_outline(np.array(scout.leg(side).sole), friction) for side in SIDES]


def documents() -> dict[Path, str]:
    """What stands in each generated file, by its path."""
    return {
        path.with_suffix(".json"): checked_form(
            read_text(kind, path), read_toml(kind, schema, path)
        )
        for path, (kind, schema) in SHIPPED.items()
    }


if __name__ == "__main__":
    for path, text in documents().items():
        path.write_text(text, encoding="utf-8")
    CONES_PATH.write_text(known_form(cones()), encoding="utf-8")
