"""A path's answer: yes or no, and in plain sentences."""

from __future__ import annotations

import numpy as np

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH
from pollard_pin.report.numbers import TrajectoryNumbers
from pollard_pin.specification import ACTUATOR_SYMBOLS, JOINT_NAMES, JOINT_SYMBOLS
from thesis_pin.numeric.arrays import wrap
from thesis_pin.tolerances import TOLERANCES

_NEAR = (
    "nearly touches a singularity",
    "comes near a singularity",
    "stays far from singularities",
)


def within_limits(numbers: TrajectoryNumbers) -> bool:
    """Whether no motor exceeds its limits; what can't be followed raises before."""
    return numbers.motor_use.within


def sentences(numbers: TrajectoryNumbers, *, motors: bool = True) -> list[str]:
    """The verdict, most important first: reach, singularities, motors, energy.

    Args:
        numbers: What it is about.
        motors: Whether to say if the motors can do it.
    """
    return [
        *_reach(numbers),
        *(_motors(numbers) if motors else ()),
        *_balance(numbers),
        *_turns(numbers),
    ]


def _reach(numbers: TrajectoryNumbers) -> list[str]:
    name = numbers.robot.specification.name.capitalize()
    margin, condition = numbers.solutions.margin, numbers.holding.condition
    k, default = int(np.argmin(margin)), numbers.branch == DEFAULT_BRANCH
    return [
        f"{name} can follow this path on branch {numbers.branch}{' (the default)' * default}: "
        "every pose is reached inside the joint limits, and no singularity is crossed.",
        f"The path {_NEAR[int(numbers.distance_class.min())]}: reach margin at least "
        f"{margin[k]:z.3f} (t = {numbers.joints.time[k]:.3g} s), condition "
        f"number {condition.min():.1f} to {condition.max():.1f}.",
    ]


def _turns(numbers: TrajectoryNumbers) -> list[str]:
    """Joints that start outside (−180°, 180°]: the turn that was taken for the user."""
    start, told = numbers.joints.part(np.array([0])).q[0], []
    for k in np.flatnonzero(np.abs(start) > np.pi + TOLERANCES.joint_limit):
        low, high = np.degrees([numbers.robot.lower[k], numbers.robot.upper[k]])
        told.append(
            f"{JOINT_NAMES[k]} ({JOINT_SYMBOLS[k]}) starts at {np.degrees(start[k]):.2f}°, whole "
            f"turns from {np.degrees(wrap(start[k])):.2f}°: so the motion fits {low:g}° to "
            f"{high:g}°."
        )
    return told


def _motors(numbers: TrajectoryNumbers) -> list[str]:
    """The most loaded motors, or everything that is exceeded."""
    use, broken = numbers.motor_use, []
    for shares, times, limits, unit in (
        (use.torque, use.torque_time, use.effort, "N·m"),
        (use.speed, use.speed_time, use.velocity, "rad/s"),
    ):
        for k in np.flatnonzero(shares > 1.0):
            broken.append(
                f"{ACTUATOR_SYMBOLS[k]} needs {shares[k]:.0%} of its {limits[k]:g} {unit} "
                f"(t = {times[k]:.3f} s)"
            )
    if broken:
        return [f"The motors can't do this: {'; '.join(broken)}."]
    torque, speed = int(use.torque.argmax()), int(use.speed.argmax())
    return [
        f"Motors within their limits: the most loaded is {ACTUATOR_SYMBOLS[torque]} with "
        f"{use.torque[torque]:.0%} of {use.effort[torque]:g} N·m, the fastest "
        f"{ACTUATOR_SYMBOLS[speed]} with {use.speed[speed]:.0%} of {use.velocity[speed]:g} rad/s."
    ]


def _balance(numbers: TrajectoryNumbers) -> list[str]:
    if numbers.three is not None:
        return [
            f"Three motors leave up to {numbers.three.share.max():.2%} of the generalized force "
            "unexplained: (3.154) inverts a 3×6 matrix, and these torques are its least-squares "
            "solution. Their work can't balance the energy."
        ]
    return [
        f"The motors' work balances the change of energy to {numbers.relative_energy_error:.1e} of "
        f"the {numbers.work_exchanged:.3f} J exchanged."
    ]
