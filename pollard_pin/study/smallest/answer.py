"""What is answered of a path: the smallest motors, and the path with the laws they follow it by."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from pollard_pin.motion.law_file import law_toml
from pollard_pin.motion.path import ToolPath
from pollard_pin.study.timing.course import Course
from thesis_pin.model.made_for import MadeFor
from thesis_pin.sizing.smallest.answer import Answer
from thesis_pin.timing.law import Law


@dataclass(frozen=True, eq=False)
class PathAnswer(Answer):
    """The smallest motors for a path, and the laws of time that they follow it by.

    Attributes:
        course: The path's geometry on the robot; None where no law was asked for.
        laws: What a case is called → its law.
    """

    course: Course | None = None
    laws: Mapping[str, Law] = field(default_factory=dict)

    @property
    def paths(self) -> dict[str, ToolPath]:
        """The path with each law, to be reported on: what its case is called → the path."""
        return (
            {}
            if self.course is None
            else {
                name: self.course.track.chain.timed(
                    law, f"{self.course.path.name}, {name}", {"law": name}, self.course.notes
                )
                for name, law in self.laws.items()
            }
        )

    def files(self) -> dict[str, bytes]:
        """The path with each law, as ``pollard-pin trajectory --path`` reads it."""
        if self.course is None:
            return {}
        own, chain = MadeFor.of(self.course.robot.specification), self.course.track.chain
        name = self.course.path.name
        return {
            f"path-{kind}.toml": law_toml(f"{name}, {kind}", chain, law, own).encode()
            for kind, law in self.laws.items()
        }
