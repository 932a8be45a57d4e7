"""Prints what a specification describes, for any robot."""

from __future__ import annotations

import numpy as np

from thesis_pin.command.output import print_table, print_text
from thesis_pin.report.info import Info


def print_info(info: Info) -> None:
    """Print a document of :mod:`thesis_pin.report.info` in at most 80 columns."""
    print_text(
        f"{info['robot']}: {info['source']}. Mass {info['mass']:.5g} kg, "
        f"{len(info['joints'])} joints, {len(info['bodies'])} bodies with mass."
    )
    print_table(
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
    print_table(
        ("body", "mass g", "centre of mass mm", "gyration mm", "length mm"),
        [
            (
                body["name"],
                f"{body['mass'] * 1e3:.2f}",
                " ".join(f"{value * 1e3:.2f}" for value in body["com"]),
                f"{body['radius_of_gyration'] * 1e3:.1f}",
                f"{body['span'] * 1e3:.1f}",
            )
            for body in info["bodies"]
        ],
    )
    print_table(
        ("body", "principal moments kg·mm²"),
        [
            (body["name"], " ".join(f"{value * 1e6:.2f}" for value in body["principal_moments"]))
            for body in info["bodies"]
        ],
        title=f"Inertias: {info['inertia']} reading, about the centre of mass",
    )
    motors = sum(joint["motor"] for joint in info["joints"])
    where = "" if info["freedom"]["at_pose"] is None else " at the neutral pose"
    rank = info["freedom"]["by_rank"]
    print_text(
        f"Degrees of freedom: {info['freedom']['counted']} by counting, "
        f"{'none found' if rank is None else rank} by rank{where}; {motors} motors.",
        *(
            f"Loop {loop['name']}: {' and '.join(map(str, _list(loop['frames'])))} coincide."
            for loop in info["loops"]
        ),
        *(_place(end, place) for end, place in info["neutral"].items()),
        *(_assumed(one) for one in info["assumptions"]),
    )


def _place(end: str, place: np.ndarray) -> str:
    values = ", ".join(f"{value * 1e3:.3f}" for value in place)
    return f"Neutral {end.replace('_', ' ')}: ({values}) mm."


def _list(value: object) -> list[object]:
    return list(value) if isinstance(value, list | tuple) else [value]


def _assumed(one: dict[str, object]) -> str:
    """An assumption with its values, if they are few, and its reason."""
    values = [
        f"{key.replace('_', ' ')} {value}" for key, value in one.items() if _short(key, value)
    ]
    said = f": {', '.join(values)}" if values else ""
    return f"Assumed {str(one['name']).replace('_', ' ')}{said} ({one['why']})."


def _short(key: str, value: object) -> bool:
    return key not in ("name", "why") and not (isinstance(value, list) and len(value) > 3)
