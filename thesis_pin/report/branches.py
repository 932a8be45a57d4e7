"""Branches of inverse kinematics: their labels, and the one JSON schema of both robots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

VERSION = 2
"""Of the schema ``…/inverse-kinematics``; docs/conventions.md describes it."""


class Solutions(Protocol):
    """What both robots' solutions say of each branch; the branch is the first axis."""

    @property
    def reachable(self) -> np.ndarray: ...
    @property
    def valid(self) -> np.ndarray: ...
    @property
    def angles(self) -> np.ndarray: ...
    @property
    def position_residual(self) -> np.ndarray: ...
    @property
    def rotation_residual(self) -> np.ndarray: ...


def label(signs: Sequence[int]) -> str:
    """Signs as a label, for instance ``"-++"``."""
    return "".join("+" if sign > 0 else "-" for sign in signs)


def document(
    command: str,
    robot: str,
    *,
    joints: Sequence[str],
    coordinates: Sequence[str],
    pose: np.ndarray,
    branches: Sequence[Mapping[str, object]],
    explanation: str,
) -> dict[str, object]:
    """Inverse kinematics of one pose on several branches, JSON-ready.

    Args:
        command: The command that writes it.
        robot: Name of the specification.
        joints: Names of the angles' joints.
        coordinates: Names of the pose's six numbers.
        pose: The pose asked for [m], [rad], shape ``(6,)``.
        branches: From :func:`branch`.
        explanation: What can be said of the pose.
    """
    return {
        "schema": f"{command}/inverse-kinematics",
        "version": VERSION,
        "robot": robot,
        "joints": list(joints),
        "coordinates": list(coordinates),
        "pose": pose,
        "branches": list(branches),
        "explanation": explanation,
    }


def branch(
    solutions: Solutions, k: int, name: str, explanation: str, **own: tuple[np.ndarray, bool]
) -> dict[str, object]:
    """One branch of the document.

    Args:
        solutions: A robot's solutions of one pose, with the branch as first axis.
        k: Number of the branch.
        name: Its label.
        explanation: Why it is valid or not.
        **own: What only this robot says: its array, and whether it exists for
            branches that don't reach the pose too.
    """
    exists = bool(solutions.reachable[k])

    def said(values: np.ndarray, always: bool = False) -> np.ndarray | float | None:
        value = np.asarray(values[k])
        if not (always or exists) or not np.isfinite(value).all():
            return None
        return value if value.ndim else float(value)

    return {
        "branch": name,
        "reachable": exists,
        "valid": bool(solutions.valid[k]),
        "angles": said(solutions.angles),
        "position_residual": said(solutions.position_residual),
        "rotation_residual": said(solutions.rotation_residual),
        **{key: said(values, always) for key, (values, always) in own.items()},
        "explanation": explanation,
    }
