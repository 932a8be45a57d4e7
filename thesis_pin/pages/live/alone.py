"""What a page needs to move a robot by itself: forward kinematics of a tree, as data.

``web/tree.js`` reads it. Each joint's placement is that of its parent, its own place there, then
what its coordinates do: a product of screws, or a quaternion.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pinocchio as pin

from thesis_pin.loops.joints import singles
from thesis_pin.loops.moving.coordinates import Coordinate
from thesis_pin.model.mechanism.supplement import Coupling
from thesis_pin.pages.live.hung import Hung
from thesis_pin.pages.scene import Arrow, Ball
from thesis_pin.tolerances import TOLERANCES

Tree = Mapping[str, object]
"""JSON-ready."""

_SCREWS = ("JointModelUniversal", "JointModelSphericalZYX", "JointModelTranslation")
_WHOLE = {
    "JointModelFreeFlyer": "free",
    "JointModelSpherical": "ball",
    "JointModelPlanar": "planar",
}


def tree(
    model: pin.Model, coordinates: Sequence[Coordinate], couplings: Sequence[Coupling] = ()
) -> Tree | str:
    """A robot that its page can move.

    Args:
        model: Pinocchio model.
        coordinates: What the sliders move, in their order.
        couplings: Joints that move together.

    Returns:
        The tree; or, in words, why a page can't move it.
    """
    tied = _tied(coordinates, couplings)
    if isinstance(tied, str):
        return tied
    known, data = singles(model), model.createData()
    pin.forwardKinematics(model, data, pin.neutral(model))
    joints = []
    for number in range(1, model.njoints):
        joint, name = model.joints[number], model.names[number]
        kind, screws = joint.shortname(), [list[float]()]
        if (name in known and joint.nv == 1) or kind in _SCREWS:
            # Where all coordinates are zero, each column is the screw of one of them.
            motion = np.asarray(data.joints[number].S).reshape(6, -1)
            screws = motion.T.tolist()
            kind = "round" if joint.nq > joint.nv else "screws"
        elif kind in _WHOLE:
            kind = _WHOLE[kind]
        else:
            return f"joint {name!r} is a {kind}"
        place = model.jointPlacements[number]
        joints.append(
            {
                "parent": int(model.parents[number]),
                "turn": place.rotation.ravel().tolist(),
                "shift": place.translation.tolist(),
                "kind": kind,
                "q": int(joint.idx_q),
                "screws": screws,
            }
        )
    return {
        "joints": joints,
        "coordinates": [_coordinate(one) for one in coordinates],
        "couplings": tied,
        "limit": TOLERANCES.joint_limit,
        "masses": [[float(one.mass), *one.lever.tolist()] for one in model.inertias],
        "pose": [
            [
                json.dumps(name, ensure_ascii=False).replace("\x7f", "\\u007f"),
                int(joint.idx_q),
                int(joint.nq),
                name in known and known[name].continuous,
            ]
            for name, joint in zip(list(model.names)[1:], list(model.joints)[1:], strict=True)
            if joint.nq
        ],
    }


def hooks(hung: Iterable[Hung]) -> list[Mapping[str, object]]:
    """On what each item hangs, for the page."""
    kinds = {Ball: "ball", Arrow: "arrow"}
    return [
        {
            "kind": kinds.get(type(one.item), "placement"),
            "joint": one.joint,
            "at": list(one.at),
            "tip": None if one.tip is None else [one.tip[0], list(one.tip[1])],
            "marks": one.marks,
            "level": isinstance(one.item, Ball) and one.item.level is not None,
        }
        for one in hung
    ]


def _coordinate(one: Coordinate) -> Mapping[str, object]:
    return {
        "kind": one.kind,
        "q": one.q,
        "part": one.part,
        "joint": one.joint,
        "unit": one.unit,
        "low": one.low if np.isfinite(one.low) else None,
        "high": one.high if np.isfinite(one.high) else None,
    }


def _tied(
    coordinates: Sequence[Coordinate], couplings: Sequence[Coupling]
) -> list[list[float]] | str:
    """Couplings of two joints each, as two places in q with their factors, and a constant."""
    places = {one.name: one.q for one in coordinates if one.kind == "position"}
    group = {name: name for name in places}
    found: list[list[float]] = []
    for one in couplings:
        ends = [(name, factor) for name, factor in one.coefficients.items() if factor]
        if len(ends) != len(("one", "other")) or any(name not in places for name, _ in ends):
            return f"coupling {one.name!r} isn't one of two joints with a position each"
        (a, first), (b, second) = ends
        if group[a] == group[b]:
            return f"coupling {one.name!r} ties joints that others tie already"
        merged = group[b]
        group = {name: group[a] if root == merged else root for name, root in group.items()}
        found.append([places[a], first, places[b], second, one.constant])
    return found
