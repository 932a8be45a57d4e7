"""MuJoCo's compiled model → description.

Coordinates mean what they mean in MuJoCo (a hinge at its ``ref`` stands as the file
draws it), but for quaternions, which Pinocchio writes x, y, z, w. Several joints of
one body become a chain of massless links.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.model.description import Array, Description, Inertial, Joint, Link
from thesis_pin.model.formats.cutting import Cutter, fresh
from thesis_pin.model.formats.mjcf_forces import Forces
from thesis_pin.model.formats.writer import NO_EFFORT_LIMIT, UNLIMITED, pose, write_urdf
from thesis_pin.model.supplement import Closure, Coupling, Mask, Supplement

if TYPE_CHECKING:
    import mujoco

FREE, BALL, SLIDE, HINGE = range(4)
"""MuJoCo's types of joints, ``mjtJoint``."""

ROOT_JOINT = "root_joint"
"""What a free root's coordinates are called."""

_POINT: Mask = (True, True, True, False, False, False)
_WELD: Mask = (True, True, True, True, True, True)


def describe(
    model: mujoco.MjModel,
    where: str,
    warnings: list[str],
    passed_over: list[str],
    lines: tuple[Mapping[str, int], Mapping[str, int]] = ({}, {}),
) -> Description:
    """Read a compiled model.

    Args:
        model: The model.
        where: File name for messages.
        warnings: What is odd already; more may be added.
        passed_over: What isn't used already; more may be added.
        lines: Of the bodies and joints by their names, where they are known.
    """
    reading = _Reading(model, where, warnings, passed_over, lines)
    reading.read_bodies()
    closures = tuple(reading.closures())
    couplings = tuple(reading.couplings())
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
        write_urdf(name, links.values(), joints.values()),
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
        self.bodies = _names(model, "body", model.nbody)
        self.joint_names = _names(model, "jnt", model.njnt)
        self.free_body = self._free_root()
        self.kept: dict[int, str] = {}
        self.types: dict[str, str] = {}
        self.made = Cutter({}, {}, {*self.bodies, *self.joint_names}, where)
        self.forces = Forces(model, self.joint_names, where, warnings, passed_over)

    def _free_root(self) -> int:
        model = self.model
        roots = [k for k in range(1, model.nbody) if model.body_parentid[k] == 0]
        moving = {int(model.body_rootid[k]) for k in np.asarray(model.jnt_bodyid)}
        free = [k for k in roots if k in moving and model.jnt_type[model.body_jntadr[k]] == FREE]
        tied = {int(model.body_rootid[b]) for pair in self._tied_bodies() for b in pair}
        return free[0] if len(free) == 1 and moving | tied <= {free[0]} else -1

    def _tied_bodies(self) -> list[tuple[int, int]]:
        model = self.model
        pairs = []
        for k in range(model.neq):
            if model.eq_type[k] in (_CONNECT, _WELDED):
                ends = (int(model.eq_obj1id[k]), int(model.eq_obj2id[k]))
                if _on_sites(model, k):
                    ends = (int(model.site_bodyid[ends[0]]), int(model.site_bodyid[ends[1]]))
                pairs.append(ends)
        return pairs

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

    def closures(self) -> list[Closure]:
        """Connects and welds; two frames are made for each."""
        model, found = self.model, []
        for k in range(model.neq):
            if model.eq_type[k] not in (_CONNECT, _WELDED) or not self._active(k):
                continue
            one, other, first, second = _anchors(model, k)
            name = _equality_name(model, k, f"{self.bodies[one]} – {self.bodies[other]}")
            stem = name.replace(" – ", "_")
            frames = (
                self.made.frame(f"{stem}_1", self.bodies[one], first, 0),
                self.made.frame(f"{stem}_2", self.bodies[other], second, 0),
            )
            rows = _POINT if model.eq_type[k] == _CONNECT else _WELD
            found.append(Closure(name, frames, rows))
        return found

    def couplings(self) -> list[Coupling]:
        """Joint equalities that are linear: q₁ − q₁⁰ = a₀ + a₁ (q₂ − q₂⁰)."""
        model, found = self.model, []
        for k in range(model.neq):
            if model.eq_type[k] != _JOINTS or not self._active(k):
                continue
            one, other = int(model.eq_obj1id[k]), int(model.eq_obj2id[k])
            shift, factor, *more = (float(a) for a in model.eq_data[k][:5])
            names = [self.joint_names[j] for j in (one, other) if j >= 0]
            name = _equality_name(model, k, " – ".join(names))
            if other >= 0 and any(more):
                self.passed_over.append(
                    f"{self.where}: equality {name!r}, which ties joints by a polynomial of a "
                    "higher degree than 1"
                )
                continue
            start = model.qpos0[model.jnt_qposadr]
            coefficients, constant = {names[0]: 1.0}, float(start[one]) + shift
            if other >= 0:
                coefficients[names[1]] = -factor
                constant -= factor * float(start[other])
            found.append(Coupling(name, coefficients, constant))
        return found

    def _active(self, equality: int) -> bool:
        if self.model.eq_active0[equality] and not self.forces.without_equalities:
            return True
        name = _equality_name(self.model, equality, f"number {equality}")
        self.passed_over.append(f"{self.where}: equality {name!r}, which isn't active")
        return False

    def poses(self) -> dict[str, dict[str, tuple[float, ...]]]:
        """The reference pose ``qpos0``, and the keyframes."""
        found = {"qpos0": self._pose(self.model.qpos0)}
        for k in range(self.model.nkey):
            name = fresh(_name_at(self.model, self.model.name_keyadr[k]) or f"key{k}", found)
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


