"""Specification → cut-open URDF, closure file and MJCF, byte for byte reproducible.

The loops are cut at the two ball joints. Each leaves a frame on the forearm
(``forearm_anchor_1``, frame 11i of the thesis) and one on the rod's tip
(``chain1_rod_tip``, frame 8i); the closure file says that they coincide.

Source: Pollard thesis, 2.4 (T_03, T_315) and 2.7 (T_02i, T_24i, T_48i, T_311i).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pollard_pin.mjcf import mjcf
from pollard_pin.specification import ACTUATOR_NAMES, JOINT_NAMES, Specification, six
from thesis_pin.files import write_files
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.urdf import bar, cylinder, inertial, joint, robot, sphere
from thesis_pin.model.urdf import number as written
from thesis_pin.numeric.exact import cosine, sine

JOINT_AXES = ("y", "y", "z", "x", "z", "x", "z", "y", "z", "z", "y", "z")
"""Axes of :data:`JOINT_NAMES` in their own frames."""

ANCHOR_FRAMES = ("forearm_anchor_1", "forearm_anchor_2")
"""Ball joints as the forearm sees them, thesis frames 11i."""

ROD_TIP_FRAMES = ("chain1_rod_tip", "chain2_rod_tip")
"""Ball joints as the rods see them, thesis frames 8i."""

LOOP_NAMES = ("ball joint 1", "ball joint 2")
"""Of the loops, in reports."""

TOOL_FRAME = "tool_tip"
"""The spray tip, thesis frame 19."""

ARM_RADIUS = 8e-3
ROD_RADIUS = 4e-3
JOINT_RADIUS = 12e-3
JOINT_LENGTH = 30e-3


def anchors(specification: Specification) -> np.ndarray:
    """Ball joints in the forearm's frame 5 [m], shape ``(2, 3)`` (last column of T_311i)."""
    points = []
    for chain in specification.side_chains:
        beta = math.radians(chain.beta_1413_deg)
        x, y = -chain.x_1211 * cosine(beta), chain.x_1211 * sine(beta)
        points.append([specification.chain_0.x_65 + x, y, -chain.z_1312])
    return np.array(points)


def urdf(specification: Specification, inertia: Reading = "physical") -> str:
    """URDF text of the tree that is left when both ball joints are cut."""
    return robot(specification.name, _elements(specification, inertia))


def closure_file(specification: Specification) -> str:
    """The two ball joints and the motors, in the parallel-robots community's schema."""
    loops = [f"['{a}', '{b}']" for a, b in zip(ANCHOR_FRAMES, ROD_TIP_FRAMES, strict=True)]
    motors = ", ".join(f"'{name}'" for name in ACTUATOR_NAMES)
    rotors = ""
    if specification.motors.armature().any():
        inertias, gears = specification.motors.rotor_inertia, specification.motors.gear_ratio
        rotors = (
            f"  rotor_inertia: [{', '.join(map(written, six(inertias)))}]\n"
            f"  gear_ratio: [{', '.join(map(written, six(gears)))}]\n"
        )
    return (
        f"# Generated from the specification {specification.name!r}. The URDF beside this file\n"
        "# is a tree; these pairs of frames coincide. Motors in the order of the torques.\n"
        f"closed_loop: [{', '.join(loops)}]\n"
        "type: ['3d', '3d']\n"
        f"name_mot: [{motors}]\n"
        "joint_name: []\n"
        "joint_type: []\n"
        "thesis_pin:\n"
        "  format: 1\n"
        f"  robot: {specification.name}\n"
        f"  names: {list(LOOP_NAMES)}\n"
        f"{rotors}"
    )


def files(specification: Specification) -> dict[str, str]:
    """Everything generated from a specification: file name → text."""
    name = specification.name
    return {
        f"{name}.urdf": urdf(specification),
        f"{name}_printed.urdf": urdf(specification, "printed"),
        f"{name}.closures.yaml": closure_file(specification),
        f"{name}.mjcf.xml": mjcf(specification, anchors(specification)),
    }


def write(specification: Specification, folder: str | Path) -> list[Path]:
    """Write every generated file into a folder and return their paths."""
    return write_files(files(specification), folder)


