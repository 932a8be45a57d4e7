"""ROS's ``trajectory_msgs/msg/JointTrajectory`` in YAML, as ``ros2 topic pub`` takes it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEAST_STEP = 1e-6
"""Points nearer than this [s] are one: a controller divides by the time between them."""

_NANO = 1_000_000_000


@dataclass(frozen=True, eq=False)
class JointStates:
    """What joints do over time.

    Attributes:
        names: Names of the joints, ``k`` of them.
        time: [s], ascending, shape ``(n,)``.
        position, rate, acceleration: [rad], [rad/s], [rad/s²], each ``(n, k)``.
        effort: Torques of the motors [N·m], the same.
    """

    names: Sequence[str]
    time: Array
    position: Array
    rate: Array
    acceleration: Array
    effort: Array


def joint_trajectory_yaml(states: JointStates) -> bytes:
    """The message, its times from the first sample on.

    Args:
        states: The motion; samples less than :data:`LEAST_STEP` after the one before are left
            out, which are those beside abrupt changes.
    """
    lines = [
        "header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}",
        f"joint_names: [{', '.join(map(_quoted, states.names))}]",
        "points:",
    ]
    columns = (
        ("positions", states.position),
        ("velocities", states.rate),
        ("accelerations", states.acceleration),
        ("effort", states.effort),
    )
    rows = {word: np.asarray(values + 0.0).tolist() for word, values in columns}
    for k in apart(states.time):
        sec, nanosec = divmod(round((states.time[k] - states.time[0]) * _NANO), _NANO)
        lines.append(f"- time_from_start: {{sec: {sec}, nanosec: {nanosec}}}")
        for word, values in rows.items():
            lines.append(f"  {word}: [{', '.join(map(_number, values[k]))}]")
    return ("\n".join(lines) + "\n").encode()


def apart(time: Array) -> list[int]:
    """Samples that lie at least :data:`LEAST_STEP` after the one kept before; the last stays."""
    kept = [0]
    for k in range(1, len(time)):
        if time[k] - time[kept[-1]] >= LEAST_STEP:
            kept.append(k)
    if kept[-1] != len(time) - 1 and len(kept) > 1:
        kept[-1] = len(time) - 1
    return kept


def _number(value: float) -> str:
    """A number that YAML 1.1 takes for one: 1e-05 is a text there, 1.0e-05 isn't."""
    text = repr(value)
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _quoted(name: str) -> str:
    plain = re.fullmatch(r"[A-Za-z_]\w*", name) and name.lower() not in _WORDS
    return name if plain else "'" + name.replace("'", "''") + "'"


_WORDS = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"}
"""What YAML 1.1 takes for something else than a text."""
