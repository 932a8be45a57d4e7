"""A description of a robot of the kind → a specification of the same robot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from scout_pin.implausible import implausible
from scout_pin.kinematics.neutral import tilts
from scout_pin.making.axes import TINY, LegAxes, leg_axes, torso_frame
from scout_pin.making.chains import find_chains
from scout_pin.making.drives import friction_of, one_or_all, servo_of, size_of, turn_range
from scout_pin.making.legs import leg_entry, neat
from scout_pin.making.soles import Sole, find_sole
from scout_pin.making.text import toml
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.errors import ModelError
from thesis_pin.model.formats.reading import read
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.mechanism.description import MovingBody
from thesis_pin.model.mechanism.inertia import parallel_axis
from thesis_pin.model.specification import validate
from thesis_pin.numeric.checks import shown
from thesis_pin.tolerances import TOLERANCES

Matrix = np.ndarray


@dataclass(frozen=True, eq=False)
class Translation:
    """A specification made from a description.

    Attributes:
        specification: It.
        joints: Name of each joint in the file, in the order of
            :data:`scout_pin.specification.JOINT_NAMES`.
        signs: −1 where the specification counts the angle the other way, ``(12,)``.
        torso: Placement of the torso's frame in the file's root body, shape ``(4, 4)``.
        notes: What was chosen, and what isn't exactly of the kind, a sentence each.
    """

    specification: Specification
    joints: tuple[str, ...]
    signs: np.ndarray
    torso: Matrix
    notes: tuple[str, ...]


def from_urdf(
    path: str | Path,
    *,
    left: str | None = None,
    sole: Sequence[float] | None = None,
    servo: Sequence[float] | None = None,
    friction: float = 0.6,
) -> Translation:
    """Read a URDF (or MJCF, SDF) of the kind into a specification.

    Only axes and bodies count: frames may stand anywhere on their axes, turned at will, axes
    may point either way, and what is fixed to a body is merged into it.

    Args:
        path: The file, or ``example:NAME``.
        left: A joint of the left leg; None finds it by the joints' names.
        sole: Half width to the left and right, length to heel and toes, height of the ankle
            above the sole [m]; None takes the feet's shapes.
        servo: Stall torque [N·m] and no-load speed [rad/s] of joints without limits.
        friction: Coefficient between sole and floor, which no URDF has.

    Raises:
        ModelError: It is no biped of the kind; says which joint, and by how much.
        BadInput: It can't be read.
    """
    description = read(path)
    chains = find_chains(description, left)
    where = description.where
    torso = torso_frame(chains, where)
    robot = LoadedRobot(description, {}, where=where)
    notes, joints, signs = list(description.warnings), [], []
    data: dict[str, Any] = {"legs": {}}
    servos: dict[tuple[float, float, float], str] = {}
    ranges: list[tuple[float, float]] = []
    for side in SIDES:
        leg = chains.legs[side]
        axes = leg_axes(leg, torso, where)
        ankle = torso[:3, :3] @ axes.p5 + torso[:3, 3]
        foot = find_sole(robot, leg[5], torso, ankle, sole)
        entry, frames, turned = leg_entry(axes, foot, torso)
        entry["servo"] = tuple(servo_of(turn, description, servo, servos) for turn in leg)
        entry["links"] = tuple(
            _body(turn.body, turn.frame, torso @ frame)
            for turn, frame in zip(leg, frames, strict=True)
        )
        data["legs"][side] = entry
        joints += [turn.joint.name for turn in leg]
        signs += turned
        ranges += [turn_range(turn, sign) for turn, sign in zip(leg, turned, strict=True)]
        notes += _said(side, axes, foot, sole)
    losses, said = friction_of(description, joints)
    data |= {
        "format": 1,
        "name": _name(description.name),
        "source": f"read from {Path(where).name}",
        "inertia_convention": "tensor_about_com",
        "servos": {
            name: {
                "stall_torque": torque,
                "no_load_speed": speed,
                "rotor_inertia": rotor,
                "size": size_of(torque, speed),
            }
            for (torque, speed, rotor), name in servos.items()
        },
        "torso": _body(chains.root, np.eye(4), torso),
        "assumptions": {
            "joint_range": {
                "why": "the file's limits; joints without any turn once round",
                "lower_deg": one_or_all([low for low, _ in ranges]),
                "upper_deg": one_or_all([high for _, high in ranges]),
            },
            "floor_friction": {
                "why": "no such file says it; check it for your soles and floor",
                "coefficient": friction,
            },
            "joint_friction": losses,
        },
    }
    if not np.allclose(torso, np.eye(4), rtol=0.0, atol=TINY):
        place = ", ".join(f"{1e3 * x:z.6g}" for x in torso[:3, 3])
        turn = np.degrees(np.arctan2(torso[1, 0], torso[0, 0]))
        notes.append(
            f"The torso's frame is at ({place}) mm of the file's root body, x to the right, y "
            f"forward, z up (turned by {turn:z.4g}° about z if z is up in the file)."
        )
    counted = [name for name, sign in zip(joints, signs, strict=True) if sign < 0]
    if counted:
        notes.append(f"Angles of {', '.join(counted)} count the other way than in the file.")
    specification = validate("specification", Specification, data, where=where)
    if tilts(specification):
        specification = specification.model_copy(update={"neutral_soles": "tilted"})
        notes.append("At zero angles the soles aren't level, so neutral_soles says tilted.")
    if said:
        notes.append(said)
    return Translation(specification, tuple(joints), np.array(signs), torso, tuple(notes))


def _body(body: MovingBody, frame: Matrix, mine: Matrix) -> dict[str, Any]:
    """A body in another frame: ``frame`` is its joint's, ``mine`` the link's, in the root body."""
    if not body.mass > 0.0:
        name = body.joint or "the torso"
        raise ModelError(f"{shown(name)} moves no mass", allowed="a mass for each of 13 bodies")
    com = body.moment / body.mass
    tensor = body.tensor - parallel_axis(body.mass, com)
    turn = mine[:3, :3].T @ frame[:3, :3]
    place = mine[:3, :3].T @ (frame[:3, :3] @ com + frame[:3, 3] - mine[:3, 3])
    turned = turn @ tensor @ turn.T
    turned = (turned + turned.T) / 2
    return {
        "mass": neat(float(body.mass)),
        "com": tuple(neat(x) for x in place.tolist()),
        "inertia": tuple(tuple(neat(x) for x in row) for row in turned.tolist()),
    }


def _said(side: str, axes: LegAxes, foot: Sole, given: Sequence[float] | None) -> Iterator[str]:
    if given is None:
        yield f"The {side} sole is the lowest level face of the foot's {foot.source}."
    worst = max(axes.off, key=lambda one: one[2])
    if worst[2] > TOLERANCES.reach * 1e3:
        yield (
            f"The {side} leg isn't exactly of the kind and was made so: {worst[0]}: {worst[1]} "
            f"within {worst[2]:.1g}."
        )


def _name(text: str) -> str:
    letters = "".join(x if (x.isalnum() and x.isascii()) or x in "_-" else "_" for x in text)
    return letters if letters[:1].isalpha() else f"biped_{letters}"


def text(found: Translation) -> str:
    """The specification as TOML, with what is to be known of it at its top."""
    names = zip(JOINT_NAMES, found.joints, found.signs, strict=True)
    joints = ", ".join(f"{mine} is {'−' if sign < 0 else ''}{file}" for mine, file, sign in names)
    return toml(found.specification, [*found.notes, f"Joints: {joints}."])


def document(found: Translation) -> dict[str, object]:
    """What was read, JSON-ready."""
    return {
        "schema": "scout-pin/from-urdf",
        "version": 1,
        "robot": found.specification.name,
        "joints": [
            {"name": mine, "in_file": file, "sign": int(sign)}
            for mine, file, sign in zip(JOINT_NAMES, found.joints, found.signs, strict=True)
        ],
        "torso": found.torso,
        "notes": list(found.notes),
        "implausible": implausible(found.specification),
    }
