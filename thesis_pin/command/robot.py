"""A robot's hooks: what the common verbs of its command are made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from thesis_pin.command.registry import Words


@dataclass(frozen=True)
class Robot:
    """Where the common verbs find a robot's functions: ``module:function`` of its package.

    Attributes:
        package: Its package.
        another: What another specification may describe, for help.
        motion: Add the options that say which motion.
        makes_report: Report on the motion that the arguments ask for; see
            :class:`thesis_pin.command.verbs.MakeReport`.
        report: The public function behind it.
        page: The report as a page.
        scene: The report as a scene.
        solves: Inverse kinematics that the arguments ask for, an
            :class:`~thesis_pin.command.verbs.Answer`.
        inverse_kinematics: The public method behind it.
        figures, table: The report as files, and printed.
        load, specification: Read a specification, with its model and without.
        info, print_info: What it describes, as JSON and printed.
        urdf, files: Its URDF in one reading, and everything generated from it.
        thesis, audit: The thesis ready to be audited, and the function that does it.
    """

    package: str
    another: str
    motion: Callable[[Words], None]
    report: str
    page: str
    scene: str
    inverse_kinematics: str
    makes_report: str = "verbs:report"
    solves: str = "verbs:ik"
    figures: str = "report.figures:figures"
    table: str = "report.tables:print_report"
    load: str = "model:load"
    specification: str = "specification:Specification.read"
    info: str = "report.info:document"
    print_info: str = "report.info:print_info"
    urdf: str = "urdf:urdf"
    files: str = "urdf:files"
    audit: str = "thesis.audit:audit"
    thesis: str = "thesis.audit:THESIS"

    @property
    def command(self) -> str:
        """Name of its command."""
        return self.package.replace("_", "-")

    def name_of(self, hook: str) -> str:
        """A hook's full name, for :func:`~thesis_pin.command.registry.found`."""
        return f"{self.package}.{hook}"
