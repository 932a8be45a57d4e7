"""What holds Pollard together: two ball joints, counted and by rank.

Source: Pollard thesis, 2.2 (degrees of freedom), 2.7 (2.89).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pollard_pin.specification import ACTUATOR_NAMES, Specification, six
from pollard_pin.urdf import ANCHOR_FRAMES, LOOP_NAMES, ROD_TIP_FRAMES, closure_file
from thesis_pin.model.loading import model_folder
from thesis_pin.model.mechanism.supplement import Closure, Motor, Supplement

if TYPE_CHECKING:  # YAML isn't read to load the robot
    from thesis_pin.model.formats.closure_file import ClosureFile

BALL_JOINT = (True, True, True, False, False, False)
"""Rows of the relative twist that a ball joint holds: the three translations."""

BODIES, JOINTS, FREEDOMS = 8, 9, 18
"""b, g and Σf of (2.2): the base, upper arm, forearm, tool, two arms and two rods;
three revolute joints at the base, three universal joints, the wrist counted as one
spherical joint, and two ball joints. The wrist here is three revolute joints in a
point, which gives the tool the same freedom."""


def gruebler(bodies: int = BODIES, joints: int = JOINTS, freedoms: int = FREEDOMS) -> int:
    """Degrees of freedom by Chebyshev, Grübler and Kutzbach, L = 6(b − g − 1) + Σf.

    Source: Pollard thesis, (2.2) in section 2.2.
    """
    return 6 * (bodies - joints - 1) + freedoms


def closures(specification: Specification) -> ClosureFile:
    """The closure file of a specification, as the reader would return it."""
    from thesis_pin.model.formats.closure_file import ClosureFile

    return ClosureFile.parse(closure_file(specification), where=f"{specification.name} closures")


def supplement(specification: Specification) -> Supplement:
    """What the closure file says: ``closures(specification).supplement()`` without its text."""
    loops = zip(LOOP_NAMES, ANCHOR_FRAMES, ROD_TIP_FRAMES, strict=True)
    motors = specification.motors
    rotors = zip(ACTUATOR_NAMES, six(motors.gear_ratio), motors.armature(), strict=True)
    held = bool(motors.armature().any())
    return Supplement(
        closures=tuple(Closure(name, (one, other), BALL_JOINT) for name, one, other in loops),
        motors=tuple(
            Motor(name, name, float(gear), float(armature)) if held else Motor(name, name)
            for name, gear, armature in rotors
        ),
    )


CLOSURE_PATH = str(Path(model_folder("pollard")) / "pollard.closures.yaml")