_CONNECT, _WELDED, _JOINTS = 0, 1, 2
"""MuJoCo's types of equalities, ``mjtEq``."""

_SITE = 6
"""``mjtObj`` of a site."""


def turned(quaternion: Array) -> Array:
    """Rotation of a quaternion w, x, y, z, shape ``(3, 3)``."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def about(axis: Array, angle: float) -> Array:
    """Rotation about an axis of length 1 [rad], shape ``(3, 3)``."""
    return turned(np.r_[np.cos(angle / 2), np.sin(angle / 2) * axis])


def _inertial(model: mujoco.MjModel, body: int) -> Inertial | None:
    mass, moments = float(model.body_mass[body]), np.array(model.body_inertia[body])
    if mass == 0.0 and not moments.any():
        return None
    place = pose(model.body_ipos[body], turned(model.body_iquat[body]))
    return Inertial(mass, place, np.diag(moments))


def _on_sites(model: mujoco.MjModel, equality: int) -> bool:
    return int(model.eq_objtype[equality]) == _SITE


def _anchors(model: mujoco.MjModel, k: int) -> tuple[int, int, Array, Array]:
    """Bodies of a connect or weld, and its frame on each."""
    ends, data = (int(model.eq_obj1id[k]), int(model.eq_obj2id[k])), model.eq_data[k]
    if _on_sites(model, k):
        first, second = (pose(model.site_pos[s], turned(model.site_quat[s])) for s in ends)
        return int(model.site_bodyid[ends[0]]), int(model.site_bodyid[ends[1]]), first, second
    if model.eq_type[k] == _CONNECT:
        return *ends, pose(data[:3]), pose(data[3:6])
    # A weld's data: its anchor on the second body, then where that stands on the first.
    return *ends, pose(data[3:6], turned(data[6:10])), pose(data[:3])


def _equality_name(model: mujoco.MjModel, k: int, otherwise: str) -> str:
    return _name_at(model, model.name_eqadr[k]) or otherwise


def _names(model: mujoco.MjModel, kind: str, count: int) -> list[str]:
    """A name for each body or joint, no two alike."""
    names: dict[str, None] = {}
    given = [_name_at(model, getattr(model, f"name_{kind}adr")[k]) for k in range(count)]
    for k, name in enumerate(given):
        names[name or fresh(f"{'joint' if kind == 'jnt' else kind}{k}", {*names, *given})] = None
    return list(names)


def _name_at(model: mujoco.MjModel, address: int) -> str:
    text: bytes = model.names
    return text[address : text.index(b"\0", address)].decode("utf-8", "replace")
