"""Specification → MJCF: the closed mechanism for MuJoCo, the same tree for Pinocchio.

The ball joints are ``<connect>`` equalities between two sites: given by bodies
and one anchor, MuJoCo would compute the second anchor from the open zero pose.
Everything hangs in one jointless body, because Pinocchio's reader takes only
the first body of the world and says nothing about the others.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pollard_pin.specification import ACTUATOR_NAMES, ACTUATORS, JOINT_NAMES, Specification
from thesis_pin.model.mechanism.inertia import Reading
from thesis_pin.model.urdf import number, numbers
from thesis_pin.numeric.exact import cosine, sine
from thesis_pin.tolerances import GRAVITY

# MuJoCo's springs at their stiffest that its integrators still carry at 1 ms: a
# time constant of 2 ms, and 0.9999 of the free acceleration taken away.
_STIFF, _HARD = "0.002 1", "0.9999 0.9999 0.001 0.5 2"

_AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}


def mjcf(specification: Specification, anchors: np.ndarray, inertia: Reading = "physical") -> str:
    """MJCF text of the closed mechanism.

    Args:
        specification: The robot's numbers.
        anchors: Ball joints in the forearm's frame [m], shape ``(2, 3)``.
        inertia: Reading of the printed inertias.

    Returns:
        The MJCF. MuJoCo's equalities are soft; how far that moves accelerations
        and forces is measured in docs/pollard.md.
    """
    writer = _Writer(specification, inertia)
    chain = specification.chain_0
    origin = (0.0, 0.0, 0.0)
    sites = [_site(f"forearm_anchor_{i}", point, 10) for i, point in enumerate(anchors, start=1)]
    tool = writer.body(
        "tool", 10, [(5, "x")], origin, [_site("tool_tip", (chain.x_1918, 0.0, 0.0), 12)]
    )
    yaw = writer.body("wrist_yaw_link", 9, [(4, "z")], origin, [tool])
    roll = writer.body("wrist_roll_link", 8, [(3, "x")], (chain.forearm, 0.0, 0.0), [yaw])
    forearm = writer.body(
        "forearm", 7, [(1, "y"), (2, "z")], (chain.x_32, 0.0, 0.0), [*sites, roll]
    )
    content = [writer.body("upper_arm", 6, [(0, "y")], (0.0, 0.0, chain.z_10), [forearm])]
    signs = specification.assumptions.signs.value
    for i, (sign, side) in enumerate(zip(signs, specification.side_chains, strict=True), start=1):
        first = 3 + 3 * i
        rod = writer.body(
            f"chain{i}_rod",
            7,
            [(first + 1, "y"), (first + 2, "z")],
            (side.x_43, 0.0, -side.z_32),
            [_site(f"chain{i}_rod_tip", (side.x_87, 0.0, 0.0), 8)],
            turn=math.radians(side.beta_54_deg),
        )
        base = (0.0, sign * side.y_10, 0.0)
        content.append(writer.body(f"chain{i}_arm", 6, [(first, "z")], base, [rod]))
    connects = "".join(
        f'    <connect name="ball_joint_{i}" site1="forearm_anchor_{i}" '
        f'site2="chain{i}_rod_tip" solref="{_STIFF}" solimp="{_HARD}"/>\n'
        for i in (1, 2)
    )
    efforts, _ = specification.assumptions.joint_limits.of_motors()
    motors = "".join(
        f'    <motor name="{name}" joint="{name}" ctrllimited="true" '
        f'ctrlrange="-{effort} {effort}"/>\n'
        for name, effort in zip(ACTUATOR_NAMES, map(number, efforts), strict=True)
    )
    return (
        f'<mujoco model="{specification.name}">\n'
        '  <compiler angle="radian" autolimits="true"/>\n'
        f'  <option gravity="0 0 {-GRAVITY}" integrator="implicitfast"/>\n'
        "  <worldbody>\n"
        '    <body name="base">\n'
        f"{''.join(content)}"
        "    </body>\n"
        "  </worldbody>\n"
        f"  <equality>\n{connects}  </equality>\n"
        f"  <actuator>\n{motors}  </actuator>\n"
        "</mujoco>\n"
    )


class _Writer:
    def __init__(self, specification: Specification, reading: Reading) -> None:
        self.specification, self.reading = specification, reading
        self.lower, self.upper = specification.assumptions.joint_limits.radians()
        armature = zip(ACTUATORS, specification.motors.armature(), strict=True)
        self.rotors = {k: f' armature="{number(value)}"' for k, value in armature if value}

    def body(
        self,
        name: str,
        indent: int,
        joints: Sequence[tuple[int, str]],
        xyz: Sequence[float],
        content: Sequence[str],
        turn: float = 0.0,
    ) -> str:
        """A body with its hinges, inertia and children; ``turn`` is about x [rad]."""
        pad = " " * indent
        tensor = self.specification.centroidal(name, self.reading)
        entries = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        quaternion = (cosine(turn / 2), sine(turn / 2), 0.0, 0.0)
        hinges = "".join(
            f'{pad}  <joint name="{JOINT_NAMES[k]}" type="hinge" axis="{_AXES[axis]}" '
            f'range="{number(self.lower[k])} {number(self.upper[k])}"{self.rotors.get(k, "")}/>\n'
            for k, axis in joints
        )
        return (
            f'{pad}<body name="{name}" pos="{numbers(xyz)}" quat="{numbers(quaternion)}">\n'
            f"{hinges}"
            f'{pad}  <inertial pos="{numbers(self.specification.com(name))}" '
            f'mass="{number(self.specification.links[name].mass)}" '
            f'fullinertia="{numbers(entries)}"/>\n'
            f"{''.join(content)}"
            f"{pad}</body>\n"
        )


def _site(name: str, xyz: Sequence[float], indent: int) -> str:
    return f'{" " * indent}<site name="{name}" pos="{numbers(xyz)}"/>\n'
