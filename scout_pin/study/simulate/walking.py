"""One try: the robot put on the floor, its servos commanded, what it did."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scout_pin.model import Scout
from scout_pin.specification import SIDES
from scout_pin.study.simulate.conditions import Conditions
from scout_pin.study.simulate.planned import Planned
from scout_pin.study.simulate.world import engine, walking_tree
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.workers import silent
from thesis_pin.simulation.engine import Engine


@dataclass(frozen=True)
class Walked(Brief):
    """What a robot did, at the recorded instants of its plan.

    Attributes:
        q, v: As Pinocchio counts, ``(n, 19)`` and ``(n, 18)``.
        torque: Of the servos [N·m], ``(n, 12)``.
        soles: Places of both soles, left then right, ``(2, n, 4, 4)``.
        load: What the floor bears of each, along its normal [N], ``(2, n)``.
        meeting: Whether the soles touch each other, ``(n,)``.
        peak_torque: Of each joint at any step of the gait [N·m], ``(12,)``.
        saturated: Share of the gait's steps in which each servo gave all it has, ``(12,)``.
    """

    q: np.ndarray
    v: np.ndarray
    torque: np.ndarray
    soles: np.ndarray
    load: np.ndarray
    meeting: np.ndarray
    peak_torque: np.ndarray
    saturated: np.ndarray


def walk(
    robot: Scout,
    plan: Planned,
    conditions: Conditions,
    draw: int = 0,
    progress: Callable[[int, int], None] = silent,
) -> Walked:
    """Try a plan once.

    Args:
        robot: The biped, with a free-flyer root.
        plan: What its servos are commanded.
        conditions: Servos, floor, errors.
        draw: Which errors.
        progress: Called with the steps done and their total.

    Raises:
        BadInput: MuJoCo isn't installed.
        ModelError: It gives up.
    """
    zeros, masses = conditions.errors(draw)
    tree = walking_tree(robot, conditions, masses)
    world = engine(robot, tree, conditions, plan.step)
    servos = _Servos(robot, world, plan)
    floor = _Floor(robot, world)
    world.place(plan.q[0], None if plan.before else plan.v[0], -plan.before * world.time_step)
    record = world.run(
        conditions.gains.stiffness * (plan.commands + zeros),
        every=plan.every,
        before=servos.before,
        after=servos.after,
        watch=floor.watch,
        progress=progress,
    )
    seen = record.seen
    return Walked(
        record.q,
        record.v,
        record.torque,
        _placements(seen[:, :24], robot),
        seen[:, 24:26].T,
        seen[:, 26] > 0,
        servos.peak,
        servos.full / max(servos.steps, 1),
    )


class _Servos:
    """Servos' limits: what torque is left at a speed, and how often all of it is given."""

    def __init__(self, robot: Scout, world: Engine, plan: Planned) -> None:
        self.range, self.rate = world.model.actuator_forcerange, world.data.qvel[6:]
        self.force, self.stall = world.data.actuator_force, robot.stall_torque
        self.speed = robot.no_load_speed
        self.peak, self.full, self.steps = np.zeros(12), np.zeros(12), 0
        self.number, self.first = 0, plan.before
        self.last = len(plan.commands) - plan.after

    def before(self) -> None:
        """Torque falls with speed; against its turning a servo gives what it gives at rest."""
        share = self.rate / self.speed
        self.range[:, 1] = self.stall * np.clip(1.0 - share, 0.0, 1.0)
        self.range[:, 0] = -self.stall * np.clip(1.0 + share, 0.0, 1.0)

    def after(self) -> None:
        """Note what each gave, while the gait lasts."""
        if self.first <= self.number < self.last:
            np.maximum(self.peak, np.abs(self.force), out=self.peak)
            self.full += (self.force >= self.range[:, 1]) | (self.force <= self.range[:, 0])
            self.steps += 1
        self.number += 1


class _Floor:
    """What the floor bears of each sole, whether they meet, and where the feet are."""

    def __init__(self, robot: Scout, world: Engine) -> None:
        model = world.model
        owner = np.full(model.ngeom, -1)
        for number, side in enumerate(SIDES):
            for geom in range(model.ngeom):
                if model.geom(geom).name.startswith(f"{side}_corner"):
                    owner[geom] = number
        self.owner, self.floor = owner, model.geom("floor").id
        self.data = world.data
        joints = [robot.model.frames[robot.sole_frames[side]].parentJoint for side in SIDES]
        self.feet = np.array(joints)  # bodies are numbered as joints are, the world being zero

    def watch(self) -> np.ndarray:
        """Feet's places (3 + 9 numbers each), loads of both, and whether soles meet: ``(27,)``."""
        found, data = np.zeros(27), self.data
        found[:24] = np.concatenate(
            [np.r_[data.xpos[body], data.xmat[body].ravel()] for body in self.feet]
        )
        contact = data.contact
        if data.ncon:
            pair = contact.geom
            rows = contact.efc_address
            held = (pair == self.floor).any(axis=1) & (rows >= 0)
            side = self.owner[pair].max(axis=1)
            for number in (0, 1):
                found[24 + number] = data.efc_force[rows[held & (side == number)]].sum()
            found[26] = bool(((self.floor != pair).all(axis=1) & (contact.dist < 0)).any())
        return found


def _placements(seen: np.ndarray, robot: Scout) -> np.ndarray:
    """Places of the soles from those of the feet: ``(n, 24)`` → ``(2, n, 4, 4)``."""
    found = np.zeros((2, len(seen), 4, 4))
    found[..., 3, 3] = 1.0
    for number, side in enumerate(SIDES):
        mine = seen[:, 12 * number : 12 * number + 12]
        turn, place = mine[:, 3:].reshape(-1, 3, 3), mine[:, :3]
        frame = robot.model.frames[robot.sole_frames[side]].placement
        found[number, :, :3, :3] = turn @ frame.rotation
        found[number, :, :3, 3] = place + turn @ frame.translation
    return found
