"""Specification → URDF and sole meshes, byte for byte reproducible.

The zero configuration is the servos' neutral pose: each joint's placement
carries the constant angle β of the thesis, and its variable is θ.

Source: Scout thesis, 3.1 (transformations), appendix B.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from scout_pin.specification import JOINT_NAMES, LINK_NAMES, SIDES, Leg, Link, Specification
from thesis_pin.files import write_files
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.urdf import (
    BOTH,
    Kinds,
    bar,
    collision,
    cylinder,
    extruded_polygon,
    inertial,
    joint,
    mesh,
    number,
    robot,
)

JOINT_AXES = ("z", "y", "z", "z", "z", "x")
"""Axes of joints 1 to 6 in their own frames. The thesis prints z for joint 6
(3.1, T_5i,6i), but (3.7), (3.10) and its program turn it about x."""

BAR_RADIUS = 3e-3
SOLE_THICKNESS = 2e-3


def offsets(leg: Leg, sign: float) -> tuple[tuple[float, float, float], ...]:
    """Origins of joints 1 to 6 and of the sole, each in the frame before it [m]."""
    return (
        (sign * leg.x_0, 0.0, 0.0),
        (0.0, 0.0, -leg.z_1),
        (leg.x_2, 0.0, 0.0),
        (leg.x_3, 0.0, 0.0),
        (leg.x_4, 0.0, 0.0),
        (leg.x_5, 0.0, 0.0),
        (0.0, leg.y_6, 0.0),
    )


def urdf(specification: Specification, inertia: Reading = "physical") -> str:
    """URDF text of a biped.

    Args:
        specification: The robot's numbers.
        inertia: Reading of the printed inertias.

    Returns:
        The URDF. Meshes are named relative to it; see :func:`meshes`.
    """
    return robot(specification.name, _elements(specification, inertia))


def meshes(specification: Specification) -> dict[str, str]:
    """Wavefront OBJ text of each sole, by the file name the URDF uses."""
    return {
        f"meshes/{side}_sole.obj": extruded_polygon(specification.leg(side).sole, SOLE_THICKNESS)
        for side in SIDES
    }


def closure_file(specification: Specification) -> str:
    """Motors, rotors and the free root, which a URDF can't say: no loop, but the same schema."""
    servos = [specification.servos[one] for side in SIDES for one in specification.leg(side).servos]
    return (
        f"# Generated from the specification {specification.name!r}: what its URDF can't hold.\n"
        "closed_loop: []\n"
        "type: []\n"
        f"name_mot: [{', '.join(JOINT_NAMES)}]\n"
        "thesis_pin:\n"
        "  format: 1\n"
        f"  robot: {specification.name}\n"
        "  root: free\n"
        f"  rotor_inertia: [{', '.join(number(one.rotor_inertia) for one in servos)}]\n"
        f"  gear_ratio: [{', '.join(number(one.gear_ratio) for one in servos)}]\n"
    )


def files(specification: Specification) -> dict[str, str]:
    """Everything generated from a specification: file name → text.

    A robot whose servos have rotors gets a closure file for them beside the URDF.
    """
    name = specification.name
    rotors = specification.armature().any()
    return {
        **({f"{name}.closures.yaml": closure_file(specification)} if rotors else {}),
        f"{name}.urdf": urdf(specification),
        f"{name}_printed.urdf": urdf(specification, "printed"),
        **meshes(specification),
    }


def write(specification: Specification, folder: str | Path) -> list[Path]:
    """Write every generated file below a folder and return their paths."""
    return write_files(files(specification), folder)


def _elements(specification: Specification, reading: Reading) -> Iterator[str]:
    signs = {"left": -1.0, "right": 1.0}
    hips = [offsets(specification.leg(side), signs[side])[0] for side in SIDES]
    drawn = bar(hips[0], hips[1], BAR_RADIUS, _kinds(specification.torso))
    yield _link("torso", specification.torso, specification, reading, [drawn])
    lower, upper = specification.assumptions.joint_range.radians()
    torque, speed = specification.servo_limits()
    friction = specification.assumptions.joint_friction
    place = 0
    for side in SIDES:
        leg = specification.leg(side)
        points = offsets(leg, signs[side])
        parent = "torso"
        for k in range(6):
            name = f"{side}_{LINK_NAMES[k]}"
            axis = JOINT_AXES[k]
            yield joint(
                JOINT_NAMES[place],
                parent,
                name,
                xyz=points[k],
                rpy=tuple(np.radians(leg.beta_deg[k]) * (letter == axis) for letter in "xyz"),
                axis=axis,
                limits=(lower[place], upper[place], torque[place], speed[place]),
                friction=(friction.viscous, friction.coulomb),
            )
            size = specification.servos[leg.servos[k]].size
            kinds = _kinds(leg.links[k])
            shapes = [
                bar((0.0, 0.0, 0.0), points[k + 1], BAR_RADIUS, kinds),
                cylinder(axis, radius=size[1] / 2, length=size[2], kinds=kinds),
            ]
            yield _link(name, leg.links[k], specification, reading, shapes)
            parent, place = name, place + 1
        yield joint(
            f"{side}_sole_joint",
            parent,
            f"{side}_sole",
            xyz=points[6],
            rpy=(0.0, np.radians(leg.beta_8_deg), np.radians(leg.beta_7_deg)),
        )
        yield f'  <link name="{side}_sole">\n{mesh(f"meshes/{side}_sole.obj")}  </link>\n'


def _kinds(link: Link) -> Kinds:
    """What a link's drawing is there for: to collide too, where nobody says its shape."""
    return ("visual",) if link.collision else BOTH


def _link(
    name: str, link: Link, specification: Specification, reading: Reading, shapes: list[str]
) -> str:
    tensor = link.centroidal(specification.inertia_convention, reading)
    shapes = [*shapes, *map(collision, link.collision)]
    body = inertial(link.mass, link.com, tensor) + "".join(shapes)
    return f'  <link name="{name}">\n{body}  </link>\n'
