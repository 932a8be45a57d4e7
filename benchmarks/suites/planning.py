"""Whole plans of walks, beside RNEA and its derivatives at as many samples as a plan looks at."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
import pinocchio as pin
from measuring import Equal, Goal, Peer, Row, Scale, Unequal
from peers.common import rnea

import scout_pin
from scout_pin.coordinates import free_flyer_state
from scout_pin.dynamics.inverse import joint_friction
from suites.scout_dynamics import EXAMPLES, FORCES, unexplained
from thesis_pin.numeric.workers import silent

YARDSTICK = "RNEA and its derivatives, as often"
ROUNDS = 3
"""Turns of what takes seconds."""


@dataclass(frozen=True)
class Asked:
    """A plan to be made.

    Attributes:
        shown: How the table calls it.
        request: What is asked for.
        seconds: What it may take, on either clock.
        robot: Name of a specification in ``examples/``; empty for Scout.
        met: Whether it can be met.
        rounds: Turns.
    """

    shown: str
    request: scout_pin.PlanRequest
    seconds: float
    robot: str = ""
    met: bool = True
    rounds: int = ROUNDS


def request(**values: float | str) -> scout_pin.PlanRequest:
    """A request with angles in degrees and lengths in millimetres, as one types them."""
    scales = dict.fromkeys(("roll", "pitch", "yaw"), np.pi / 180)
    scales |= dict.fromkeys(("margin", "lift", "foot_spacing", "step_length", "speed"), 1e-3)
    given = {k: one * scales[k] if k in scales else one for k, one in values.items()}
    return scout_pin.PlanRequest(**given)


ASKED = (
    Asked("30 mm in 0.8 s, the default", request(), 2.0),
    Asked("cruise: margin 15 mm, lift 20 mm", request(margin=15, lift=20, foot_spacing=72), 10.0),
    Asked("100 mm/s", request(speed=100), 10.0),
    Asked(
        "quasi-static: 2 s a step, posture 12/8/8°, 0.35 N·m",
        request(
            step_time=2.0, roll=12, pitch=8, yaw=8, margin=5, foot_spacing=60.4,
            torque_reserve=0.19,
        ),
        15.0,
    ),
    Asked(
        "152 mm/s, posture 15/15/12°, margin 5 mm",
        request(speed=152, roll=15, pitch=15, yaw=12, margin=5),
        15.0,
    ),
    Asked("lopsided's default", request(), 10.0, robot="lopsided"),
    Asked("120 mm a step: refused, with the reason", request(step_length=120), 15.0, met=False,
          rounds=1),
)  # fmt: skip


def rows(scale: Scale) -> Iterator[Row]:
    """A row a plan."""
    for asked in ASKED[:1] if scale.quick else ASKED:
        yield row(asked, scale)


def row(asked: Asked, scale: Scale, progress: Callable[[int, int], None] = silent) -> Row:
    """A plan beside Pinocchio's share of it.

    Args:
        asked: What is planned.
        scale: How much is done.
        progress: Called as by :func:`scout_pin.plan_gait`.

    Raises:
        Unequal: It could be met, or not, otherwise than is known.
    """
    robot = scout_pin.load(EXAMPLES / f"{asked.robot}.toml") if asked.robot else scout_pin.load()
    ours = partial(scout_pin.plan_gait, robot, asked.request, progress=progress)
    with counted() as count:  # it warms up, too
        plan = ours()
    if plan.met != asked.met:
        raise Unequal(f"{asked.shown}: met is {plan.met}, and has to be {asked.met}")
    peer = Peer(YARDSTICK, count.samples, partial(yardstick(robot), count))
    equal = Equal(FORCES, partial(_explained, robot, plan, scale), 1e-9) if plan.met else None
    goals = (Goal(asked.seconds, "s"), Goal(asked.seconds, "s by the clock"))
    shown, rounds = f"plan: {asked.shown}", 1 if scale.quick else asked.rounds
    return Row(shown, count.samples, ours, peer, equal, goals, rounds=rounds, warm=False)


@dataclass
class Count:
    """What was asked of Pinocchio.

    Attributes:
        samples: For which RNEA was.
        sloped: For which its derivatives were.
    """

    samples: int = 0
    sloped: int = 0


@contextlib.contextmanager
def counted() -> Iterator[Count]:
    """Count what is asked of Pinocchio in the meantime."""
    count, forces, slopes = Count(), pin.rneaInParallel, pin.computeRNEADerivatives

    def counting_forces(threads: int, pool: pin.ModelPool, q: np.ndarray, *rest: np.ndarray):
        count.samples += q.shape[-1]
        return forces(threads, pool, q, *rest)

    def counting_slopes(*given: object):
        count.sloped += 1
        return slopes(*given)

    pin.rneaInParallel, pin.computeRNEADerivatives = counting_forces, counting_slopes
    try:
        yield count
    finally:
        pin.rneaInParallel, pin.computeRNEADerivatives = forces, slopes


def yardstick(robot: scout_pin.Scout) -> Callable[[Count], None]:
    """Does as much with Pinocchio alone, at samples of the thesis's gait, over and over."""
    gait = scout_pin.load_gait("thesis")
    motion = gait.sample(gait.sample_times(1000))
    other = scout_pin.load()
    state = free_flyer_state(motion.torso, scout_pin.joint_trajectory(other, motion))
    model, data, size = robot.model, robot.model.createData(), len(state[0])
    whole = rnea(model, state)

    def work(count: Count) -> None:
        full, left = divmod(count.samples, size)
        for _ in range(full):
            whole()
        rnea(model, [part[:left] for part in state])()
        for k in range(count.sloped):
            q, v, a = (part[k % size] for part in state)
            pin.computeRNEADerivatives(model, data, q, v, a)

    return work


def _explained(robot: scout_pin.Scout, plan: scout_pin.Plan, scale: Scale) -> float:
    """The walk's torques, friction left out, and wrenches must give RNEA's forces again."""
    report = plan.walk.report
    few = slice(None, None, max(1, len(report.motion.t) // scale.few))
    state = free_flyer_state(report.motion.torso.part(few), report.joints.part(few))
    found = report.dynamics
    torque = found.torque[few] - joint_friction(robot, report.joints.part(few).v)
    return unexplained(robot, state, torque, found.wrench[few])