class _Tree:
    """Collects joints and links; holds what every joint and link needs."""

    def __init__(self, specification: Specification, reading: Reading) -> None:
        self.specification, self.reading = specification, reading
        self.lower, self.upper = specification.assumptions.joint_limits.radians()

    def joint(
        self,
        number: int,
        parent: str,
        child: str,
        xyz: tuple[float, float, float],
        turn: float = 0.0,
    ) -> str:
        """A joint by its number, with its limits, at xyz [m] and turned about x [rad]."""
        effort, velocity = self.specification.assumptions.joint_limits.of_joint(number)
        return joint(
            JOINT_NAMES[number],
            parent,
            child,
            xyz=xyz,
            rpy=(turn, 0.0, 0.0),
            axis=JOINT_AXES[number],
            limits=(self.lower[number], self.upper[number], effort, velocity),
        )

    def link(self, name: str, shapes: list[str]) -> str:
        body = ""
        if name in self.specification.links:
            tensor = self.specification.centroidal(name, self.reading)
            mass = self.specification.links[name].mass
            body = inertial(mass, self.specification.com(name).tolist(), tensor)
        return f'  <link name="{name}">\n{body}{"".join(shapes)}  </link>\n'


def _elements(specification: Specification, reading: Reading) -> Iterator[str]:
    tree = _Tree(specification, reading)
    chain, origin = specification.chain_0, (0.0, 0.0, 0.0)
    shoulder, elbow = (0.0, 0.0, chain.z_10), (chain.x_32, 0.0, 0.0)
    wrist, tip = (chain.forearm, 0.0, 0.0), (chain.x_1918, 0.0, 0.0)
    bases = [
        (0.0, sign * side.y_10, 0.0)
        for sign, side in zip(
            specification.assumptions.signs.value, specification.side_chains, strict=True
        )
    ]
    posts = [bar(origin, shoulder, ARM_RADIUS), *(bar(origin, p, ARM_RADIUS) for p in bases)]
    yield tree.link("base", posts)

    yield tree.joint(0, "base", "upper_arm", shoulder)
    hinge = cylinder("y", JOINT_RADIUS, JOINT_LENGTH)
    yield tree.link("upper_arm", [bar(origin, elbow, ARM_RADIUS), hinge])
    yield tree.joint(1, "upper_arm", "elbow_cross", elbow)
    yield tree.link("elbow_cross", [])
    yield tree.joint(2, "elbow_cross", "forearm", origin)
    points = anchors(specification)
    stubs = [bar((chain.x_65, 0.0, 0.0), point, ROD_RADIUS) for point in points]
    balls = [sphere(point, 2 * ROD_RADIUS) for point in points]
    yield tree.link("forearm", [bar(origin, wrist, ARM_RADIUS), *stubs, *balls])
    for frame, point, side in zip(ANCHOR_FRAMES, points, specification.side_chains, strict=True):
        yaw = -math.radians(side.beta_1413_deg)
        yield joint(f"{frame}_joint", "forearm", frame, xyz=point, rpy=(0.0, 0.0, yaw))
        yield tree.link(frame, [])
    parent, place = "forearm", wrist
    for number, name in ((3, "wrist_roll_link"), (4, "wrist_yaw_link"), (5, "tool")):
        yield tree.joint(number, parent, name, place)
        yield tree.link(name, [bar(origin, tip, ROD_RADIUS)] if name == "tool" else [])
        parent, place = name, origin
    yield joint(f"{TOOL_FRAME}_joint", "tool", TOOL_FRAME, xyz=tip)
    yield tree.link(TOOL_FRAME, [])

    for i, (side, base) in enumerate(zip(specification.side_chains, bases, strict=True), start=1):
        number, end = 3 + 3 * i, (side.x_43, 0.0, -side.z_32)
        yield tree.joint(number, "base", f"chain{i}_arm", base)
        hinge = cylinder("z", JOINT_RADIUS, JOINT_LENGTH)
        yield tree.link(f"chain{i}_arm", [bar((0.0, 0.0, -side.z_32), end, ARM_RADIUS), hinge])
        turn = math.radians(side.beta_54_deg)
        yield tree.joint(number + 1, f"chain{i}_arm", f"chain{i}_cross", end, turn)
        yield tree.link(f"chain{i}_cross", [])
        yield tree.joint(number + 2, f"chain{i}_cross", f"chain{i}_rod", origin)
        rod_end = (side.x_87, 0.0, 0.0)
        yield tree.link(f"chain{i}_rod", [bar(origin, rod_end, ROD_RADIUS)])
        frame = ROD_TIP_FRAMES[i - 1]
        yield joint(f"{frame}_joint", f"chain{i}_rod", frame, xyz=rod_end)
        yield tree.link(frame, [])
