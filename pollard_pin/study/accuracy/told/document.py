"""An accuracy study as data: JSON-ready, and as tables of poses and of tolerances."""

from __future__ import annotations

import numpy as np

from pollard_pin.coordinates import POSE_NAMES
from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.study.accuracy.result import AccuracyNumbers, Contribution
from pollard_pin.study.accuracy.told.verdict import LEVEL, doubts, sentences
from thesis_pin.numeric.arrays import median
from thesis_pin.report.writers import csv_bytes
from thesis_pin.tolerances import TOLERANCES
from thesis_pin.version import __version__

SCHEMA = "pollard-pin/accuracy"
VERSION = 1


def document(study: AccuracyNumbers) -> dict[str, object]:
    """The study as JSON-ready data; see docs/accuracy.md."""
    stack, draws = study.stack, study.draws
    found: dict[str, object] = {
        "schema": SCHEMA,
        "version": VERSION,
        "parameters": _asked(study),
        "tolerances": [_tolerance(one) for one in study.contributions],
        "summary": _summary(study),
    }
    if study.time is not None:
        found["time"] = study.time
    found |= {
        "pose": study.pose,
        "worst": stack.worst,
        "exact": _known(stack.exact),
        "components": stack.components,
        "root": stack.root,
        "deviation": stack.deviation,
        "worst_turn": stack.worst_turn,
        "root_turn": stack.root_turn,
        "bent": _known(stack.bent),
        "give": _known(stack.give),
        "drawn_deviation": None if draws is None else _known(draws.deviation),
        "drawn": None
        if draws is None
        else {"farthest": _known(draws.farthest), "turned": _known(draws.turned)},
    }
    return found


def columns(study: AccuracyNumbers) -> dict[str, np.ndarray]:
    """The poses as columns of a table: name with unit → values; what isn't there is empty."""
    stack = study.stack
    found: dict[str, np.ndarray] = {} if study.time is None else {"time_s": study.time}
    units = ("m", "m", "m", "rad", "rad", "rad")
    for k, (name, unit) in enumerate(zip(POSE_NAMES, units, strict=True)):
        found[f"{name}_{unit}"] = study.pose[:, k]
    found["worst_m"], found["worst_exact_m"] = stack.worst, _finite(stack.exact)
    for k, axis in enumerate("xyz"):
        found[f"worst_{axis}_m"] = stack.components[:, k]
    found |= {
        "root_sum_square_m": stack.root,
        "deviation_m": stack.deviation,
        "worst_turn_rad": stack.worst_turn,
        "root_sum_square_turn_rad": stack.root_turn,
        "nonlinear_share": _finite(stack.bent),
    }
    for kind, numbers in stack.kinds.items():
        found[f"worst_{kind}_m"] = numbers[0]
    if study.draws is not None:
        found["drawn_deviation_m"] = study.draws.deviation
    if study.stiffness is not None:
        found["give_m_N"] = stack.give
    return found


def sensitivities_csv(study: AccuracyNumbers) -> bytes:
    """Every tolerance in a row: what it is, what it does."""
    every = study.contributions
    radian = [1.0 if one.parameter.unit == "mm" else np.radians(1.0) * 1e3 for one in every]
    return csv_bytes(
        {
            "parameter": [one.parameter.name for one in every],
            "kind": [one.parameter.kind for one in every],
            "unit": [one.parameter.unit for one in every],
            "tolerance": np.array([one.tolerance.written for one in every]),
            "distribution": [one.tolerance.distribution for one in every],
            "mm_per_unit": np.array(
                [one.slope * size for one, size in zip(every, radian, strict=True)]
            ),
            "mm_per_unit_mean": np.array(
                [one.mean * size for one, size in zip(every, radian, strict=True)]
            ),
            "mm": np.array([one.reach * 1e3 for one in every]),
            "deg": np.degrees([one.turn for one in every]),
            "share_of_variance": np.array([one.share for one in every]),
        }
    )


