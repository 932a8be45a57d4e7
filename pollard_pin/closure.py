"""What holds Pollard together: two ball joints, counted and by rank.

Source: Pollard thesis, 2.2 (degrees of freedom), 2.7 (2.89).
"""

from __future__ import annotations

from pathlib import Path

from pollard_pin.specification import Specification
from pollard_pin.urdf import closure_file
from thesis_pin.model.formats.closure_file import ClosureFile
from thesis_pin.model.loading import model_folder

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
    return ClosureFile.parse(closure_file(specification), where=f"{specification.name} closures")


CLOSURE_PATH = str(Path(model_folder("pollard")) / "pollard.closures.yaml")
