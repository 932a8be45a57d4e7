"""Pinocchio tree → MJCF: the same bodies, joints, rotors and friction, to the last bit.

One body a joint, with the inertia that Pinocchio has there (bodies fixed to each other are one),
so that MuJoCo's equations of motion are Pinocchio's. What else the world holds (soles, floor,
loops) comes as elements of text, by the joint whose body they belong to.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal
from xml.sax.saxutils import quoteattr

import numpy as np
import pinocchio as pin

from thesis_pin.errors import ModelError
from thesis_pin.model.urdf import number, numbers
from thesis_pin.numeric.rotations import quaternions

Integrator = Literal["Euler", "RK4", "implicit", "implicitfast"]
Kind = Literal["free", "ball", "hinge", "slide"]

UNLIMITED = 1e6
"""Limit [rad], [m] that stands for none."""

REAL_BODY = 1e-15
"""Mass [kg] and moment of inertia [kg·m²] that MuJoCo asks of every body that moves."""


@dataclass(frozen=True)
class World:
    """How time goes on, and what contacts are like.

    Attributes:
        time_step: Of the engine [s].
        integrator: Of the engine. ``implicitfast`` takes the damping of drives at the step's end.
        gravity: In the world [m/s²]; None for the tree's.
        cone: Shape of friction cones.
        impratio: How much harder friction is than what carries: without it, feet creep.
        iterations: Of the solver of contacts, at most.
        tolerance: Of the same.
    """

    time_step: float = 5e-4
    integrator: Integrator = "implicitfast"
    gravity: tuple[float, float, float] | None = None
    cone: Literal["elliptic", "pyramidal"] = "elliptic"
    impratio: float = 10.0
    iterations: int = 100
    tolerance: float = 1e-10


@dataclass(frozen=True)
class Drive:
    """A motor on a joint: its force is what is asked for, minus stiffness · q + damping · rate.

    With both zero what is asked for is the torque. A position servo is asked for
    stiffness · angle; its damping is taken implicitly by the engine.

    Attributes:
        joint: Name of its joint, of one degree of freedom.
        stiffness: [N·m/rad] or [N/m].
        damping: [N·m·s/rad] or [N·s/m].
        limit: Largest torque [N·m] or force [N]; None for none.
    """

    joint: str
    stiffness: float = 0.0
    damping: float = 0.0
    limit: float | None = None


def mjcf(
    tree: pin.Model,
    world: World | None = None,
    *,
    drives: Sequence[Drive] = (),
    inside: Mapping[str, Sequence[str]] | None = None,
    around: Sequence[str] = (),
    sections: Sequence[str] = (),
    limits: bool = True,
) -> str:
    """MJCF text of a tree.

    Args:
        tree: A model by Pinocchio: free flyers on the world, balls, hinges and slides.
        world: Time step, gravity, solver.
        drives: Motors, in the order of what they are asked for.
        inside: Joint → elements of its body, as geoms and sites in the joint's frame.
        around: Elements of the world's body.
        sections: Elements of the root, as ``<equality>`` and ``<asset>``.
        limits: Whether joints end where the tree says.

    Raises:
        ModelError: A joint is of another type, or a body that moves has no mass.
    """
    world = world or World()
    gravity = tree.gravity.linear if world.gravity is None else world.gravity
    children: dict[int, list[int]] = {}
    for joint in range(1, tree.njoints):
        children.setdefault(tree.parents[joint], []).append(joint)
    content = "".join(
        _body(tree, joint, 2, children, inside or {}, limits) for joint in children.get(0, ())
    )
    return (
        f"<mujoco model={quoteattr(tree.name or 'robot')}>\n"
        # Else it would alter inertias that it takes for odd, and leave out bodies.
        '  <compiler angle="radian" autolimits="false" fusestatic="false" discardvisual="false"'
        ' inertiafromgeom="false"/>\n'
        f'  <option timestep="{number(world.time_step)}" gravity="{numbers(gravity)}" '
        f'integrator="{world.integrator}" cone="{world.cone}" '
        f'impratio="{number(world.impratio)}" iterations="{world.iterations}" '
        f'tolerance="{number(world.tolerance)}">\n'
        '    <flag autoreset="disable"/>\n  </option>\n'
        f"{_lines(sections, 1)}"
        "  <worldbody>\n"
        f"{_lines(around, 2)}{content}"
        "  </worldbody>\n"
        f"{_actuators(drives)}"
        "</mujoco>\n"
    )


def kind(joint: pin.JointModel) -> Kind | None:
    """What MuJoCo calls a joint; None if it has none of this type."""
    if joint.nv == 6 and joint.shortname() == "JointModelFreeFlyer":
        return "free"
    if joint.nv == 3 and joint.shortname() == "JointModelSpherical":
        return "ball"
    if joint.nv != 1 or "Helical" in joint.shortname() or "Mimic" in joint.shortname():
        return None
    return "hinge" if axis(joint)[1] else "slide"


def axis(joint: pin.JointModel) -> tuple[np.ndarray, bool]:
    """Axis of a joint of one degree of freedom ``(3,)``, and whether it turns about it."""
    data, zero = joint.createData(), np.zeros(joint.idx_q + joint.nq)
    if joint.nq == 2:  # a continuous joint's cosine and sine
        zero[joint.idx_q] = 1.0
    joint.calc(data, zero)
    column = np.array(data.S, dtype=float).reshape(6)
    turns = bool(column[3:].any())
    return (column[3:] if turns else column[:3]), turns


def body_name(tree: pin.Model, joint: int) -> str:
    """Name of the body that a joint carries, as the tree's frames say it, or the joint's own."""
    for frame in tree.frames:
        body = frame.type == pin.FrameType.BODY and frame.parentJoint == joint
        if body and frame.placement.isIdentity(0.0):
            return str(frame.name)
    return str(tree.names[joint])


def _body(
    tree: pin.Model,
    joint: int,
    depth: int,
    children: Mapping[int, Sequence[int]],
    inside: Mapping[str, Sequence[str]],
    limits: bool,
) -> str:
    pad, place = "  " * depth, tree.jointPlacements[joint]
    below = "".join(
        _body(tree, child, depth + 1, children, inside, limits) for child in children.get(joint, ())
    )
    x, y, z, w = quaternions(place.rotation)
    return (
        f"{pad}<body name={quoteattr(body_name(tree, joint))} "
        f'pos="{numbers(place.translation)}" quat="{numbers((w, x, y, z))}">\n'
        f"{pad}  {_joint(tree, joint, limits)}\n"
        f"{pad}  {_inertial(tree, joint)}\n"
        f"{_lines(inside.get(str(tree.names[joint]), ()), depth + 1)}{below}"
        f"{pad}</body>\n"
    )


def _joint(tree: pin.Model, number_: int, limits: bool) -> str:
    joint, name = tree.joints[number_], str(tree.names[number_])
    what = kind(joint)
    first = joint.idx_v
    span = slice(first, first + joint.nv)
    if what is None or (what == "free" and tree.parents[number_] != 0):
        raise ModelError(
            f"the engine has no joint of the type {joint.shortname()}",
            where=f"joint {name!r}",
            allowed="free flyers on the world, spherical, revolute, continuous and prismatic",
        )
    values = {
        "armature": tree.armature[span],
        "damping": tree.damping[span],
        "frictionloss": tree.upperDryFrictionLimit[span],
    }
    said = ""
    for key, value in values.items():
        if np.ptp(value):
            raise ModelError(f"its {key} differs between its axes", where=f"joint {name!r}")
        if value[0]:
            said += f' {key}="{number(value[0])}"'
    if what in ("hinge", "slide"):
        said += f' axis="{numbers(axis(joint)[0])}"'
        if limits and joint.nq == 1:
            low = float(tree.lowerPositionLimit[joint.idx_q])
            high = float(tree.upperPositionLimit[joint.idx_q])
            if abs(low) < UNLIMITED and abs(high) < UNLIMITED:
                said += f' limited="true" range="{numbers((low, high))}"'
    return f'<joint name={quoteattr(name)} type="{what}"{said}/>'


def _inertial(tree: pin.Model, joint: int) -> str:
    inertia = tree.inertias[joint]
    # By its principal axes: older engines find them to 1e-6 only.
    moments, axes = np.linalg.eigh(np.array(inertia.inertia))
    if inertia.mass < REAL_BODY or moments[0] < REAL_BODY:
        raise ModelError(
            f"its mass is {inertia.mass:g} kg and its least moment of inertia {moments[0]:g} kg·m²",
            where=f"body {body_name(tree, joint)!r}",
            allowed="what moves in the engine has both",
            remedy="Give it what it weighs",
        )
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    x, y, z, w = quaternions(axes)
    return (
        f'<inertial pos="{numbers(inertia.lever)}" mass="{number(inertia.mass)}" '
        f'quat="{numbers((w, x, y, z))}" diaginertia="{numbers(moments)}"/>'
    )


def _actuators(drives: Sequence[Drive]) -> str:
    lines = []
    for one in drives:
        limit = ""
        if one.limit is not None:
            limit = f' forcelimited="true" forcerange="{numbers((-one.limit, one.limit))}"'
        bias = numbers((0.0, -one.stiffness, -one.damping))
        name = quoteattr(one.joint)
        lines.append(
            f'<general name={name} joint={name} gaintype="fixed" gainprm="1" '
            f'biastype="affine" biasprm="{bias}"{limit}/>'
        )
    return f"  <actuator>\n{_lines(lines, 2)}  </actuator>\n" if lines else ""


def _lines(elements: Iterable[str], depth: int) -> str:
    return "".join(f"{'  ' * depth}{one.strip()}\n" for one in elements)
