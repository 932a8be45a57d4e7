"""MuJoCo's compiled model → description.

Coordinates mean what they mean in MuJoCo (a hinge at its ``ref`` stands as the file
draws it), but for quaternions, which Pinocchio writes x, y, z, w. Several joints of
one body become a chain of massless links.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.errors import ModelError
from thesis_pin.model.formats.cutting import Cutter, fresh
from thesis_pin.model.formats.mjcf.equalities import Equalities
from thesis_pin.model.formats.mjcf.forces import Forces
from thesis_pin.model.formats.mjcf.names import about, name_at, names_of, turned
from thesis_pin.model.formats.mjcf.shapes import shapes_of
from thesis_pin.model.formats.writer import NO_EFFORT_LIMIT, UNLIMITED, pose, write_urdf
from thesis_pin.model.limits import LIMITS
from thesis_pin.model.mechanism.description import Array, Description, Inertial, Joint, Link
from thesis_pin.model.mechanism.supplement import Supplement

if TYPE_CHECKING:
    import mujoco

FREE, BALL, SLIDE, HINGE = range(4)
"""MuJoCo's types of joints, ``mjtJoint``."""

ROOT_JOINT = "root_joint"
"""What a free root's coordinates are called."""


def describe(
    model: mujoco.MjModel,
    where: str,
    warnings: list[str],
    passed_over: list[str],
    lines: tuple[Mapping[str, int], Mapping[str, int]] = ({}, {}),
) -> Description:
    """Read a compiled model.

    Raises:
        ModelError: It has more joints than are taken.

    Args:
        model: The model.
        where: File name for messages.
        warnings: What is odd already; more may be added.
        passed_over: What isn't used already; more may be added.
        lines: Of the bodies and joints by their names, where they are known.
    """
    if model.njnt > LIMITS.joints:
        raise ModelError(
            f"{model.njnt:,} joints move", where=where, allowed=f"at most {LIMITS.joints:,}"
        )
    reading = _Reading(model, where, warnings, passed_over, lines)
    reading.read_bodies()
    closures = tuple(reading.equalities.closures(reading.made))
    couplings = tuple(reading.equalities.couplings())
    forces, free = reading.forces, reading.free_body >= 0
    armature, damping, friction = forces.by_joint(reading.kept)
    supplement = Supplement(
        closures=closures,
        couplings=couplings,
        motors=tuple(forces.motors.values()),
        joint_types=reading.types,
        springs=tuple(forces.springs(reading.kept)),
        armature=armature,
        damping=damping,
        friction=friction,
        poses=reading.poses(),
        free_root=free,
        gravity=forces.gravity,
    )
    name = model.names[: model.names.index(b"\0")].decode() or "robot"
    links, joints = reading.made.links, reading.made.joints
    return Description(
        name,
        links,
        joints,
        write_urdf(name, links.values(), joints.values(), shapes_of(model, reading.bodies)),
        where=where,
        supplement=supplement,
        warnings=tuple(warnings),
        passed_over=tuple(passed_over),
    )


