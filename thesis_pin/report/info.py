"""What a specification describes, for any robot: the one JSON schema, and its text."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from thesis_pin.display.counted import counted
from thesis_pin.report.tables import Part, Table
from thesis_pin.version import __version__

if TYPE_CHECKING:
    from thesis_pin.model.strict import Strict

VERSION = 2
"""Of the schema ``…/info``; docs/conventions.md describes it."""


class JointEntry(TypedDict):
    """A joint: angles [rad], effort [N·m], velocity [rad/s]; a passive one has no motor."""

    name: str
    symbol: str
    axis: str
    motor: bool
    lower: float
    upper: float
    effort: float | None
    velocity: float | None


class BodyEntry(TypedDict):
    """A body in its joint's frame: [kg], [m], [kg·m²] about the centre of mass."""

    name: str
    mass: float
    com: np.ndarray
    inertia: np.ndarray
    principal_moments: np.ndarray
    radius_of_gyration: float
    span: float


class Freedom(TypedDict):
    """Degrees of freedom: by counting, and by rank at a pose (None: at every one)."""

    counted: int
    by_rank: int | None
    at_pose: np.ndarray | None


class Info(TypedDict):
    """The document."""

    schema: str
    version: int
    robot: str
    source: str
    inertia: str
    mass: float
    joints: list[JointEntry]
    bodies: list[BodyEntry]
    loops: list[dict[str, object]]
    freedom: Freedom
    neutral: dict[str, np.ndarray]
    lengths: dict[str, dict[str, float]]
    angles: dict[str, dict[str, float]]
    assumptions: list[dict[str, object]]
    implausible: list[str]
    thesis_pin: str


def body(name: str, mass: float, com: np.ndarray, inertia: np.ndarray, span: float) -> BodyEntry:
    """A body's entry.

    Args:
        name: Its name.
        mass: [kg].
        com: Centre of mass in the joint's frame [m], shape ``(3,)``.
        inertia: About the centre of mass [kg·m²], shape ``(3, 3)``.
        span: From its joint to its far end [m], to judge the inertia by.
    """
    moments = np.linalg.eigvalsh(inertia)
    return {
        "name": name,
        "mass": mass,
        "com": com,
        "inertia": inertia,
        "principal_moments": moments,
        "radius_of_gyration": float(np.sqrt(moments[-1] / mass)),
        "span": span,
    }


_UNITS = {
    "coulomb": " N·m",
    "duration": " s",
    "effort": " N·m",
    "inertia": " kg·m²",
    "position": " m",
    "velocity": " rad/s",
    "viscous": " N·m·s/rad",
}
"""Of values that assumptions have, where it isn't in their names."""


def assumptions(stated: Strict) -> list[dict[str, object]]:
    """What a specification assumes, one entry an assumption: ``name``, values, ``why``."""
    dumped: dict[str, Any] = stated.model_dump(mode="json")
    return [
        {"name": name, **one}
        for name, entry in dumped.items()
        for one in (entry if isinstance(entry, list) else [entry])
    ]


def odd_sizes(implausible: Iterable[str]) -> list[dict[str, object]]:
    """Sizes that nobody builds, as assumptions: what was written is taken as it is."""
    return [{"name": "implausible size", "why": one} for one in implausible]


def document(
    command: str,
    robot: str,
    *,
    source: str,
    inertia: str,
    mass: float,
    joints: Sequence[JointEntry],
    bodies: Sequence[BodyEntry],
    loops: Sequence[dict[str, object]] = (),
    freedom: Freedom,
    neutral: Mapping[str, np.ndarray],
    lengths: Mapping[str, Mapping[str, float]],
    angles: Mapping[str, Mapping[str, float]],
    stated: Strict,
    implausible: Sequence[str] = (),
) -> Info:
    """A robot's joints, bodies, loops, freedom and assumptions, JSON-ready.

    Args:
        command: The command that writes it.
        robot: Name of the specification.
        source: Where its numbers come from.
        inertia: Reading of the printed inertias.
        mass: Of everything that moves [kg].
        joints: In the order of joint vectors.
        bodies: From :func:`body`.
        loops: Name and frames of each closure.
        freedom: Degrees of freedom.
        neutral: Where each end is in the neutral or usual pose [m], ``(3,)`` each.
        lengths: What the specification gives [m], by part of the robot, then symbol.
        angles: The same of constant angles [rad].
        stated: The specification's assumptions.
        implausible: Sizes that nobody builds, a sentence each.
    """
    return {
        "schema": f"{command}/info",
        "version": VERSION,
        "robot": robot,
        "source": source,
        "inertia": inertia,
        "mass": mass,
        "joints": list(joints),
        "bodies": list(bodies),
        "loops": list(loops),
        "freedom": freedom,
        "neutral": dict(neutral),
        "lengths": {part: dict(one) for part, one in lengths.items()},
        "angles": {part: dict(one) for part, one in angles.items()},
        "assumptions": [*assumptions(stated), *odd_sizes(implausible)],
        "implausible": list(implausible),
        "thesis_pin": __version__,
    }


