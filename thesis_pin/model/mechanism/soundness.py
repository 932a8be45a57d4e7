"""Whether a description makes a mechanism, and whether Pinocchio made it of the file.

Pinocchio reads a URDF without complaint when its inertias are impossible, its
names collide or its links form a loop, and answers with a model that is silently
wrong. :func:`check_description` refuses those before, :func:`check_agreement`
compares the model afterwards with our own sums.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError, UnknownName
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.bodies import check_bodies
from thesis_pin.model.mechanism.description import Description, Joint, MovingBody, moving_bodies
from thesis_pin.numeric.arrays import skew
from thesis_pin.tolerances import TOLERANCES

_FREEDOMS = {"revolute": 1, "continuous": 1, "prismatic": 1, "floating": 6, "planar": 3}


def check_description(description: Description, *, where: str) -> None:
    """Refuse what no mechanism is.

    Args:
        description: What was read.
        where: File name for messages.

    Raises:
        ModelError: A link with two parents, a loop, more than one root, impossible
            limits or axes.
        UnknownName: A joint names a link that isn't there.
        NonPhysicalInertia: With the link, its eigenvalues and by how much.
    """
    _check_tree(description, where)
    for joint in description.joints.values():
        _check_joint(joint, f"{where}:{joint.line}: joint {joint.name!r}")
    check_bodies(description)


def check_agreement(
    description: Description, model: pin.Model, *, roots: int = 0, where: str
) -> None:
    """Refuse a model that isn't what the file says.

    Args:
        description: What was read.
        model: What Pinocchio made of the same text.
        roots: Number of joints between world and root link.
        where: File name for messages.

    Raises:
        ModelError: Says what Pinocchio has and what the file says.
    """
    if differences := list(agreement(description, model, roots=roots)):
        more = f" (and {len(differences) - 1} more)" if len(differences) > 1 else ""
        raise ModelError(
            f"Pinocchio reads it otherwise than it is written: {differences[0]}{more}",
            where=where,
            remedy="Its reader may have said more on standard error; write the place plainly",
        )


def agreement(description: Description, model: pin.Model, *, roots: int = 0) -> Iterator[str]:
    """Every difference between a model and our own sums over the file.

    Joints, their order, types, placements, axes, limits and friction; and of each
    moving body, fixed links merged, mass, centre of mass and inertia.
    """
    names = list(model.names)
    bodies = {body.joint: body for body in moving_bodies(description)}
    expected, found = set(bodies) - {""}, set(names[1 + roots :])
    if expected != found or len(names) != len(expected) + 1 + roots:
        odd = sorted(expected ^ found)
        yield f"it has joints {', '.join(odd[:5])} where the file has others"
        return
    at = {name: k for k, name in enumerate(names)} | {"": roots}
    for name, body in bodies.items():
        yield from _inertia(body, model.inertias[at[name]], name or "the root")
        if name:
            yield from _joint(description.joints[name], body, model, at)


def _inertia(body: MovingBody, found: pin.Inertia, name: str) -> Iterator[str]:
    here = f"of the body that {name!r} moves" if body.joint else "of the root"
    tolerance, com = TOLERANCES.model, np.array(found.lever)
    if not abs(found.mass - body.mass) <= tolerance * body.mass:
        yield f"the mass {here} is {found.mass:.9g} kg instead of {body.mass:.9g} kg"
        return
    if body.mass == 0.0:
        return
    own = body.moment / body.mass
    size = 1.0 + np.abs(own).max()
    if not np.abs(com - own).max() <= tolerance * size:
        yield f"the centre of mass {here} is {com.round(9)} m instead of {own.round(9)} m"
        return
    arm = skew(com)
    tensor = np.array(found.inertia) - found.mass * arm @ arm
    size = np.abs(body.tensor).max() + body.mass * size**2
    if not np.abs(tensor - body.tensor).max() <= tolerance * size:
        yield f"the inertia {here} differs by {np.abs(tensor - body.tensor).max():.3g} kg·m²"


def _joint(joint: Joint, body: MovingBody, model: pin.Model, at: dict[str, int]) -> Iterator[str]:
    number, here = at[joint.name], f"of joint {joint.name!r}"
    found = model.joints[number]
    if found.nv != _FREEDOMS[joint.kind]:
        yield f"joint {joint.name!r} has {found.nv} degrees of freedom, being {joint.kind}"
        return
    if model.parents[number] != at[body.above]:
        yield f"joint {joint.name!r} hangs on {model.names[model.parents[number]]!r}"
    place = np.array(model.jointPlacements[number].homogeneous)
    size = 1.0 + np.abs(body.placement).max()
    if not np.abs(place - body.placement).max() <= TOLERANCES.model * size:
        yield f"the placement {here} differs by {np.abs(place - body.placement).max():.3g}"
    if found.nv != 1:
        return
    data = found.createData()
    found.calc(data, pin.neutral(model))
    axis = np.zeros(6)
    start = 0 if joint.kind == "prismatic" else 3
    axis[start : start + 3] = joint.axis / np.linalg.norm(joint.axis)
    if not np.abs(np.array(data.S).ravel() - axis).max() <= TOLERANCES.model:
        yield f"the axis {here} is {np.array(data.S).ravel()[start : start + 3].round(6)}"
    lower, upper, effort, velocity = joint.limit or (0.0, 0.0, 0.0, 0.0)
    q, v = found.idx_q, found.idx_v
    pairs = [
        ("damping", model.damping[v], joint.damping),
        ("friction", model.upperDryFrictionLimit[v], joint.friction),
    ]
    if joint.limit is not None:
        pairs += [("effort", model.upperEffortLimit[v], effort)]
        pairs += [("velocity", model.upperVelocityLimit[v], velocity)]
    if joint.kind != "continuous":
        pairs += [("lower limit", model.lowerPositionLimit[q], lower)]
        pairs += [("upper limit", model.upperPositionLimit[q], upper)]
    for what, has, ought in pairs:
        if not abs(has - ought) <= TOLERANCES.model * abs(ought):
            yield f"the {what} {here} is {has:.9g} instead of {ought:.9g}"


def _check_tree(description: Description, where: str) -> None:
    above: dict[str, Joint] = {}
    for joint in description.joints.values():
        here = f"{where}:{joint.line}"
        for end in (joint.parent, joint.child):
            if end not in description.links:
                known = list(description.links)
                raise UnknownName("link", end, known, where=f"{here}: joint {joint.name!r}")
        if joint.child in above:
            raise ModelError(
                f"link {joint.child!r} has two parents, through joints "
                f"{above[joint.child].name!r} and {joint.name!r}",
                where=here,
                allowed="a tree",
                remedy="Cut the loop there and describe it in a closure file",
            )
        above[joint.child] = joint
    roots = [name for name in description.links if name not in above]
    if len(roots) > 1:
        raise ModelError(
            f"{len(roots)} links have no parent: {', '.join(roots)}", where=where, allowed="one"
        )
    children: dict[str, list[str]] = {}
    for child, joint in above.items():
        children.setdefault(joint.parent, []).append(child)
    reached, waiting = set(), list(roots)
    while waiting:
        reached.add(link := waiting.pop())
        waiting.extend(children.get(link, []))
    if lost := [name for name in description.links if name not in reached]:
        raise ModelError(
            f"links {', '.join(lost)} form a loop",
            where=where,
            allowed="a tree",
            remedy="Cut the loop and describe it in a closure file",
        )


def _check_joint(joint: Joint, here: str) -> None:
    if joint.kind in ("fixed", "floating"):
        return  # its axis and limits mean nothing
    effort, velocity = (0.0, 0.0) if joint.limit is None else joint.limit[2:]
    most = (("greatest effort", effort), ("greatest velocity", velocity))
    for what, value in (("damping", joint.damping), ("friction", joint.friction), *most):
        if value < 0:
            raise ModelError(f"its {what} is {value:g}", where=here, allowed="at least 0")
    if joint.kind in ("revolute", "prismatic"):
        if joint.limit is None:
            raise ModelError("it has no <limit>", where=here)
        lower, upper = joint.limit[:2]
        if lower > upper:
            raise ModelError(f"its limits are reversed: {lower} > {upper}", where=here)
    if not np.abs(joint.axis).max() >= LIMITS.axis:
        raise ModelError(
            "its axis is zero", where=here, allowed=f"a vector of length at least {LIMITS.axis:g}"
        )
    if joint.kind == "planar":
        across = np.abs(joint.axis[:2]).max()
        if joint.axis[2] <= 0.0 or across > TOLERANCES.model * joint.axis[2]:
            raise ModelError(
                f"it is planar about {joint.axis.tolist()}, and Pinocchio moves planar joints "
                "across z whatever their axis",
                where=here,
                allowed='<axis xyz="0 0 1"/>',
                remedy="Turn its <origin> so that z is the normal of the plane",
            )
