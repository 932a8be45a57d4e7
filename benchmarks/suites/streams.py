"""A million samples in little memory, in a process of its own, against ten thousand."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from measuring import Equal, Goal, Peer, Row, Scale
from processes import measured_child
from tables import spaced

import pollard_pin
import scout_pin
from pollard_pin.motion.curves import appendix_b

_SCOUT = """
import scout_pin
robot, gait = scout_pin.load(), scout_pin.load_gait("thesis")
t = gait.sample_times({count})
def blocks():
    return scout_pin.torque_blocks(robot, gait, t)
"""
_POLLARD = """
import numpy, pollard_pin
robot, path = pollard_pin.load(), pollard_pin.appendix_b()
t = numpy.linspace(0, path.duration, {count})
def blocks():
    return pollard_pin.torque_blocks(robot, path, t)
"""
_WORK = """
def work():
    for block in blocks():
        block.dynamics.torque
"""
SMALL = 10_000


def rows(scale: Scale) -> Iterator[Row]:
    """A row a robot."""
    small = min(SMALL, scale.million // 3)
    for name, text, equal in (
        ("Scout's gait", _SCOUT, _scout),
        ("Pollard's path", _POLLARD, _pollard),
    ):
        ours = partial(measured_child, text.format(count=scale.million) + _WORK, warm=0)
        rounds = 1 if scale.quick else 21
        theirs = partial(measured_child, text.format(count=small) + _WORK, rounds)
        yield Row(
            f"{name} to torques, block by block",
            scale.million,
            ours,
            Peer(f"the same, {spaced(small)} samples", small, theirs),
            Equal("torques of the blocks and of all at once [N·m]", equal, 1e-12),
            (Goal(1.15), Goal(3.2, "s"), Goal(220, "MB")),
        )


def _scout() -> float:
    robot, gait = scout_pin.load(), scout_pin.load_gait("thesis")
    t = gait.sample_times(5000)
    blocks = [one.dynamics.torque for one in scout_pin.torque_blocks(robot, gait, t, size=999)]
    whole = scout_pin.inverse_dynamics(robot, gait.sample(t)).torque
    return float(np.abs(np.concatenate(blocks) - whole).max())


def _pollard() -> float:
    robot, path = pollard_pin.load(), appendix_b()
    time = np.linspace(0, path.duration, 5000)
    blocks = [one.dynamics.torque for one in pollard_pin.torque_blocks(robot, path, time, size=999)]
    whole = pollard_pin.inverse_dynamics(robot, path.at(time)).torque
    return float(np.abs(np.concatenate(blocks) - whole).max())
