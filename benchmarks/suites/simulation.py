"""Robots in the second engine, beside the engine's bare steps of the same model."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from machine import installed
from measuring import Equal, Peer, Row, Scale

import pollard_pin
import scout_pin
from pollard_pin.motion.files import load_path
from pollard_pin.study.simulate import replay
from pollard_pin.study.simulate.conditions import Conditions as Replaying
from pollard_pin.study.simulate.engines import Springs
from pollard_pin.study.simulate.planned import stretches
from scout_pin.motion.files import load_gait
from scout_pin.study.simulate.conditions import Conditions as Walking
from scout_pin.study.simulate.planned import planned
from scout_pin.study.simulate.world import engine, walking_tree
from suites.scout_dynamics import EXAMPLES
from thesis_pin.simulation.engine import Engine

BARE = "mj_step of the same model"
END = "pose at the end [m], [rad]"
SCOUT_STEP, POLLARD_STEP = 1e-3, 5e-4
"""Time steps of the engine [s]."""
STIFFNESS = (30.0, 30.0, 30.0, 0.3, 0.3, 0.01)
"""Of Pollard's servos [N·m/rad], as docs/simulation.md has them."""


def rows(scale: Scale) -> Iterator[Row]:
    """A row a robot; an item is a simulated millisecond."""
    if not installed("mujoco"):
        print("simulation: mujoco isn't installed", file=sys.stderr)
        return
    yield _scout("squat" if scale.quick else "walk")
    yield _pollard()


def _scout(name: str) -> Row:
    robot, conditions = scout_pin.load(), Walking(time_step=SCOUT_STEP)
    report = scout_pin.gait_report(robot, load_gait(EXAMPLES / f"{name}.toml"), samples=801)
    ours = partial(scout_pin.simulate_gait, report, conditions)
    plan = planned(report, conditions)
    world = engine(robot, walking_tree(robot, conditions, np.ones(13)), conditions, SCOUT_STEP)
    place = partial(world.place, plan.q[0], None if plan.before else plan.v[0])
    bare = Bare(world, place, conditions.gains.stiffness * plan.commands)
    return _beside("Scout on servos, 1 ms a step", ours, lambda: ours().walked.q[-1], bare)


def _pollard() -> Row:
    robot, conditions = pollard_pin.load(), Replaying(time_step=POLLARD_STEP, stiffness=STIFFNESS)
    report = pollard_pin.trajectory_report(robot, load_path(EXAMPLES / "spray_arch.toml"))
    ours = partial(pollard_pin.simulate_path, report, conditions)
    prepared = replay.prepare(report, conditions)
    parts = list(stretches(report, prepared.time_step))
    springs = Springs(robot, prepared.servo, prepared.time_step, parts[0].q[0], parts[0].v[0])
    asked = np.concatenate([springs.go(part).torque[:-1] for part in parts])
    place = partial(springs.engine.place, parts[0].q[0], parts[0].v[0])
    bare = Bare(springs.engine, place, asked)
    return _beside("Pollard on servos, 0.5 ms a step", ours, lambda: ours().replay.q[-1], bare)


class Bare:
    """The engine alone: what drives were asked for, and its steps.

    Args:
        engine: With the robot in it.
        place: Puts the robot where it begins.
        asked: Of each drive at each step, ``(steps, drives)``.
    """

    def __init__(self, engine: Engine, place: Callable[[], None], asked: np.ndarray) -> None:
        self.engine, self.place, self.asked = engine, place, asked

    def work(self) -> None:
        """Go all the way."""
        self.place()
        model, data, step = self.engine.model, self.engine.data, self.engine.mujoco.mj_step
        for asked in self.asked:
            data.ctrl[:] = asked
            step(model, data)

    def end(self) -> np.ndarray:
        """Where the robot is then, as Pinocchio counts."""
        self.work()
        return self.engine.state()[0]


def _beside(
    shown: str, ours: Callable[[], object], end: Callable[[], np.ndarray], bare: Bare
) -> Row:
    def difference() -> float:
        return float(np.abs(end() - bare.end()).max())

    size = round(len(bare.asked) * bare.engine.time_step * 1e3)
    return Row(shown, size, ours, Peer(BARE, size, bare.work), Equal(END, difference, 1e-9))
