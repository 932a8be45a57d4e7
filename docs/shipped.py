"""The checked forms of the specifications and gaits that ship: ``NAME.json`` beside ``NAME.toml``.

Run ``python docs/shipped.py`` to renew them; a test fails when one is stale.
"""

from __future__ import annotations

from pathlib import Path

from pollard_pin.specification import POLLARD_PATH
from pollard_pin.specification import Specification as Pollard
from scout_pin.motion.files import GAITS, PRESETS, GaitFile
from scout_pin.specification import SCOUT_PATH
from scout_pin.specification import Specification as Scout
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
