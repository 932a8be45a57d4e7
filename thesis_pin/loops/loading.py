"""Any file of a robot → a checked robot with closed loops."""

from __future__ import annotations

import warnings
from pathlib import Path

from thesis_pin.errors import ModelWarning
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.model.formats.closure_file import FILE_KIND, ClosureFile
from thesis_pin.model.formats.joining import joined
from thesis_pin.model.formats.reading import read
from thesis_pin.model.loading import RootJoint, checked


def load(
    file: str | Path, closures: str | Path | None = None, *, root_joint: RootJoint = None
) -> ClosedRobot:
    """Load a robot with closed loops.

    Args:
        file: Path of its description: URDF or URDF+, MJCF, SDF; or ``example:NAME`` for a
            robot of example-robot-data, as ``example:panda``.
        closures: Path of the closure file, for what the description can't say.
        root_joint: Joint between world and root link, ``None`` for what the files say.

    Returns:
        The robot: Pinocchio model, loops, motors. What is odd in its files is in
        ``robot.description.warnings``, and said once as a :class:`ModelWarning`.

    Raises:
        BadInput: A file can't be read.
        SpecificationError: The closure file breaks its schema.
        UnknownName: It names a frame or joint that the robot doesn't have; or there is no
            such example.
        ModelError: The file doesn't describe a mechanism, or a motor or loop makes no sense.
    """
    beside = None if closures is None else ClosureFile.read(closures)
    described = checked(read(file, motors=() if beside is None else beside.name_mot))
    if beside is not None:
        described = joined(described, beside.supplement())
    where = FILE_KIND if closures is None else str(closures)
    robot = ClosedRobot(described, root_joint=root_joint, where=where)
    if found := robot.description.warnings:
        warnings.warn("; ".join((f"{file}: {found[0]}", *found[1:])), ModelWarning, stacklevel=2)
    return robot
