"""Scout on a floor in the second engine: soles, servos, rotors.

Each sole touches the floor at the corners of its convex hull, which are what of a plate on a
plane can touch; where one sole could touch the other, both are plates of that outline.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pinocchio as pin

from scout_pin.model import Scout
from scout_pin.specification import JOINT_NAMES, SIDES
from scout_pin.study.simulate.conditions import SHORTEST, USUAL, Conditions
from scout_pin.urdf import SOLE_THICKNESS
from thesis_pin.errors import BadInput
from thesis_pin.model.urdf import number, numbers
from thesis_pin.numeric.planar import convex_hull
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.simulation.engine import Engine
from thesis_pin.simulation.mjcf import Drive, World, mjcf
from thesis_pin.tolerances import GRAVITY

FLOOR_TIME = 5e-3
"""Time [s] in which a contact of the engine gives way and comes back."""

_FINE, _COARSE = 0.5, 1.0
"""Steps of the engine as shares of the time in which a servo swings its joint by a radian."""

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


def time_step(robot: Scout, conditions: Conditions, q: np.ndarray) -> float:
    """The engine's time step [s]: what is asked for, or what the servos allow.

    A joint on a servo swings at the square root of stiffness over the inertia it feels; an engine
    whose steps are longer than that lets it swing ever farther.

    Args:
        robot: The biped.
        conditions: Servos, rotors, and the step that is asked for.
        q: A pose of the gait, ``(19,)``.

    Raises:
        BadInput: Servos are too stiff for it.
    """
    tree = walking_tree(robot, conditions, np.ones(len(robot.model.inertias) - 1))
    mass = pin.crba(tree, tree.createData(), q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    felt = np.linalg.inv(mass)[6:, 6:]
    swing = float(np.sqrt(conditions.gains.stiffness * np.linalg.eigvalsh(felt)[-1]))
    step = conditions.time_step
    if step is None:
        step = min(USUAL, _FINE / swing)
    if step * swing > _COARSE or step < SHORTEST:
        raise BadInput(
            f"servos of {conditions.gains.stiffness:g} N·m/rad swing their joints at "
            f"{swing:.3g} rad/s, too fast for steps of {step:.3g} s",
            allowed=f"steps of at most {_COARSE / swing:.2g} s and at least {SHORTEST:g} s",
            remedy="Take shorter steps, softer servos or heavier rotors",
        )
    return step


def engine(robot: Scout, tree: pin.Model, conditions: Conditions, step: float) -> Engine:
    """The compiled world.

    Args:
        robot: The biped.
        tree: From :func:`walking_tree`.
        conditions: Friction, tilt, servos.
        step: Time step [s].

    Raises:
        BadInput, ModelError: MuJoCo isn't installed, or refuses the robot.
    """
    return Engine(world_text(robot, tree, conditions, step), tree)


def world_text(robot: Scout, tree: pin.Model, conditions: Conditions, step: float) -> str:
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
        World(time_step=step, gravity=gravity(conditions)),
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
