"""What of a robot's file is read, what is passed over and named: one record a format.

``thesis-pin formats`` prints it, docs/any_robot.md shows it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass

from thesis_pin.report.tables import Part, Table

SCHEMA, VERSION = "thesis-pin/formats", 1


@dataclass(frozen=True)
class Format:
    """A format that robots are described in.

    Attributes:
        name: What people call it.
        known_by: By what it is told from the others: its root element, as a rule.
        used: What of it counts.
        passed_over: What of it doesn't, and is named each time a file has it.
        needs: What has to be installed beside this package; empty for nothing.
    """

    name: str
    known_by: str
    used: tuple[str, ...]
    passed_over: tuple[str, ...]
    needs: str = ""


FORMATS = (
    Format(
        "URDF",
        "<robot>",
        (
            "links and their inertials",
            "joints, limits, damping and friction",
            "<mimic> as a coupling",
            "a link with two parents, cut into a closure",
            "frames closing_NAME_1/_2 and closedloopNAME_A/_B, where no file closes loops",
            "visual and collision shapes",
        ),
        ("<transmission>", "<gazebo>", "<safety_controller>", "<calibration>", "<constraint>"),
    ),
    Format(
        "closure file",
        "YAML beside another file",
        (
            "closed_loop and type: 3d, 6d, hinge_z, universal_xy, rod, any mask as xyz--z",
            "name_mot: motors",
            "joint_name and joint_type: SPHERICAL, UJOINT_XY and the like, FIXED",
            "thesis_pin: names, lengths, couplings, motors, rotor_inertia, gear_ratio, springs, "
            "armature, damping, friction, poses, root, gravity",
        ),
        (),
    ),
    Format(
        "URDF+",
        "<robot> with <loop> or <coupling>",
        ("all of URDF", "<loop> as a closure of its type", "<coupling>", "independent joints"),
        ("as URDF",),
    ),
    Format(
        "MJCF",
        "<mujoco>",
        (
            "bodies, inertias (from geometry too), several joints a body",
            "equality: connect, weld, joint of degree 1",
            "actuators on joints: gear, force range",
            "springs, damping, friction, armature",
            "keyframes and qpos0 as poses",
            "gravity",
        ),
        (
            "tendons and what acts on them",
            "other equalities",
            "plugins",
            "fluid, gravcomp, mocap",
        ),
        "mujoco",
    ),
    Format(
        "SDF",
        "<sdf>",
        (
            "poses with relative_to, axes with expressed_in",
            "revolute, continuous, prismatic, fixed, ball, universal, revolute2 joints",
            "gearboxes as couplings, springs, damping, friction",
            "loops, cut into closures; the cuts are named",
        ),
        ("<include>", "<plugin>", "<gripper>"),
    ),
    Format(
        "example:NAME",
        "a name instead of a file",
        ("robots of example-robot-data: stem of a URDF or SDF, or its folder's name",),
        (),
    ),
)
"""In the order in which they are told."""


def formats() -> tuple[Format, ...]:
    """Every format that :func:`thesis_pin.load` reads."""
    return FORMATS


def document() -> dict[str, object]:
    """JSON-ready; docs/conventions.md describes the schema."""
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "formats": [asdict(one) for one in FORMATS],
    }


def summary() -> Iterator[Part]:
    """What people are told: a table of the formats, then what of each is read."""
    yield Table(
        "",
        ("format", "known by", "needs"),
        [(one.name, one.known_by, one.needs) for one in FORMATS],
        prose=True,
    )
    for one in FORMATS:
        yield f"{one.name}: {'; '.join(one.used)}."
        if one.passed_over:
            yield f"  Not used, and named: {'; '.join(one.passed_over)}."
