"""Loading a robot in a fresh process, its packages imported, against Pinocchio's own loader."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
import pinocchio as pin
from measuring import Equal, Goal, Peer, Row, Scale
from processes import measured_child

import pollard_pin
import scout_pin

PEER = "Pinocchio's RobotWrapper from the URDF"
_OURS = """
import {name}_pin
def work():
    {name}_pin.load(){more}
"""
_THEIRS = """
import pinocchio
def work():
    pinocchio.RobotWrapper.BuildFromURDF({words})
"""


def rows(scale: Scale) -> Iterator[Row]:
    """A row a robot; Scout's with the wrench cones of its soles."""
    for name, package, more, root in (
        ("scout", scout_pin, ".contacts", "pinocchio.JointModelFreeFlyer()"),
        ("pollard", pollard_pin, "", "None"),
    ):
        words = f"{package.URDF_PATH!r}, [{package.PACKAGE_PATH!r}], {root}"
        ours, theirs = _OURS.format(name=name, more=more), _THEIRS.format(words=words)
        equal = Equal("what gravity asks for [N, N·m]", partial(_difference, package), 1e-12)
        for call, warm, rounds, goals in (
            ("first call", 0, 1, ()),
            ("later calls", 1, 1 if scale.quick else 9, (Goal(15.0, "ms"),)),
        ):
            one, other = (
                partial(measured_child, text, rounds, warm=warm) for text in (ours, theirs)
            )
            shown = f"{name}_pin.load(){more}, {call}"
            yield Row(shown, 1, one, Peer(PEER, 1, other), equal, goals)


def _difference(package: object) -> float:
    robot = package.load()
    root = pin.JointModelFreeFlyer() if package is scout_pin else None
    other = pin.RobotWrapper.BuildFromURDF(package.URDF_PATH, [package.PACKAGE_PATH], root)
    q = pin.integrate(robot.model, pin.neutral(robot.model), np.linspace(-0.5, 0.5, robot.model.nv))
    ours, theirs = (pin.computeGeneralizedGravity(one.model, one.data, q) for one in (robot, other))
    return float(np.abs(ours - theirs).max())