def _tolerance(one: Contribution) -> dict[str, object]:
    parameter = one.parameter
    return {
        "name": parameter.name,
        "kind": parameter.kind,
        "what": parameter.words,
        "unit": parameter.unit,
        "tolerance": one.tolerance.written,
        "distribution": one.tolerance.distribution,
        "slope": one.slope,
        "mean_slope": one.mean,
        "distance": one.reach,
        "turn": one.turn,
        "share_of_variance": one.share,
    }


def _asked(study: AccuracyNumbers) -> dict[str, object]:
    path = {} if study.path is None else study.path.parameters
    grid: dict[str, dict[str, float]] | None = None
    if study.space is not None:
        grid = {
            name: {"from": float(axis[0]), "to": float(axis[-1]), "points": len(axis)}
            for name, axis in zip("xyz", study.space.axes, strict=True)
        }
    return {
        "robot": study.robot.specification.name,
        **path,
        "grid": grid,
        "orientation": None if study.space is None else study.space.orientation,
        "branch": str(study.branch),
        "branch_choice": "the default" if study.branch == DEFAULT_BRANCH else "asked for",
        "samples": len(study.pose),
        "of_all_poses": "largest" if study.space is None else "median",
        "tolerances": study.allowed.source,
        "draws": 0 if study.draws is None else study.draws.count,
        "seed": None if study.draws is None else study.draws.seed,
        "within": study.limit,
        "stiffness": study.stiffness,
        "nonlinear_above": TOLERANCES.linear,
        "thesis_pin": __version__,
    }


def _summary(study: AccuracyNumbers) -> dict[str, object]:
    stack, k = study.stack, study.worst
    found: dict[str, object] = {
        "within_limits": None if study.limit is None else study.within_limits,
        "verdict": sentences(study),
        "doubts": doubts(study),
        "notes": [*study.allowed.notes, *([] if study.path is None else study.path.notes)],
        "worst": {
            "largest": _number(stack.farthest[k]),
            "linear": float(stack.worst[k]),
            "mean": _number(stack.farthest.mean()),
            "median": _number(float(median(stack.farthest))),
            "position": study.pose[k, :3],
            "time": None if study.time is None else float(study.time[k]),
        },
        "root": {
            "largest": float(stack.root.max()),
            "mean": float(stack.root.mean()),
            "median": float(median(stack.root)),
        },
        "worst_turn": float(stack.worst_turn.max()),
        "root_turn": float(stack.root_turn.max()),
        "kinds": {
            kind: dict(zip(("worst", "root", "worst_turn", "root_turn"), most, strict=True))
            for kind, most in (
                (kind, study.typical(x.T).tolist()) for kind, x in stack.kinds.items()
            )
        },
        "nonlinear": {
            "largest": _number(stack.bent.max()),
            "samples": int(study.bent.sum()),
            "share": float(study.bent.mean()),
        },
        "share_within": None
        if study.limit is None
        else float((stack.farthest <= study.limit).mean()),
    }
    draws, within = study.draws, study.within
    if draws is not None:
        whole = draws.farthest[draws.assembled]
        found["drawn"] = {
            "robots": draws.count,
            "not_assembled": int((~draws.assembled).sum()),
            "not_assembled_share": float(np.isnan(draws.distance).mean()),
            "level": LEVEL,
            "farthest_at_level": float(np.quantile(whole, LEVEL)) if whole.size else None,
            "farthest": float(whole.max()) if whole.size else None,
            "share_within": None
            if study.limit is None
            else float((draws.farthest <= study.limit).mean()),
        }
    if within is not None:
        found["keeping"] = {
            "limit": within.limit,
            "factor": _number(within.factor),
            "factor_root": _number(within.factor_root),
            "equal": [
                vars(one) | {"worst": _number(one.worst), "root": _number(one.root)}
                for one in within.equal
            ],
        }
    if study.stiffness is not None:
        found["give"] = {"least": float(stack.give.min()), "largest": float(stack.give.max())}
    return found


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _known(values: np.ndarray) -> np.ndarray | list[float | None]:
    """Numbers, with null for those that there aren't."""
    return values if np.isfinite(values).all() else [_number(one) for one in values.tolist()]


def _finite(values: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(values), values, np.nan)
