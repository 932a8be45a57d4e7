"""What a closure file says, joined to what the description says itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from thesis_pin.model.formats.urdf.closing_frames import closing_pairs
from thesis_pin.model.mechanism.description import Description
from thesis_pin.model.mechanism.supplement import Closure, Coupling, Supplement


def joined(description: Description, beside: Supplement) -> Description:
    """A description with a closure file's content.

    The closure file has the last word: its motors are the motors, its closures replace those
    of the description between the same two bodies and those that names of frames suggest.
    All else is added to what the description says, or replaces what is called the same.

    Args:
        description: What the robot's own file says.
        beside: What the closure file says.
    """
    own = description.supplement
    by_names = {frozenset(pair) for _, *pair in closing_pairs(description)}
    mover = _movers(description)
    closed = {frozenset(mover.get(frame, frame) for frame in one.frames) for one in beside.closures}
    kept: list[Closure] = []
    warnings = list(description.warnings)
    passed_over = list(description.passed_over)
    for one in own.closures:
        suggested = frozenset(one.frames) in by_names
        if beside.closures and suggested:
            # Said by the file's warnings already: what is taken now is what the next lines say.
            warnings = [line for line in warnings if repr(one.frames[0]) not in line]
            if all(set(one.frames) != set(other.frames) for other in beside.closures):
                first, second = one.frames
                warnings.append(
                    f"{description.where}: frames {first!r} and {second!r} look like a loop, "
                    "and the closure file doesn't close it"
                )
        elif frozenset(mover.get(frame, frame) for frame in one.frames) in closed:
            passed_over.append(
                f"{description.where}: <loop> {one.name!r}: the closure file closes it otherwise"
            )
        else:
            kept.append(one)
    supplement = replace(
        own,
        closures=(*kept, *beside.closures),
        couplings=(*_others(own.couplings, beside.couplings), *beside.couplings),
        motors=beside.motors,
        joint_types={**own.joint_types, **beside.joint_types},
        springs=(
            *(one for one in own.springs if one.joint not in {new.joint for new in beside.springs}),
            *beside.springs,
        ),
        armature={**own.armature, **beside.armature},
        damping={**own.damping, **beside.damping},
        friction={**own.friction, **beside.friction},
        poses={**own.poses, **beside.poses},
        free_root=own.free_root or beside.free_root,
        gravity=own.gravity if beside.gravity == Supplement().gravity else beside.gravity,
    )
    return replace(
        description,
        supplement=supplement,
        warnings=tuple(warnings),
        passed_over=tuple(passed_over),
    )


def _others(own: Sequence[Coupling], new: Sequence[Coupling]) -> Iterator[Coupling]:
    """Couplings that aren't given anew."""
    names = {one.name for one in new}
    return (one for one in own if one.name not in names)


def _movers(description: Description) -> dict[str, str]:
    """Link → the first link of the body it is fixed to."""
    fixed = {
        joint.child: joint.parent for joint in description.joints.values() if joint.kind == "fixed"
    }
    found = {}
    ends = {name: name for name in description.links}
    ends = {name: joint.child for name, joint in description.joints.items()} | ends
    for name, top in ends.items():
        while top in fixed:
            top = fixed[top]
        found[name] = top
    return found
