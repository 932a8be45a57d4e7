"""What drives, springs and brakes the joints of MuJoCo's compiled model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from thesis_pin.model.formats.mjcf.names import name_at
from thesis_pin.model.mechanism.supplement import Motor, Spring

if TYPE_CHECKING:
    import mujoco

_SCALAR = (2, 3)
"""Slides and hinges among MuJoCo's types of joints, ``mjtJoint``."""

_SPRING, _DAMPER = ("mjDSBL_SPRING", "mjDSBL_PASSIVE"), ("mjDSBL_DAMPER", "mjDSBL_PASSIVE")
"""Flags that switch them off; older versions of MuJoCo have one for both."""


class Forces:
    """Motors, springs, damping, friction and armature by joint.

    Attributes:
        motors: Number of the joint → what drives it; several actuators of one joint are
            one motor with the sum of their efforts.
        gravity: [m/s²].
        without_equalities: Whether the file switches its equalities off.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        names: list[str],
        where: str,
        warnings: list[str],
        passed_over: list[str],
    ) -> None:
        self.model, self.names, self.where = model, names, where
        self.warnings, self.passed_over = warnings, passed_over
        off = self._switched_off
        self.without_equalities = off("mjDSBL_EQUALITY") or off("mjDSBL_CONSTRAINT")
        x, y, z = (float(g) for g in model.opt.gravity)
        self.gravity = (0.0, 0.0, 0.0) if off("mjDSBL_GRAVITY") else (x, y, z)
        if model.opt.density or model.opt.viscosity:
            passed_over.append(f"{where}: forces of the fluid around it (density, viscosity)")
        for what in ("jnt_stiffnesspoly", "dof_dampingpoly", "jnt_springyield"):
            if np.any(getattr(model, what, 0.0)):
                passed_over.append(
                    f"{where}: {what.partition('_')[2]}: springs and dampers are linear"
                )
        self.motors: dict[int, Motor] = {}
        self._added_damping: dict[int, float] = {}
        for actuator in range(model.nu if not hasattr(model, "nactuator") else model.nactuator):
            self._actuator(actuator)
        for joint, motor in self.motors.items():
            if model.jnt_actfrclimited[joint]:
                least, most = (float(force) for force in model.jnt_actfrcrange[joint])
                effort = max(motor.effort[0], least), min(motor.effort[1], most)
                self.motors[joint] = replace(motor, effort=effort)

    def _switched_off(self, *flags: str) -> bool:
        import mujoco

        bits = [getattr(mujoco.mjtDisableBit, flag, 0) for flag in flags]
        return any(int(self.model.opt.disableflags) & int(bit) for bit in bits)

    def _actuator(self, k: int) -> None:
        model = self.model
        joint, gear = int(model.actuator_trnid[k][0]), float(model.actuator_gear[k][0])
        name = self._actuator_name(k) or self.names[joint]
        if model.jnt_type[joint] not in _SCALAR:
            self.passed_over.append(
                f"{self.where}: actuator {name!r}, which acts on a ball or free joint"
            )
            return
        lower, upper = sorted(gear * force for force in self._range(k))
        armature = gear**2 * float(getattr(model, "actuator_armature", np.zeros(k + 1))[k])
        damping = gear**2 * float(getattr(model, "actuator_damping", np.zeros(k + 1))[k])
        self._added_damping[joint] = self._added_damping.get(joint, 0.0) + damping
        if (before := self.motors.get(joint)) is not None:
            name, gear = before.name, before.gear
            lower, upper = lower + before.effort[0], upper + before.effort[1]
            armature += before.armature
        self.motors[joint] = Motor(name, self.names[joint], gear, armature, (lower, upper))

    def _range(self, k: int) -> tuple[float, float]:
        """Least and greatest force of an actuator."""
        model = self.model
        if model.actuator_forcelimited[k]:
            return float(model.actuator_forcerange[k][0]), float(model.actuator_forcerange[k][1])
        plain = not (model.actuator_gaintype[k] or model.actuator_biastype[k])
        if plain and not model.actuator_dyntype[k] and model.actuator_ctrllimited[k]:
            gain, (lower, upper) = float(model.actuator_gainprm[k][0]), model.actuator_ctrlrange[k]
            least, most = sorted((gain * float(lower), gain * float(upper)))
            return least, most
        return -inf, inf

    def _actuator_name(self, k: int) -> str:
        return name_at(self.model, self.model.name_actuatoradr[k])

    def effort(self, joint: int) -> float:
        """Greatest torque of a joint's motor [N·m] or force [N]; infinite without one."""
        motor = self.motors.get(joint)
        return inf if motor is None else max(map(abs, motor.effort))

    def losses(self, joint: int) -> tuple[float, float]:
        """Damping and Coulomb friction of a joint."""
        at = int(self.model.jnt_dofadr[joint])
        damping = float(self.model.dof_damping[at]) + self._added_damping.get(joint, 0.0)
        friction = float(self.model.dof_frictionloss[at])
        damped = not self._switched_off(*_DAMPER)
        rough = not self._switched_off("mjDSBL_FRICTIONLOSS", "mjDSBL_CONSTRAINT")
        return (damping if damped else 0.0), (friction if rough else 0.0)

    def by_joint(
        self, kept: Mapping[int, str]
    ) -> tuple[dict[str, float], dict[str, float], dict[str, float]]:
        """Armature of every joint; damping and friction of those of several freedoms."""
        armature: dict[str, float] = {}
        damping: dict[str, float] = {}
        friction: dict[str, float] = {}
        for number, name in kept.items():
            if value := float(self.model.dof_armature[self.model.jnt_dofadr[number]]):
                armature[name] = value
            if self.model.jnt_type[number] not in _SCALAR:
                damped, rough = self.losses(number)
                if damped:
                    damping[name] = damped
                if rough:
                    friction[name] = rough
        return armature, damping, friction

    def springs(self, kept: Mapping[int, str]) -> Iterator[Spring]:
        """Springs of hinges and slides."""
        if self._switched_off(*_SPRING):
            return
        for number, name in kept.items():
            stiffness = float(self.model.jnt_stiffness[number])
            if not stiffness:
                continue
            if self.model.jnt_type[number] in _SCALAR:
                rest = float(self.model.qpos_spring[self.model.jnt_qposadr[number]])
                yield Spring(name, stiffness, rest)
            else:
                self.passed_over.append(
                    f"{self.where}: the spring of joint {name!r}, a ball or free joint"
                )
