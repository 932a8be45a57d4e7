"""ROS's ``trajectory_msgs/msg/JointTrajectory`` in YAML, as ``ros2 topic pub`` takes it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thesis_pin.report.writers import number_rows

Array = NDArray[np.float64]

LEAST_STEP = 1e-6
"""Points nearer than this [s] are one: a controller divides by the time between them."""

_NANO = 1_000_000_000
_WHOLE = re.compile(rb"e(?<![\d.]\de)")  # after a single digit
_UNSIGNED = re.compile(rb"e(?=\d)")


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
    kept = apart(states.time)
    lines = [
        b"header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}",
        f"joint_names: [{', '.join(map(_quoted, states.names))}]".encode(),
        b"points:",
    ]
    columns = (
        _vectors("positions", states.position[kept]),
        _vectors("velocities", states.rate[kept]),
        _vectors("accelerations", states.acceleration[kept]),
        _vectors("effort", states.effort[kept]),
    )
    for time, *vectors in zip(states.time[kept].tolist(), *columns, strict=True):
        sec, nanosec = divmod(round((time - states.time[0]) * _NANO), _NANO)
        lines.append(f"- time_from_start: {{sec: {sec}, nanosec: {nanosec}}}".encode())
        lines += vectors
    return b"\n".join(lines) + b"\n"


def apart(time: Array) -> list[int]:
    """Samples that lie at least :data:`LEAST_STEP` after the one kept before; the last stays."""
    kept = [0]
    for k in range(1, len(time)):
        if time[k] - time[kept[-1]] >= LEAST_STEP:
            kept.append(k)
    if kept[-1] != len(time) - 1 and len(kept) > 1:
        kept[-1] = len(time) - 1
    return kept


def _vectors(word: str, values: Array) -> list[bytes]:
    """A line for each sample: values ``(n, k)`` → n lines."""
    start = f"  {word}: [".encode()
    return [start + _spelled(row).replace(b",", b", ") + b"]" for row in number_rows(values)]


def _spelled(numbers: bytes) -> bytes:
    """Numbers that YAML 1.1 takes for some: 1e-05 is a text there, 1.0e-05 isn't, nor 1.0e+16."""
    if b"e" not in numbers:
        return numbers
    return _UNSIGNED.sub(b"e+", _WHOLE.sub(b".0e", numbers))


def _quoted(name: str) -> str:
    plain = re.fullmatch(r"[A-Za-z_]\w*", name) and name.lower() not in _WORDS
    return name if plain else "'" + name.replace("'", "''") + "'"


_WORDS = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"}
"""What YAML 1.1 takes for something else than a text."""
