"""The two engines: each carries the closed robot through a stretch of the plan.

MuJoCo closes the ball joints by stiff springs and is asked for one torque a step, as by a
controller. Pinocchio has the exact constrained dynamics; its state is put back onto the
loops after every step, and torques change continuously.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import pinocchio as pin

from pollard_pin.mjcf import mjcf
from pollard_pin.model import Pollard
from pollard_pin.study.simulate.conditions import EngineName, Servo
from pollard_pin.study.simulate.planned import Stretch
from pollard_pin.urdf import anchors
from thesis_pin.simulation.engine import Engine, engine_module

LONGEST: dict[str, float] = {"mujoco": 5e-4, "pinocchio": 2e-3}
"""Time step of each engine where servos ask for none shorter [s]: at these, loops and energy close
a hundred times better than they are judged by."""


@dataclass(frozen=True)
class Track:
    """What an engine did in a stretch of c steps.

    Attributes:
        q, v: Joint angles [rad] and rates [rad/s], each ``(c + 1, 12)``.
        torque: Of the motors [N·m], at each time or held since, shape ``(c + 1, 6)``.
        work: Of the motors in each step [J], shape ``(c, 6)``.
    """

    q: np.ndarray
    v: np.ndarray
    torque: np.ndarray
    work: np.ndarray


def engine_name(name: EngineName) -> str:
    """Name and version of an engine.

    Raises:
        BadInput: It isn't installed.
    """
    if name == "mujoco":
        return f"MuJoCo {engine_module().__version__}"
    return f"Pinocchio {pin.__version__}"


class Carrier(Protocol):
    """An engine with the robot in it, somewhere on the way."""

    def go(self, stretch: Stretch) -> Track:
        """Go on through a stretch, which begins where the one before ended."""


def carrier(
    name: EngineName, robot: Pollard, servo: Servo, time_step: float, start: Stretch
) -> Carrier:
    """An engine with a robot at the beginning of the plan.

    Args:
        name: Which engine.
        robot: The robot that is simulated.
        servo: What is added to the plan's torques.
        time_step: [s].
        start: The plan's first stretch.

    Raises:
        BadInput: The engine isn't installed.
    """
    kind = Springs if name == "mujoco" else Exact
    return kind(robot, servo, time_step, start.q[0], start.v[0])


class Exact:
    """Pinocchio's constrained dynamics, Runge–Kutta of order four."""

    def __init__(
        self, robot: Pollard, servo: Servo, time_step: float, q: np.ndarray, v: np.ndarray
    ) -> None:
        self.robot, self.servo, self.step = robot, servo, time_step
        self.q, self.v, self.motors = q, v, list(robot.actuated)

    def go(self, stretch: Stretch) -> Track:
        """Go on through a stretch."""
        motors, planned = self.motors, stretch.motors

        def torque(time: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
            now = planned[round(2 * time / self.step)]
            return self.servo.torque(now, q[motors], v[motors])

        duration = stretch.steps * self.step
        done = self.robot.simulate(self.q, self.v, torque, duration, self.step)
        self.q, self.v = done.q[-1], done.v[-1]
        found = self.servo.torque(planned[::2], done.q[:, motors], done.v[:, motors])
        return Track(done.q, done.v, found, self._work(planned, done.q, done.v, found))

    def _work(
        self, planned: np.ndarray, q: np.ndarray, v: np.ndarray, torque: np.ndarray
    ) -> np.ndarray:
        """Integral of each motor's power over each step, by Simpson's rule."""
        q, v, h = q[:, self.motors], v[:, self.motors], self.step
        angle = (q[:-1] + q[1:]) / 2 + h / 8 * (v[:-1] - v[1:])
        rate = 1.5 / h * (q[1:] - q[:-1]) - (v[:-1] + v[1:]) / 4
        middle = self.servo.torque(planned[1::2], angle, rate) * rate
        power = torque * v
        return np.asarray(h / 6 * (power[:-1] + 4 * middle + power[1:]))


class Springs:
    """MuJoCo, Runge–Kutta of order four, ball joints as the stiffest springs it has."""

    def __init__(
        self, robot: Pollard, servo: Servo, time_step: float, q: np.ndarray, v: np.ndarray
    ) -> None:
        specification = robot.specification
        text = mjcf(specification, anchors(specification), robot.inertia)
        self.engine = Engine(text, robot.model)
        self.servo, self.motors = servo, list(robot.actuated)
        mujoco, model = self.engine.mujoco, self.engine.model
        model.opt.timestep = time_step
        # Its default integrators lose a thousandth of the energy exchanged at 1 ms.
        model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
        model.opt.tolerance, model.opt.iterations = 1e-14, 200
        model.eq_solref[:, 0] = 2 * time_step  # the shortest that the engine carries
        # The plan is inside the joint limits; motors are limited by what they are asked for.
        model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
        model.actuator_ctrllimited[:] = 0
        self.engine.place(q, v)

    def go(self, stretch: Stretch) -> Track:
        """Go on through a stretch."""
        motors, data, held = self.motors, self.engine.data, stretch.held
        asked = np.empty((stretch.steps, 6))
        count = iter(range(stretch.steps))

        def decide() -> None:
            k = next(count)
            asked[k] = self.servo.torque(held[k], data.qpos[motors], data.qvel[motors])
            data.ctrl[:] = asked[k]

        done = self.engine.run(held[:, 2], before=decide)
        turned = np.diff(done.q[:, motors], axis=0)
        return Track(done.q, done.v, np.vstack([asked, asked[-1:]]), asked * turned)
