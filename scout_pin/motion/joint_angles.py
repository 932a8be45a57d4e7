"""Tables of joint angles → poses of torso and soles; what was made of them is said.

Where the torso is known too it is used, and the soles are checked against the floor.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scout_pin.coordinates import POSE_NAMES
from scout_pin.model import Scout
from scout_pin.motion.reconstruction import Reconstruction, checked, reconstruct
from scout_pin.motion.standing import level_within, standing_by_soles, standing_on_floor
from scout_pin.specification import JOINT_NAMES, SIDES
from thesis_pin.errors import TrajectoryError
from thesis_pin.numeric.rotations import euler_placement, transform
from thesis_pin.tables.table import Column, Table
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]

_NAMES = {(True, False): "left", (False, True): "right", (True, True): "double"}
_STEPS = 1.5
"""Steps of the angles' resolution by which a whole leg may be off: measured, soles of rounded
angles stray by 0.4 steps times the leg's length."""


@dataclass(frozen=True, eq=False)
class Placed:
    """What a table of joint angles means.

    Attributes:
        poses: Columns of torso and soles, by name.
        support: Who stands at each sample.
        notes: What was chosen, and how well the soles stand.
    """

    poses: Mapping[str, Column]
    support: tuple[str, ...]
    notes: tuple[str, ...]


def placed(
    robot: Scout,
    table: Table,
    angles: Sequence[Column],
    given: Mapping[str, Column],
    support: Sequence[str],
) -> Placed:
    """Poses of torso and soles from joint angles.

    Args:
        robot: The biped.
        table: Where the samples come from, for messages.
        angles: Columns of the twelve joints.
        given: Columns of poses beside them, by name; the torso's only.
        support: Who stands at each sample; empty where the table doesn't say.

    Raises:
        TrajectoryError: A joint leaves its range, the table says where a foot is, nobody can tell
            which foot stands, or the standing soles miss their places by far.
    """
    if feet := [name for name in given if not name.startswith("torso")]:
        raise TrajectoryError(
            f"column {feet[0]!r} stands beside joint angles, which say where the soles are",
            where=table.file,
            remedy="Leave it out; the torso's columns may stay",
        )
    theta = np.column_stack([column.values for column in angles])
    _refuse_range(robot, table, angles)
    soles = {
        side: robot.leg_forward_kinematics(side, theta[:, 6 * k : 6 * k + 6])
        for k, side in enumerate(SIDES)
    }
    reach = max(float(np.linalg.norm(sole[:, :3, 3], axis=1).max()) for sole in soles.values())
    step = max(column.quantum for column in angles)
    left, right = (np.array(robot.specification.leg(side).sole) for side in SIDES)
    slack = _STEPS * step * reach
    torso = _torso(given, len(table)) if given else None
    if support:
        standing = np.array([(name != "right", name != "left") for name in support])
    elif torso is None:
        standing = standing_by_soles(table, soles, (left, right), slack)
    else:
        standing = standing_on_floor(torso, soles, (left, right), slack)
    if not standing.any(axis=1).all():
        row = int(np.argmin(standing.any(axis=1)))
        raise TrajectoryError("no sole is on the floor", where=table.where(row))
    found = reconstruct(soles, standing) if torso is None else checked(torso, soles, standing)
    _refuse_gap(table, found)
    names = tuple(_NAMES[bool(left), bool(right)] for left, right in standing)
    lengths = (step * reach, _STEPS * step)
    poses = {
        f"{body}_{coordinate}": Column(
            f"{body}_{coordinate}", values[:, k].copy(), lengths[k > 2], "joint angles"
        )
        for body, values in found.poses.items()
        for k, coordinate in enumerate(POSE_NAMES)
    }
    told = () if support else names
    return Placed(poses, names, tuple(_notes(table, found, told, level_within(slack))))


def _torso(given: Mapping[str, Column], count: int) -> Array:
    """The torso in the world, ``(n, 4, 4)``."""
    zero = np.zeros(count)
    columns = (given.get(f"torso_{name}") for name in POSE_NAMES)
    values = np.stack([zero if one is None else one.values for one in columns])
    still = np.zeros((count, 3))
    turned = euler_placement("xyz", values[3:].T, still, still)[0]
    return transform(turned, values[:3].T)


def _refuse_range(robot: Scout, table: Table, angles: Sequence[Column]) -> None:
    """Inverse kinematics would take an angle beyond its range for one a turn away."""
    for k, (name, column) in enumerate(zip(JOINT_NAMES, angles, strict=True)):
        low, high = robot.lower[k], robot.upper[k]
        over = np.maximum(low - column.values, column.values - high)
        if (over > TOLERANCES.joint_limit + column.quantum).any():
            row = int(np.argmax(over))
            value = float(column.values[row])
            plain = column.unit.size == 1.0 and abs(value) > np.pi
            raise TrajectoryError(
                f"{name} is {value:.6g} rad",
                where=table.where(row),
                allowed=f"{low:.4g} to {high:.4g} rad",
                remedy=f"If these are degrees, call the column {name}_deg" if plain else "",
            )


def _refuse_gap(table: Table, found: Reconstruction) -> None:
    limits = TOLERANCES.sole_misfit, TOLERANCES.sole_misfit_tilt
    if found.gap > limits[0] or found.tilt > limits[1]:
        raise TrajectoryError(
            f"a standing sole misses its place by {found.gap * 1e3:.3g} mm and up to "
            f"{np.degrees(found.tilt):.3g}°",
            where=table.where(found.row),
            allowed=f"{limits[0] * 1e3:g} mm, {np.degrees(limits[1]):.3g}°",
            remedy="Is it this robot, are the units right, and does support say who stands?",
        )


def _notes(table: Table, found: Reconstruction, told: Sequence[str], height: float) -> list[str]:
    notes = [
        "the table holds joint angles; standing soles miss their places by at most "
        f"{found.gap * 1e3:.2g} mm and {np.degrees(found.tilt):.2g}° (worst at "
        f"{table.where(found.row)})"
    ]
    if told:
        order = [name for name, _ in itertools.groupby(told)]
        shown = ", ".join(order[:9]) + (f" … {len(order)} phases" if len(order) > 9 else "")
        notes.append(
            "no column says which foot stands; the soles' heights do, to "
            f"{height * 1e3:.2g} mm: {shown}"
        )
    return notes
