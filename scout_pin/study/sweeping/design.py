"""A design of a sweep: its biped, and its specification as a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scout_pin.model import Scout, load
from scout_pin.specification import Specification
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.specification import validate
from thesis_pin.sweep.designs.text import toml

GAIT, PLAN = "gait", "plan"
"""Names under which the data have what isn't of the specification."""

DESIGN = "the design"
"""Where what is wrong with a design's data is, for messages."""


def robot_of(parts: Mapping[str, object], inertia: Reading) -> Scout:
    """The biped of a design.

    Raises:
        SpecificationError: There is none.
    """
    return load(specification_of(parts), inertia=inertia)


def specification_of(parts: Mapping[str, object]) -> Specification:
    """The specification of a design.

    Raises:
        SpecificationError: It is none.
    """
    return validate("specification", Specification, _own(parts), where=DESIGN)


def specification_text(parts: Mapping[str, object], notes: Sequence[str]) -> str:
    """The specification of a design as TOML."""
    return toml(_own(parts), notes)


def _own(parts: Mapping[str, object]) -> dict[str, object]:
    """What is of the specification."""
    return {key: value for key, value in parts.items() if key not in (GAIT, PLAN)}