class _Reading:
    """A model being read, body by body.

    Attributes:
        free_body: Number of the body that is a free root; −1 if the world is the root.
        kept: Number of each joint that is part of the robot → its name.
        types: Joints that aren't what the URDF says.
        made: Links and joints so far.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        where: str,
        warnings: list[str],
        passed_over: list[str],
        lines: tuple[Mapping[str, int], Mapping[str, int]],
    ) -> None:
        self.model, self.where = model, where
        self.warnings, self.passed_over, self.lines = warnings, passed_over, lines
        self.bodies = names_of(model, "body", model.nbody)
        self.joint_names = names_of(model, "jnt", model.njnt)
        self.forces = Forces(model, self.joint_names, where, warnings, passed_over)
        self.equalities = Equalities(
            model, self.bodies, self.joint_names, where, self.forces.without_equalities, passed_over
        )
        self.free_body = self._free_root()
        self.kept: dict[int, str] = {}
        self.types: dict[str, str] = {}
        self.made = Cutter({}, {}, {*self.bodies, *self.joint_names}, where)

    def _free_root(self) -> int:
        model = self.model
        roots = [k for k in range(1, model.nbody) if model.body_parentid[k] == 0]
        moving = {int(model.body_rootid[k]) for k in np.asarray(model.jnt_bodyid)}
        free = [k for k in roots if k in moving and model.jnt_type[model.body_jntadr[k]] == FREE]
        tied = {int(model.body_rootid[b]) for pair in self.equalities.tied_bodies() for b in pair}
        return free[0] if len(free) == 1 and moving | tied <= {free[0]} else -1

    def read_bodies(self) -> None:
        """Links and joints, from the root outwards."""
        model = self.model
        if self.free_body < 0:
            self.made.links[self.bodies[0]] = Link(self.bodies[0], 0)
        fixed: list[str] = []
        for body in range(1, model.nbody):
            if self.free_body >= 0 and model.body_rootid[body] != self.free_body:
                fixed.append(self.bodies[body])
                continue
            if model.body_mocapid[body] >= 0:
                self.passed_over.append(
                    f"{self._place(body)}: it can be moved by hand (mocap); it is fixed here"
                )
            if model.body_gravcomp[body] != 0.0:
                self.passed_over.append(f"{self._place(body)}: gravcomp")
            self._body(body)
        if fixed:
            self.passed_over.append(
                f"{self.where}: bodies {', '.join(fixed[:5])}{' …' if len(fixed) > 5 else ''}, "
                "which are fixed to the world and tied to nothing"
            )

    def _place(self, body: int) -> str:
        line = self.lines[0].get(self.bodies[body], 0)
        return f"{self.where}:{line}: body {self.bodies[body]!r}"

    def _body(self, body: int) -> None:
        model, name = self.model, self.bodies[body]
        line = self.lines[0].get(self.bodies[body], 0)
        self.made.links[name] = Link(name, line, _inertial(model, body))
        parent = self.bodies[int(model.body_parentid[body])]
        numbers = range(
            int(model.body_jntadr[body]), int(model.body_jntadr[body] + model.body_jntnum[body])
        )
        if body == self.free_body:
            self.kept[numbers[0]] = ROOT_JOINT
            return
        at = pose(model.body_pos[body], turned(model.body_quat[body]))
        if not numbers:
            self.made.fix(f"{name}_fixed", parent, name, at, line)
        offset = np.zeros(3)
        for number in numbers:
            here = np.array(model.jnt_pos[number])
            last = number == numbers[-1]
            whole = last and not here.any()
            child = name if whole else self.made.link(f"{name}_{self.joint_names[number]}", line)
            self._joint(number, parent, child, at @ pose(here - offset))
            parent, offset, at = child, here, np.eye(4)
            if last and not whole:
                self.made.fix(f"{name}_fixed", child, name, pose(-here), line)

    def _joint(self, number: int, parent: str, child: str, at: Array) -> None:
        model, name = self.model, self.joint_names[number]
        axis, kind = np.array(model.jnt_axis[number]), int(model.jnt_type[number])
        start = float(model.qpos0[model.jnt_qposadr[number]])
        self.kept[number] = name
        if kind == FREE:
            word, at = "floating", np.eye(4)
        elif kind == BALL:
            word, axis = "revolute", np.eye(3)[0]
            self.types[name] = "SPHERICAL"
            if model.jnt_limited[number]:
                self.passed_over.append(f"{self.where}: the range of ball joint {name!r}")
        elif kind == HINGE:
            word, at = "revolute", at @ pose((0, 0, 0), about(axis, -start))
        else:
            word, at = "prismatic", at @ pose(-start * axis)
        scalar = kind in (HINGE, SLIDE)
        damping, friction = self.forces.losses(number) if scalar else (0.0, 0.0)
        lower, upper = model.jnt_range[number] if scalar and model.jnt_limited[number] else (
            -UNLIMITED, UNLIMITED,
        )  # fmt: skip
        effort = self.forces.effort(number)
        self.made.joints[name] = Joint(
            name,
            self.lines[1].get(name, 0),
            word,
            parent,
            child,
            at,
            axis,
            (float(lower), float(upper), min(effort, NO_EFFORT_LIMIT), NO_EFFORT_LIMIT),
            damping,
            friction,
        )

    def poses(self) -> dict[str, dict[str, tuple[float, ...]]]:
        """The reference pose ``qpos0``, and the keyframes."""
        found = {"qpos0": self._pose(self.model.qpos0)}
        for k in range(self.model.nkey):
            name = fresh(name_at(self.model, self.model.name_keyadr[k]) or f"key{k}", found)
            found[name] = self._pose(self.model.key_qpos[k])
        return found

    def _pose(self, qpos: Array) -> dict[str, tuple[float, ...]]:
        values: dict[str, tuple[float, ...]] = {}
        for number, name in self.kept.items():
            start, kind = int(self.model.jnt_qposadr[number]), self.model.jnt_type[number]
            place = qpos[start : start + 3] if kind == FREE else qpos[:0]
            if kind in (FREE, BALL):
                w, x, y, z = qpos[start + len(place) :][:4] / np.linalg.norm(
                    qpos[start + len(place) :][:4]
                )
                values[name] = tuple(float(value) for value in (*place, x, y, z, w))
            else:
                values[name] = (float(qpos[start]),)
        return values


def _inertial(model: mujoco.MjModel, body: int) -> Inertial | None:
    mass, moments = float(model.body_mass[body]), np.array(model.body_inertia[body])
    if mass == 0.0 and not moments.any():
        return None
    place = pose(model.body_ipos[body], turned(model.body_iquat[body]))
    return Inertial(mass, place, np.diag(moments))
