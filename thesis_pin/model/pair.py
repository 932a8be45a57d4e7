"""Description → URDF and closure file, which read back to the same robot."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import isinf
from pathlib import Path

import yaml

from thesis_pin.files import write_files
from thesis_pin.model.formats.yaml_text import EXPONENTIAL
from thesis_pin.model.mechanism.closure_types import word_of
from thesis_pin.model.mechanism.description import Description
from thesis_pin.model.mechanism.supplement import Motor, Supplement
from thesis_pin.model.meshes import with_absolute_meshes


def pair(description: Description) -> dict[str, str]:
    """The two files of a robot, by name.

    The URDF is the file's own text where it was one and nothing had to be cut; relative names
    of meshes become absolute. All else is in the closure file, in the community's schema where
    it has words for it and under our one key ``thesis_pin`` where not.

    Args:
        description: From any format.

    Returns:
        ``NAME.urdf`` and ``NAME.closures.yaml``.
    """
    name = re.sub(r"[^\w.-]+", "_", description.name) or "robot"
    return {
        f"{name}.urdf": with_absolute_meshes(description),
        f"{name}.closures.yaml": closure_text(description.supplement, description.name),
    }


def write(description: Description, folder: str | Path) -> list[Path]:
    """Write the :func:`pair` of a robot into a folder.

    Raises:
        CannotWrite: It can't be written there.
    """
    return write_files(pair(description), folder)


def closure_text(beside: Supplement, robot: str = "") -> str:
    """A closure file, in YAML.

    Args:
        beside: What it says.
        robot: Name of the robot.
    """
    content: dict[str, object] = {
        "closed_loop": [list(one.frames) for one in beside.closures],
        "type": [word_of(one.rows) for one in beside.closures],
        "name_mot": [motor.joint for motor in beside.motors],
    }
    if beside.joint_types:
        content["joint_name"] = list(beside.joint_types)
        content["joint_type"] = list(beside.joint_types.values())
    content["thesis_pin"] = {"format": 1, "robot": robot} | {
        key: value for key, value in _extra(beside).items() if value
    }
    text: str = yaml.dump(
        content,
        Dumper=_Plain,
        default_flow_style=None,
        sort_keys=False,
        allow_unicode=True,
        width=100,
    )
    return text


class _Plain(yaml.SafeDumper):
    """Writes a value out wherever it stands, and quotes words that are read as numbers."""

    def ignore_aliases(self, data: object) -> bool:
        return True


_Plain.add_implicit_resolver("tag:yaml.org,2002:float", *EXPONENTIAL)


def _extra(beside: Supplement) -> dict[str, object]:
    rods = [one.length for one in beside.closures]
    return {
        "names": [one.name for one in beside.closures],
        "lengths": rods if any(length is not None for length in rods) else [],
        "couplings": [
            {
                "name": one.name,
                "coefficients": _numbers(one.coefficients),
                "constant": float(one.constant),
            }
            for one in beside.couplings
        ],
        "motors": [
            _motor(motor) for motor in beside.motors if motor != Motor(motor.joint, motor.joint)
        ],
        "springs": [
            {"joint": one.joint, "stiffness": float(one.stiffness), "rest": float(one.rest)}
            for one in beside.springs
        ],
        "armature": _numbers(beside.armature),
        "damping": _numbers(beside.damping),
        "friction": _numbers(beside.friction),
        "poses": {
            name: {joint: [float(x) for x in values] for joint, values in pose.items()}
            for name, pose in beside.poses.items()
        },
        "root": "free" if beside.free_root else "",
        "gravity": [] if beside.gravity == Supplement().gravity else [*map(float, beside.gravity)],
    }


def _motor(motor: Motor) -> dict[str, object]:
    found: dict[str, object] = {"joint": motor.joint, "name": motor.name}
    found |= {"gear": float(motor.gear), "armature": float(motor.armature)}
    if not all(map(isinf, motor.effort)):
        found["effort"] = [None if isinf(limit) else float(limit) for limit in motor.effort]
    if not isinf(motor.speed):
        found["speed"] = float(motor.speed)
    return found


def _numbers(values: Mapping[str, float]) -> dict[str, float]:
    return {name: float(value) for name, value in values.items()}
