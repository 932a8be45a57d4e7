"""Which robot a motion was made for: a name, and a fingerprint of its specification's numbers.

A gait that was planned for one biped is confidently judged on another; what is written therefore
says whose it is, and reports warn where another one follows it.
"""

from __future__ import annotations

import json
from typing import Annotated, Self

from thesis_pin.model.shipped import checksum
from thesis_pin.model.strict import Held, Strict

_BESIDE = frozenset({"name", "source", "why", "motion", "placement", "floor_friction"})
"""Keys that say something of a robot's numbers, of a curve that comes with it, or of its floor."""


class MadeFor(Strict):
    """The robot a motion was made for, as its file says it.

    Attributes:
        robot: Its name.
        fingerprint: Eight hexadecimal digits that tell its numbers from another's.
    """

    robot: Annotated[str, Held(pattern=r"^[A-Za-z][A-Za-z0-9_\-]*$")]
    fingerprint: Annotated[str, Held(pattern=r"^[0-9a-f]{8}$")]

    @classmethod
    def of(cls, specification: Strict) -> Self:
        """What a file says of a motion that is made for a robot of this specification."""
        name = dict(specification)["name"]
        return cls.made(robot=name, fingerprint=fingerprint(specification))

    @property
    def toml(self) -> str:
        """The line of a file that says so."""
        return f'made_for = {{ robot = "{self.robot}", fingerprint = "{self.fingerprint}" }}'

    def against(self, specification: Strict, what: str) -> tuple[str, ...]:
        """What has to be said where a robot follows a motion that wasn't made for it.

        Args:
            specification: The robot's.
            what: What the motion is, as ``gait 'walk'``.

        Returns:
            A clause, or nothing where the robot's numbers are those it was made for.
        """
        here = type(self).of(specification)
        if here.fingerprint == self.fingerprint:
            return ()
        other = "other numbers of that name" if here.robot == self.robot else f"{here.robot!r}"
        return (
            f"the {what} was made for the robot {self.robot!r} (fingerprint {self.fingerprint}) "
            f"and is followed by {other} ({here.fingerprint}): what it was made to keep needn't "
            "hold",
        )


def fingerprint(specification: Strict) -> str:
    """Eight hexadecimal digits that tell a specification's numbers from others.

    Its name, its source and reasons don't count, nor the floor, nor where and when appendix B's
    curve is run, nor how the file is written; a key at its default is as one that is left out.
    """
    text = json.dumps(_numbers(specification), sort_keys=True)
    return f"{checksum(text):08x}"


def _numbers(value: object) -> object:
    if isinstance(value, Strict):
        kind = type(value)
        return {
            name: _numbers(one)
            for name, one in value
            if name not in _BESIDE and not (hasattr(kind, name) and one == getattr(kind, name))
        }
    if isinstance(value, dict):
        return {key: _numbers(one) for key, one in value.items()}
    if isinstance(value, tuple | list):
        return [_numbers(one) for one in value]
    return value + 0.0 if isinstance(value, float) else value  # −0 is 0