def told(info: Info) -> list[Part]:
    """The document for people, in at most 80 columns."""
    joints = Table(
        "Joints",
        ("joint", "", "axis", "range °", "effort N·m", "speed rad/s"),
        [
            (
                joint["name"],
                joint["symbol"],
                joint["axis"],
                f"{np.degrees(joint['lower']):g} to {np.degrees(joint['upper']):g}",
                f"{joint['effort']:g}" if joint["motor"] else "passive",
                f"{joint['velocity']:g}" if joint["motor"] else "",
            )
            for joint in info["joints"]
        ],
    )
    bodies = Table(
        "Bodies",
        ("body", "mass g", "centre of mass mm", "gyration mm", "length mm"),
        [
            (
                body["name"],
                f"{body['mass'] * 1e3:.2f}",
                " ".join(f"{value * 1e3:z.2f}" for value in body["com"]),
                f"{body['radius_of_gyration'] * 1e3:.1f}",
                f"{body['span'] * 1e3:.1f}",
            )
            for body in info["bodies"]
        ],
    )
    inertias = Table(
        f"Inertias: {info['inertia']} reading, about the centre of mass",
        ("body", "principal moments kg·mm²"),
        [
            (body["name"], " ".join(f"{value * 1e6:.2f}" for value in body["principal_moments"]))
            for body in info["bodies"]
        ],
    )
    motors = sum(joint["motor"] for joint in info["joints"])
    where = "" if info["freedom"]["at_pose"] is None else " at the neutral pose"
    rank = info["freedom"]["by_rank"]
    return [
        f"{info['robot']}: {info['source']}. Mass {info['mass']:.5g} kg, "
        f"{counted(len(info['joints']), 'joint')}, "
        f"{counted(len(info['bodies']), 'body', 'bodies')} with mass.",
        joints,
        *_sizes(info),
        bodies,
        inertias,
        f"Degrees of freedom: {info['freedom']['counted']} by counting, "
        f"{'none found' if rank is None else rank} by rank{where}; {counted(motors, 'motor')}.",
        *(
            f"Loop {loop['name']}: {' and '.join(map(str, _list(loop['frames'])))} coincide."
            for loop in info["loops"]
        ),
        *(_place(end, place) for end, place in info["neutral"].items()),
        *(_assumed(one) for one in info["assumptions"] if one["name"] != "implausible size"),
        *(f"Warning: {one}" for one in info["implausible"]),
    ]


def _sizes(info: Info) -> list[Part]:
    """Lengths and constant angles, a column a part of the robot."""
    found: list[Part] = []
    for title, unit, parts, factor in (
        ("Lengths", "mm", info["lengths"], 1e3),
        ("Constant angles", "°", info["angles"], 180.0 / np.pi),
    ):
        names = list(dict.fromkeys(name for part in parts.values() for name in part))
        rows = [
            (
                name,
                *(f"{part[name] * factor:z.7g}" if name in part else "" for part in parts.values()),
            )
            for name in names
        ]
        if rows:
            columns = ("", *(f"{part.replace('_', ' ')} {unit}" for part in parts))
            found.append(Table(title, columns, rows))
    return found


def _place(end: str, place: np.ndarray) -> str:
    values = ", ".join(f"{value * 1e3:z.3f}" for value in place)
    return f"Neutral {end.replace('_', ' ')}: ({values}) mm."


def _list(value: object) -> list[object]:
    return list(value) if isinstance(value, list | tuple) else [value]


def _assumed(one: dict[str, object]) -> str:
    """An assumption with its values, if they are few, and its reason."""
    few = {key: v for key, v in one.items() if not isinstance(v, list) or len(v) < 4}
    values = assumed_values(few)
    said = f": {values}" if values else ""
    return f"Assumed {str(one['name']).replace('_', ' ')}{said} ({one['why']})."


def assumed_values(one: Mapping[str, object]) -> str:
    """The values of an assumption for people, with their units; a range as from and to.

    Args:
        one: An entry of :func:`assumptions`.
    """
    values = {key: value for key, value in one.items() if key not in ("name", "why")}
    said, ends = [], (values.get("lower_deg"), values.get("upper_deg"))
    if all(isinstance(end, int | float) for end in ends):
        said = [f"{_said(values.pop('lower_deg'))} to {_said(values.pop('upper_deg'))}°"]
    for key, value in values.items():
        unit = "°" if key.endswith("_deg") else _UNITS.get(key, "")
        said.append(f"{key.removesuffix('_deg').replace('_', ' ')} {_said(value)}{unit}")
    return ", ".join(said)


def _said(value: object) -> str:
    if isinstance(value, list | tuple):
        return f"({', '.join(map(_said, value))})"
    return f"{value:z.10g}" if isinstance(value, float) else str(value)
