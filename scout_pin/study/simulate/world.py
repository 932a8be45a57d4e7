"""Scout on a floor in the second engine: soles, servos, rotors.

Each sole touches the floor at the corners of its convex hull, which are what of a plate on a
plane can touch; where one sole could touch the other, both are plates of that outline.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, SIDES
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.urdf import SOLE_THICKNESS
from thesis_pin.model.urdf import number, numbers
from thesis_pin.numeric.planar import convex_hull
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.simulation.engine import Engine
from thesis_pin.simulation.mjcf import Drive, World, mjcf
from thesis_pin.tolerances import GRAVITY

if TYPE_CHECKING:
    from collections.abc import Iterator

FLOOR_TIME = 5e-3
"""Time [s] in which a contact of the engine gives way and comes back."""

_CORNER = 1e-4
"""Radius [m] of the balls that corners are for the engine: none that anybody could see."""


def walking_tree(robot: Scout, conditions: Conditions, masses: np.ndarray) -> pin.Model:
    """The robot's tree with rotors, joint friction and altered masses.

    Args:
        robot: The biped, with a free-flyer root.
        conditions: Its rotors, where the specification gives none.
        masses: Masses of the bodies in planned ones, ``(13,)``: torso, left leg, right leg.
    """
    tree = robot.model.copy()
    for joint, factor in enumerate(masses.tolist(), start=1):
        body = tree.inertias[joint]
        tree.inertias[joint] = pin.Inertia(
            body.mass * factor, body.lever, np.array(body.inertia) * factor
        )
    tree.armature = np.concatenate([np.zeros(6), rotors(robot, conditions)])
    friction = robot.specification.assumptions.joint_friction
    tree.damping = np.r_[np.zeros(6), np.full(12, friction.viscous)]
    dry = np.r_[np.zeros(6), np.full(12, friction.coulomb)]
    tree.upperDryFrictionLimit, tree.lowerDryFrictionLimit = dry, -dry
    return tree


def rotors(robot: Scout, conditions: Conditions) -> np.ndarray:
    """Inertia of each joint's rotor as the joint feels it [kg·m²], ``(12,)``."""
    given = robot.specification.armature()
    return np.where(given > 0, given, conditions.armature)


def gravity(conditions: Conditions) -> tuple[float, float, float]:
    """Gravity over a floor that is tilted, in the floor's own axes [m/s²]."""
    ahead, right = np.tan(conditions.floor_tilt)
    down = -np.array([right, ahead, 1.0])
    x, y, z = (GRAVITY * down / np.linalg.norm(down)).tolist()
    return x, y, z


def hull(robot: Scout, side: str) -> np.ndarray:
    """Corners of a sole's convex hull in its frame [m], ``(corners, 2)``."""
    outline = np.array(robot.specification.leg(side).sole)
    return np.asarray(outline[convex_hull(outline)])


def engine(robot: Scout, tree: pin.Model, conditions: Conditions) -> Engine:
    """The compiled world.

    Args:
        robot: The biped.
        tree: From :func:`walking_tree`.
        conditions: Friction, tilt, time step, servos.

    Raises:
        BadInput, ModelError: MuJoCo isn't installed, or refuses the robot.
    """
    return Engine(world_text(robot, tree, conditions), tree)


def world_text(robot: Scout, tree: pin.Model, conditions: Conditions) -> str:
    """The world as MJCF."""
    friction = conditions.friction
    if friction is None:
        friction = robot.specification.assumptions.floor_friction.coefficient
    touch = f'friction="{number(friction)} 0 0" solref="{number(FLOOR_TIME)} 1" condim="3"'
    inside, assets = {}, []
    for number_, side in enumerate(SIDES):
        frame = tree.frames[robot.sole_frames[side]]
        joint = str(tree.names[frame.parentJoint])
        inside[joint] = list(_sole(robot, side, frame.placement, touch, number_))
        assets.append(f'<mesh name="{side}_sole" vertex="{numbers(_plate(robot, side).ravel())}"/>')
    gains, stall = conditions.gains, robot.stall_torque.tolist()
    return mjcf(
        tree,
        World(time_step=conditions.time_step, gravity=gravity(conditions)),
        drives=[
            Drive(name, gains.stiffness, gains.damping, limit)
            for name, limit in zip(JOINT_NAMES, stall, strict=True)
        ],
        inside=inside,
        around=[
            f'<geom name="floor" type="plane" size="0 0 1" contype="0" conaffinity="1" {touch}/>'
        ],
        sections=[f"<asset>{''.join(assets)}</asset>"],
    )


def _sole(robot: Scout, side: str, place: pin.SE3, touch: str, number_: int) -> Iterator[str]:
    """A sole's geoms in the frame of the joint that carries it."""
    for k, (x, y) in enumerate(hull(robot, side).tolist()):
        centre = place.act(np.array([x, y, _CORNER]))
        yield (
            f'<geom name="{side}_corner_{k}" type="sphere" size="{number(_CORNER)}" '
            f'pos="{numbers(centre)}" contype="1" conaffinity="0" mass="0" {touch}/>'
        )
    x, y, z, w = quaternions(place.rotation)
    yield (
        f'<geom name="{side}_plate" type="mesh" mesh="{side}_sole" '
        f'pos="{numbers(place.translation)}" quat="{numbers((w, x, y, z))}" '
        f'contype="{2 << number_}" conaffinity="{4 >> number_}" mass="0" {touch}/>'
    )


def _plate(robot: Scout, side: str) -> np.ndarray:
    """Corners of the plate that a sole is to the other one, ``(2 · corners, 3)``."""
    outline = hull(robot, side)
    return np.concatenate(
        [np.column_stack([outline, np.full(len(outline), z)]) for z in (0.0, SOLE_THICKNESS)]
    )
