"""What sizing tells people: the joints, the servos, the answer."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from thesis_pin.report.tables import Part, Table
from thesis_pin.sizing.document import Sizing, shown_factor

MOST = 20
"""Actuators that are shown; documents have all."""


def summary(sizing: Sizing) -> Iterator[Part]:
    """Tables and paragraphs."""
    yield joints_table(sizing)
    yield servos_table(sizing)
    if (more := len(sizing.actuators) - MOST) > 0:
        yield f"{more} more servos are in --json and --out."
    yield ""
    yield from sizing.verdict()
    yield from (f"Warning: {one}" for one in sizing.warnings())
    yield from (f"Note: {one}" for one in sizing.notes())


def joints_table(sizing: Sizing) -> Table:
    """The load of each joint, and the smallest actuator that carries it for long."""
    loads, chosen = sizing.loads, []
    for j, one in enumerate(sizing.each):
        if one is None:
            chosen.append(("none", "", ""))
        else:
            k = sizing.actuators.index(one)
            share = f"{sizing.fits.heat[k, j]:.0%}"
            chosen.append((one.name, shown_factor(sizing.fits.factor[k, j]), share))
    peak, speed = (np.abs(values).max(axis=0) for values in (loads.torque, loads.speed))
    columns = {
        "joint": loads.joints,
        "peak N·m": [f"{value:.3f}" for value in peak],
        "RMS N·m": [f"{value:.3f}" for value in loads.rms(loads.torque)],
        "rad/s": [f"{value:.2f}" for value in speed],
        "smallest": [name for name, _, _ in chosen],
        "factor": [factor for _, factor, _ in chosen],
        "RMS": [share for _, _, share in chosen],
    }
    title = f"{loads.robot}, {loads.motion}: loads without rotors, smallest servo for long"
    return Table.of(title, columns)


def servos_table(sizing: Sizing) -> Table:
    """The actuators from the smallest on, with the joint that asks most of each."""
    order, word = sizing.order
    numbers, factors = order[:MOST], sizing.fits.factor
    carried, joints = sizing.fits.carries(sizing.factor), sizing.loads.joints
    worst = [int(factors[k].argmin()) for k in numbers]
    columns = {
        "servo": [sizing.actuators[k].name for k in numbers],
        "stall N·m": [f"{sizing.actuators[k].stall_torque:.4g}" for k in numbers],
        "rad/s": [f"{sizing.actuators[k].no_load_speed:.4g}" for k in numbers],
        "once": [f"{int(carried[k].sum())} of {len(joints)}" for k in numbers],
        "for long": [str(int(sizing.lasting[k].sum())) for k in numbers],
        "factor": [shown_factor(factors[k, j]) for k, j in zip(numbers, worst, strict=True)],
        "at": [joints[j] for j in worst],
    }
    return Table.of(f"Servos by {word}, joints that each carries", columns)
