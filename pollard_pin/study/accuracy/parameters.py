"""What of a robot of Pollard's kind can be off: every length, angle, axis and motor by name.

Two axes in space are told apart by four numbers (Denavit and Hartenberg, 1955). Those that a
specification names are its lengths and angles; the others are zero in it, and no workshop makes
them so: axes that are tilted or don't meet. Together they are complete, and none says what another
one says: a turn about a motor's own axis is that motor's error, a shift along an axis belongs to
the next length, and a turn about the axis of a joint without a motor moves nothing.

The joint between arm and rod is taken as two axes that meet. Its own tilts, β54 among them, turn
the rod and don't move what it holds.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, get_args

from pollard_pin.kinematics.geometry import Geometry
from pollard_pin.specification import ACTUATOR_NAMES, ACTUATOR_SYMBOLS, Specification

Kind = Literal[
    "lengths", "angles", "axes", "offsets", "motors", "play", "backlash", "encoder", "zero"
]
KINDS: tuple[str, ...] = get_args(Kind)

ASKED_ONLY = ("play", "backlash", "encoder", "zero")
"""Kinds that have no tolerance unless they are asked for by name."""

Unit = Literal["mm", "deg"]


class Parameter(NamedTuple):
    """A number of the robot that can be off.

    Attributes:
        name: As the specification's key where it has one.
        kind: What it is.
        column: Which of :data:`COLUMNS` it changes; several may change one.
        words: What it is, for people.
    """

    name: str
    kind: Kind
    column: int
    words: str

    @property
    def unit(self) -> Unit:
        """What its tolerance is written in: ``mm`` or ``deg``."""
        return "mm" if self.kind in ("lengths", "offsets", "play") else "deg"


_CHAIN_0 = {
    "z_10": "height of the shoulder",
    "x_32": "upper arm",
    "x_65": "elbow to the foot of the ball joints",
    "x_1514": "from there to the wrist",
    "x_1918": "wrist to spray tip",
}
_SIDE = {
    "y_10": "base, sideways",
    "z_32": "arm below its base",
    "x_43": "arm",
    "x_87": "rod",
    "x_1211": "ball joint, sideways",
    "z_1312": "ball joint, below the forearm",
}
_SIDE_ANGLES = {
    "beta_54": "joint of the rod about the arm",
    "beta_1413": "ball joint about the forearm's z",
}
_AXES = {
    "chain0_shoulder": "xz",
    "chain0_elbow_pitch": "xz",
    "chain0_elbow_yaw": "x",
    "wrist_roll": "yz",
    "wrist_yaw": "y",
    "tool_roll": "y",
    "nozzle": "yz",
    "chain1_shoulder": "xy",
    "chain2_shoulder": "xy",
}
"""Joint → axes of the frame it stands in about which its own may be tilted."""
_OFFSETS = {
    "chain0_shoulder": "x",
    "chain0_elbow_pitch": "y",
    "chain0_elbow_yaw": "x",
    "wrist_roll": "yz",
    "wrist_yaw": "y",
    "tool_roll": "yz",
    "nozzle": "yz",
    "chain1_shoulder": "x",
    "chain2_shoulder": "x",
    "ball_joint_1": "x",
    "ball_joint_2": "x",
}
"""Joint → axes of the frame it stands in along which it may be shifted, beside the lengths."""


def _columns() -> dict[str, tuple[Kind, str]]:
    found: dict[str, tuple[Kind, str]] = {}
    for key, words in _CHAIN_0.items():
        found[f"chain_0.{key}"] = ("lengths", words)
    for i in (1, 2):
        for key, words in _SIDE.items():
            found[f"chain_{i}.{key}"] = ("lengths", words)
    for i in (1, 2):
        for key, words in _SIDE_ANGLES.items():
            found[f"chain_{i}.{key}"] = ("angles", words)
    for name, axes in _AXES.items():
        for axis in axes:
            found[f"axis.{name}.{axis}"] = ("axes", f"axis tilted about {axis}")
    for name, axes in _OFFSETS.items():
        for axis in axes:
            found[f"offset.{name}.{axis}"] = ("offsets", f"axis shifted along {axis}")
    for name, symbol in zip(ACTUATOR_NAMES, ACTUATOR_SYMBOLS, strict=True):
        found[f"motor.{name}"] = ("motors", f"where the motor of {symbol} stands")
    return found


_FOUND = _columns()

COLUMNS: tuple[str, ...] = tuple(_FOUND)
"""The independent errors, in the order of every ``(m, …)`` array of them [m], [rad]."""

PLACE = {name: k for k, name in enumerate(COLUMNS)}
"""Number of each column."""


def _parameters() -> tuple[Parameter, ...]:
    one_each = [
        Parameter(name, *_FOUND[name][:1], PLACE[name], _FOUND[name][1]) for name in COLUMNS
    ]
    rods = [
        Parameter(f"play.{joint}_{i}", "play", PLACE[f"chain_{i}.x_87"], f"play {words}")
        for joint, words in (("ball_joint", "of the ball joint"), ("rod_joint", "at the arm's end"))
        for i in (1, 2)
    ]
    sources: tuple[tuple[Kind, str], ...] = (
        ("backlash", "play of the gear of"),
        ("encoder", "step or error of the encoder of"),
        ("zero", "zero of"),
    )
    motors = [
        Parameter(f"{kind}.{name}", kind, PLACE[f"motor.{name}"], f"{words} {symbol}")
        for kind, words in sources
        for name, symbol in zip(ACTUATOR_NAMES, ACTUATOR_SYMBOLS, strict=True)
    ]
    return (*one_each, *rods, *motors)


PARAMETERS = _parameters()
"""Everything a tolerance can be given for; play and gears stand for errors that others are too."""


class Numbers(NamedTuple):
    """The planned numbers, one by one, as :class:`Geometry` hasn't them.

    Attributes:
        z_10, x_32, x_65, x_1514, x_1918: Lengths of chain 0 [m].
        sign: Side on which each side chain stands.
        y_10, z_32, x_43, x_87, x_1211, z_1312: Lengths of the side chains [m].
        beta: Angles β1413 [rad].
    """

    z_10: float
    x_32: float
    x_65: float
    x_1514: float
    x_1918: float
    sign: tuple[int, int]
    y_10: tuple[float, float]
    z_32: tuple[float, float]
    x_43: tuple[float, float]
    x_87: tuple[float, float]
    x_1211: tuple[float, float]
    z_1312: tuple[float, float]
    beta: tuple[float, float]

    @classmethod
    def of(cls, specification: Specification) -> Numbers:
        """Of a specification."""
        chain, (one, two) = specification.chain_0, specification.side_chains
        beta = Geometry.of(specification).beta_1413.tolist()
        return cls(
            z_10=chain.z_10,
            x_32=chain.x_32,
            x_65=chain.x_65,
            x_1514=chain.x_1514,
            x_1918=chain.x_1918,
            sign=specification.assumptions.signs.value,
            y_10=(one.y_10, two.y_10),
            z_32=(one.z_32, two.z_32),
            x_43=(one.x_43, two.x_43),
            x_87=(one.x_87, two.x_87),
            x_1211=(one.x_1211, two.x_1211),
            z_1312=(one.z_1312, two.z_1312),
            beta=(beta[0], beta[1]),
        )
