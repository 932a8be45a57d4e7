"""What Pollard's kinematics need of a specification, and branch labels."""

from __future__ import annotations

import itertools
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from pollard_pin.specification import Specification
from pollard_pin.urdf import anchors
from thesis_pin.display.brief import Brief
from thesis_pin.errors import BadInput
from thesis_pin.numeric.checks import choice, shown
from thesis_pin.numeric.turns import need_turns
from thesis_pin.report.branches import label


class Branch(NamedTuple):
    """Seven signs that pick one of the 128 formal solutions.

    Attributes:
        e0: Elbow of chain 0: −1 above the line from shoulder to wrist.
        f0: Forearm: −1 is the same forearm turned half about its own axis.
        w: Wrist: sign of sin θ1716.
        e1: Elbow of chain 1: −1 outwards on the thesis's robot.
        f1: Rod of chain 1: −1 is the same rod turned half about its own axis.
        e2: Elbow of chain 2: +1 outwards on the thesis's robot.
        f2: Rod of chain 2.
    """

    e0: int
    f0: int
    w: int
    e1: int
    f1: int
    e2: int
    f2: int

    def __str__(self) -> str:
        return label(self)

    @classmethod
    def parse(cls, text: str) -> Branch:
        """Read a label of seven signs, for instance ``"-++-+++"``.

        Raises:
            BadInput: It isn't seven signs.
        """
        if not isinstance(text, str) or len(text) != 7 or set(text) - {"+", "-"}:
            raise BadInput(
                f"{text!r} isn't a branch",
                allowed=f"seven signs for {', '.join(cls._fields)}",
                remedy=f"The default is {DEFAULT_BRANCH}",
            )
        return cls(*(1 if sign == "+" else -1 for sign in text))


ALL_BRANCHES = tuple(Branch(*signs) for signs in itertools.product((-1, 1), repeat=7))
"""All 128 formal branches."""

USEFUL_BRANCHES = tuple(b for b in ALL_BRANCHES if b.f0 == b.f1 == b.f2 == 1)
"""The 16 in which forearm and rods aren't turned about their own axes."""

DEFAULT_BRANCH = Branch(e0=-1, f0=1, w=1, e1=-1, f1=1, e2=1, f2=1)
"""Elbow of chain 0 up, elbows of the side chains outwards."""


_KNOWN = frozenset(ALL_BRANCHES)


def one_branch(branch: object) -> Branch:
    """A branch label, checked.

    Raises:
        BadInput: It isn't a :class:`Branch` of seven signs.
    """
    if branch is DEFAULT_BRANCH:
        return DEFAULT_BRANCH
    with suppress(TypeError):  # a sign that can't be hashed is no sign
        if isinstance(branch, Branch) and branch in _KNOWN:
            return branch
    given = tuple(branch) if isinstance(branch, Branch) else f"a {type(branch).__name__}"
    raise BadInput(
        f"branch is {given}",
        allowed="a pollard_pin.Branch of seven signs, each 1 or -1",
        remedy=f'Make one with Branch.parse("{DEFAULT_BRANCH}") or Branch(*signs)',
    )


def branch_labels(branches: object) -> tuple[Branch, ...]:
    """Several branch labels: ``"all"``, ``"useful"`` or a sequence of them.

    Raises:
        UnknownName: No set has this name.
        BadInput: There is no label, or one of them is none.
    """
    if isinstance(branches, str):
        named = {"all": ALL_BRANCHES, "useful": USEFUL_BRANCHES}
        return named[choice("set of branches", branches, list(named))]
    if not isinstance(branches, list | tuple) or not branches:
        raise BadInput(
            f"branch is {'empty' if isinstance(branches, list | tuple) else shown(branches)}",
            allowed='a pollard_pin.Branch, a list of them, "useful" or "all"',
        )
    return tuple(one_branch(branch) for branch in branches)


class SideNumbers(NamedTuple):
    """A side chain in floats, which cost less than entries of arrays.

    Attributes:
        x, y, z: Ball joint in the forearm's frame [m].
        y_10: Base, signed [m].
        drop: From the base's arm up to the shoulder of chain 0 [m].
        arm, rod: x43 and x87 [m].
        excess: arm² − rod² [m²].
        c_54, s_54: Cosine and sine of β54.
    """

    x: float
    y: float
    z: float
    y_10: float
    drop: float
    arm: float
    rod: float
    excess: float
    c_54: float
    s_54: float


@dataclass(frozen=True)
class Geometry(Brief):
    """Lengths and angles, with the side chains stacked.

    Attributes:
        z_10, x_32, x_1918: Lengths of chain 0 [m].
        forearm: x65 + x1514 [m].
        anchors: Ball joints in the forearm's frame [m], shape ``(2, 3)``.
        y_10: Bases of the side chains, signed [m], shape ``(2,)``.
        z_32, x_43, x_87: Their lengths [m], shape ``(2,)``.
        beta_54, beta_1413: Their constant angles [rad], shape ``(2,)``.
        lower, upper: Joint limits [rad], shape ``(12,)``.
    """

    z_10: float
    x_32: float
    x_1918: float
    forearm: float
    anchors: np.ndarray
    y_10: np.ndarray
    z_32: np.ndarray
    x_43: np.ndarray
    x_87: np.ndarray
    beta_54: np.ndarray
    beta_1413: np.ndarray
    lower: np.ndarray
    upper: np.ndarray

    @cached_property
    def turned(self) -> bool:
        """Whether limits hold some angles only whole turns from (−π, π]."""
        return need_turns(self.lower, self.upper)

    @cached_property
    def excess(self) -> float:
        """x32² − forearm² [m²]."""
        return self.x_32**2 - self.forearm**2

    @cached_property
    def sides(self) -> tuple[SideNumbers, SideNumbers]:
        """The side chains, number by number."""
        excess = self.x_43**2 - self.x_87**2
        lengths = (self.y_10, self.z_10 + self.z_32, self.x_43, self.x_87, excess)
        turn = (np.cos(self.beta_54), np.sin(self.beta_54))
        one, two = np.column_stack([self.anchors, *lengths, *turn]).tolist()
        return SideNumbers(*one), SideNumbers(*two)

    @classmethod
    def of(cls, specification: Specification) -> Geometry:
        """Geometry of a specification."""
        chain, sides = specification.chain_0, specification.side_chains
        lower, upper = specification.assumptions.joint_limits.radians()
        signs = np.array(specification.assumptions.signs.value, dtype=float)
        return cls(
            z_10=chain.z_10,
            x_32=chain.x_32,
            x_1918=chain.x_1918,
            forearm=chain.forearm,
            anchors=anchors(specification),
            y_10=signs * [side.y_10 for side in sides],
            z_32=np.array([side.z_32 for side in sides]),
            x_43=np.array([side.x_43 for side in sides]),
            x_87=np.array([side.x_87 for side in sides]),
            beta_54=np.radians([side.beta_54_deg for side in sides]),
            beta_1413=np.radians([side.beta_1413_deg for side in sides]),
            lower=lower,
            upper=upper,
        )
