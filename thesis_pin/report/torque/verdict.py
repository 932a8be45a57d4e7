"""The torque report's answer in plain sentences."""

from __future__ import annotations

import numpy as np

from thesis_pin.loops.forces.judging import DOUBTFUL
from thesis_pin.loops.joints import singles
from thesis_pin.report.torque.numbers import TorqueNumbers

UNEXPLAINED = 1e-6
"""Share of the largest load that may be left over by rounding."""


def carried(report: TorqueNumbers) -> bool:
    """Whether motors and loops carry the whole load."""
    return bool(report.unexplained.max() <= UNEXPLAINED)


def within_limits(report: TorqueNumbers) -> bool:
    """Whether motors and loops carry it all, and no motor or joint leaves its limits."""
    used = np.concatenate([report.effort_use, report.speed_use])
    return carried(report) and bool((used <= 1).all()) and not report.outside


def sentences(report: TorqueNumbers, *, motors: bool = True) -> list[str]:
    """The answer, the most important first.

    Args:
        report: What it is about.
        motors: Whether to say if the motors can do it.
    """
    return [
        *_carried(report),
        *(_efforts(report) if motors else ()),
        *_ranges(report),
        *_external(report),
        *_base(report),
        *_idle(report),
        *_shares(report),
    ]


def _carried(report: TorqueNumbers) -> list[str]:
    if carried(report):
        return []
    worst = int(report.unexplained.argmax())
    return [
        f"The motors can't hold this motion: {report.unexplained[worst]:.0%} of the largest "
        f"load is carried by nothing (t = {report.joints.time[worst]:.4g} s)."
    ]


def _efforts(report: TorqueNumbers) -> list[str]:
    said = []
    limits, torque = report.effort_limits, report.dynamics.torque
    for k, name in enumerate(report.names):
        if report.effort_use[k] > 1:
            least, most = limits[:, k]
            worst = int(np.argmax(np.maximum(torque[:, k] - most, least - torque[:, k])))
            said.append(
                f"Motor {name} needs {torque[worst, k]:.4g} {report.units[k]} at t = "
                f"{report.joints.time[worst]:.4g} s; it gives {least:.4g} to {most:.4g}."
            )
        if report.speed_use[k] > 1:
            unit = "rad/s" if report.turning[k] else "m/s"
            said.append(
                f"Motor {name} runs at {report.actuators.peak_speed[k]:.4g} {unit}; it reaches "
                f"{report.speed_limits[k]:.4g}."
            )
    unknown = [name for k, name in enumerate(report.names) if not np.isfinite(limits[:, k]).any()]
    if not said and len(unknown) < len(report.names):
        best = int(np.argmax(report.effort_use))
        said.append(
            f"No motor exceeds its limits; the closest is {report.names[best]} with "
            f"{report.effort_use[best]:.0%} of its torque."
        )
    elif not said and unknown:  # or the next sentence would stand as the answer
        said.append("No limit that is known is exceeded.")
    if unknown:
        said.append(f"No torque limit is known of {', '.join(unknown)}.")
    return said


def _ranges(report: TorqueNumbers) -> list[str]:
    kinds = singles(report.robot.model)
    return [
        f"Joint {name} leaves its range by {excess:.3g} {kinds[name].unit}."
        for name, excess in report.outside.items()
    ]


def _external(report: TorqueNumbers) -> list[str]:
    said = []
    for frame, wrench in report.external.items():
        force, moment = (", ".join(f"{x:.4g}" for x in part) for part in (wrench[:3], wrench[3:]))
        said.append(
            f"From outside ({force}) N and ({moment}) N·m act on frame {frame}, world axes."
        )
    return said


def _base(report: TorqueNumbers) -> list[str]:
    base = report.dynamics.base
    if not base.size:
        return []
    force, moment = (np.linalg.norm(part, axis=1).max() for part in (base[:, :3], base[:, 3:]))
    return [
        f"The root flies freely: the world must supply up to {force:.4g} N and {moment:.4g} N·m "
        "at it."
    ]


def _idle(report: TorqueNumbers) -> list[str]:
    loads = report.dynamics.idle_load.max(axis=0)
    return [
        f"No motor holds {', '.join(group.joints)}: taken at rest; its load is {load:.1e} of the "
        "largest."
        for group, load in zip(report.dynamics.idle, loads, strict=True)
    ]


def _shares(report: TorqueNumbers) -> list[str]:
    said = []
    if (doubt := float(report.dynamics.uncertainty.max())) > DOUBTFUL:
        digits = report.dynamics.digits
        named = f"; nearly round in it: {', '.join(digits)}" if digits else ""
        said.append(
            f"Near a singular pose the file's digits may move torques by {doubt:.0%}{named}."
        )
    if report.names and not report.dynamics.unique.all():
        said.append(
            "There are more motors than freedoms: they share the load with the least sum of "
            "squares."
        )
    if report.robot.loops and not report.dynamics.determined.all():
        said.append(
            "Some loop equations depend on others: loop forces are the smallest that fit, and "
            "those along dependent directions mean nothing."
        )
    return said
