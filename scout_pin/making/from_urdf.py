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
from scout_pin.making.chains import Turn, find_chains
from scout_pin.making.soles import Sole, find_sole
from scout_pin.making.text import toml
from scout_pin.specification import JOINT_NAMES, SIDES, Specification
from thesis_pin.errors import ModelError
from thesis_pin.model.formats.reading import read
from thesis_pin.model.loading import LoadedRobot
from thesis_pin.model.mechanism.description import Description, MovingBody
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
        entry, frames, turned = _leg(leg, axes, foot, torso)
        entry["servo"] = tuple(_servo(turn, description, servo, servos) for turn in leg)
        entry["links"] = tuple(
            _body(turn.body, turn.frame, torso @ frame)
            for turn, frame in zip(leg, frames, strict=True)
        )
        data["legs"][side] = entry
        joints += [turn.joint.name for turn in leg]
        signs += turned
        ranges += [_range(turn, sign) for turn, sign in zip(leg, turned, strict=True)]
        notes += _said(side, axes, foot, sole)
    losses, said = _friction(description, joints)
    data |= {
        "format": 1,
        "name": _name(description.name),
        "source": f"read from {Path(where).name}",
        "inertia_convention": "tensor_about_com",
        "servos": {
            name: {"stall_torque": torque, "no_load_speed": speed, "rotor_inertia": rotor}
            for (torque, speed, rotor), name in servos.items()
        },
        "torso": _body(chains.root, np.eye(4), torso),
        "assumptions": {
            "joint_range": {
                "why": "the file's limits; joints without any turn once round",
                "lower_deg": tuple(low for low, _ in ranges),
                "upper_deg": tuple(high for _, high in ranges),
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


def _leg(
    leg: Sequence[Turn], axes: LegAxes, foot: Sole, torso: Matrix
) -> tuple[dict[str, Any], list[Matrix], list[int]]:
    """Keys of a leg, the frames of its links in the torso's, and its angles' signs."""
    e, i3, j3, a, signs = axes.e, axes.i3, axes.j3, axes.a, list(axes.signs)
    turn = torso[:3, :3].T @ foot.frame[:3, :3]
    origin = torso[:3, :3].T @ (foot.frame[:3, 3] - torso[:3, 3])
    if (origin - axes.p5) @ a < -TINY:
        a, signs[5] = -a, -1
    toes, up = turn[:, 1], turn[:, 2]
    across = toes - (toes @ a) * a
    if np.linalg.norm(across) > TOLERANCES.kind_angle:
        # The sole's y lies in the plane of a and j11, so its origin has to.
        k = np.cross(a, across / np.linalg.norm(across))
        shift = -((origin - axes.p5) @ k) / (turn[:, 0] @ k)
        origin = origin + shift * turn[:, 0]
        j = across / np.linalg.norm(across)
    else:
        shift, j = 0.0, -up + (up @ a) * a
        j = j / np.linalg.norm(j)
    along = float((origin - axes.p5) @ a)
    p6 = axes.p5 + along * a
    if (reach := float(np.linalg.norm(origin - p6))) > TINY:
        j = (origin - p6) / reach
    k = np.cross(a, j)

    def angle(vector: Matrix) -> float:
        return float(np.arctan2(vector @ j3, vector @ i3))

    c1, s1 = float(j3[1]), float(-j3[0])
    size = np.hypot(c1, s1)
    r2, r3, r4 = axes.p3 - axes.p2, axes.p4 - axes.p3, axes.p5 - axes.p4
    gammas = [
        float(np.arctan2(s1, c1)),
        float(np.arctan2((e[0] * c1 + e[1] * s1) / size, e[2])),
        angle(r3),
        angle(r4) - angle(r3),
        angle(a) - angle(r4),
        float(np.arctan2(j @ e, j @ np.cross(e, a))),
    ]
    beta_7 = float(np.arctan2(-(toes @ a), toes @ j))
    flat = np.cos(beta_7) * a + np.sin(beta_7) * j
    beta_8 = float(np.arctan2(up @ flat, up @ k))
    c, s = np.cos(gammas[0]), np.sin(gammas[0])
    frames = [
        _frame((np.array([c, s, 0.0]), np.array([-s, c, 0.0])), np.array([axes.p2[0], 0.0, 0.0])),
        _frame((i3, j3), axes.p2),
        _frame((r3, np.cross(e, r3)), axes.p3),
        _frame((r4, np.cross(e, r4)), axes.p4),
        _frame((a, np.cross(e, a)), axes.p5),
        _frame((a, j), p6),
    ]
    entry = {
        "x_0": abs(float(axes.p2[0])),
        "z_1": max(0.0, -float(axes.p2[2])),
        "x_2": abs(float(r2 @ i3)),
        "x_3": float(np.linalg.norm(r3)),
        "x_4": float(np.linalg.norm(r4)),
        "x_5": max(0.0, along),
        "y_6": reach,
        "beta_deg": tuple(_plain(gamma) for gamma in gammas),
        "beta_7_deg": _plain(beta_7),
        "beta_8_deg": _plain(beta_8),
        "sole": tuple((x - shift, y) for x, y in foot.outline),
    }
    return entry, frames, signs


def _frame(axes: tuple[Matrix, Matrix], place: Matrix) -> Matrix:
    x, y = (axis / np.linalg.norm(axis) for axis in axes)
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = np.column_stack([x, y, np.cross(x, y)]), place
    return found


def _plain(angle: float) -> float:
    """Degrees in [0, 360), without the rounding of a whole number of them."""
    degrees = float(np.degrees(angle)) % 360.0
    near = round(degrees, 9)
    return near % 360.0 if abs(degrees - near) < 1e-12 * 360.0 else degrees


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
        "mass": float(body.mass),
        "com": tuple(place.tolist()),
        "inertia": tuple(tuple(row) for row in turned.tolist()),
    }


def _range(turn: Turn, sign: int) -> tuple[float, float]:
    """Lower and upper limit [deg]."""
    limit = turn.joint.limit
    if turn.joint.kind == "continuous" or limit is None:
        return -180.0, 180.0
    low, high = sorted((sign * limit[0], sign * limit[1]))
    return float(np.degrees(low)), float(np.degrees(high))


def _servo(
    turn: Turn,
    description: Description,
    given: Sequence[float] | None,
    servos: dict[tuple[float, float, float], str],
) -> str:
    """Name of the servo with a joint's limits and rotor; a new one if there is none yet."""
    limit = turn.joint.limit
    torque, speed = (limit[2], limit[3]) if limit is not None else (0.0, 0.0)
    usable = all(0.0 < value < 1e6 for value in (torque, speed))
    if not usable and given is None:
        raise ModelError(
            f"joint {shown(turn.joint.name)} has effort {torque:g} N·m and velocity "
            f"{speed:g} rad/s",
            where=f"{description.where}:{turn.joint.line}",
            allowed="both positive",
            remedy="Write the servo's into its <limit>, or say --servo TORQUE SPEED",
        )
    if not usable and given is not None:
        torque, speed = given
    rotor = float(description.supplement.armature.get(turn.joint.name, 0.0))
    return servos.setdefault((float(torque), float(speed), rotor), f"servo_{len(servos) + 1}")


def _friction(description: Description, joints: Sequence[str]) -> tuple[dict[str, Any], str]:
    """Friction of all joints, and what to say if it is one number for several."""
    beside = description.supplement
    viscous = [description.joints[j].damping + beside.damping.get(j, 0.0) for j in joints]
    coulomb = [description.joints[j].friction + beside.friction.get(j, 0.0) for j in joints]
    said = ""
    if len(set(viscous)) > 1 or len(set(coulomb)) > 1:
        said = "The joints' friction differs and the specification has one: the largest is taken."
    why = "the file's, the largest of all joints" if said else "the file's"
    return {"why": why, "viscous": max(viscous), "coulomb": max(coulomb)}, said


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
