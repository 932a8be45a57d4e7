"""PlacementNumbers as JSON, and as a table of all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pollard_pin.kinematics.singularity import LENGTH
from pollard_pin.report.document import TrajectoryReport
from pollard_pin.specification import ACTUATOR_NAMES
from pollard_pin.study.placement.judged import FOLLOWED, REASONS
from pollard_pin.study.placement.result import Found, PlacementNumbers
from pollard_pin.study.placement.told.words import flags
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/placements"
VERSION = 1


def found_document(space: PlacementNumbers, found: Found) -> dict[str, object]:
    """One placement, JSON-ready; null for what isn't known."""
    effort, velocity = space.robot.specification.assumptions.joint_limits.of_motors()
    return {
        "position": list(found.placement.position),
        "turn": found.placement.turn,
        "mirrored": found.placement.mirrored,
        "branch": str(found.branch),
        "refined": found.refined,
        "arms_cross": bool(found.judged.crossed[0]),
        "followed": not found.reason,
        "reason": found.reason or None,
        "peak_torque": _known(found.torque),
        "torque_share": _known(found.torque / effort),
        "peak_speed": _known(found.speed),
        "speed_share": _known(found.speed / velocity),
        "condition": _known(found.condition),
        "margin": _known(found.margin),
        "clearance": _known(found.clearance),
        "nearest_singularity": found.nearest if math.isfinite(found.clearance) else None,
        "fastest": _known(found.fastest),
        "fastest_by_law": None if found.law is None else found.law.duration,
        "flags": flags(space, found),
    }


def _known(value: float | np.ndarray) -> object:
    if isinstance(value, np.ndarray):
        return value if np.isfinite(value).all() else None
    return value if math.isfinite(value) else None


def document(space: PlacementNumbers, report: TrajectoryReport | None) -> dict[str, object]:
    """A search as JSON-ready data; the format is in docs/placing.md.

    Args:
        space: The placements.
        report: On the path at the best; None if there is none.
    """
    choices, some = space.choices, np.flatnonzero(space.judged.reason == FOLLOWED)
    placed = [choices.at(int(k)) for k in some]
    return {
        "schema": SCHEMA,
        "version": VERSION,
        "objective": space.objective,
        "actuators": list(ACTUATOR_NAMES),
        "parameters": {
            "robot": space.robot.specification.name,
            **space.path.parameters,
            "samples": space.samples,
            "middle": space.middle,
            "inertia": space.robot.inertia,
            "condition_length": LENGTH,
            "thesis_pin": __version__,
        },
        "axes": {
            "x": choices.x,
            "y": choices.y,
            "z": choices.z,
            "turn": choices.turn,
            "mirrored": list(choices.mirrored),
            "branches": [str(branch) for branch in choices.branches],
        },
        "summary": {
            "placements": choices.count,
            "followed": space.feasible,
            "failures": space.failures,
            "at_ends": space.at_ends,
        },
        "start": found_document(space, space.start),
        "best": [found_document(space, one) for one in space.best],
        "position": np.array([one.position for one, _ in placed]).reshape(-1, 3),
        "turn": np.array([one.turn for one, _ in placed]),
        "mirrored": [one.mirrored for one, _ in placed],
        "branch": [str(branch) for _, branch in placed],
        "torque_share": _share(space)[some],
        "condition": space.judged.condition[some],
        "margin": space.judged.margin[some],
        "clearance": space.judged.clearance[some],
        "report": None if report is None else report.summary(),
        "notes": list(space.path.notes),
    }


def _share(space: PlacementNumbers) -> np.ndarray:
    effort, _ = space.robot.specification.assumptions.joint_limits.of_motors()
    return np.asarray((space.judged.torque / effort).max(axis=1))


def columns(space: PlacementNumbers) -> dict[str, np.ndarray | Sequence[str]]:
    """Every placement of the grid as columns of a table; empty where nothing is known."""
    choices, judged = space.choices, space.judged
    placed = [choices.at(k) for k in range(choices.count)]
    position = np.array([one.position for one, _ in placed])
    table: dict[str, np.ndarray | Sequence[str]] = {
        **{f"{name}_m": position[:, k] for k, name in enumerate("xyz")},
        "turn_deg": np.round(np.degrees([one.turn for one, _ in placed]), 9),
        "mirrored": ["yes" if one.mirrored else "no" for one, _ in placed],
        "branch": [str(branch) for _, branch in placed],
        "outcome": [REASONS[k] for k in judged.reason],
    }
    for k, name in enumerate(ACTUATOR_NAMES):
        table[f"peak_torque_{name}_Nm"] = judged.torque[:, k]
    for k, name in enumerate(ACTUATOR_NAMES):
        table[f"peak_speed_{name}_rad_s"] = judged.speed[:, k]
    table |= {
        "torque_share": _share(space),
        "condition": judged.condition,
        "margin": judged.margin,
        "clearance": judged.clearance,
    }
    if space.objective == "time":
        held = np.where(judged.pace > 0, judged.pace, np.nan)
        table["fastest_s"] = space.path.duration / held
    return table
