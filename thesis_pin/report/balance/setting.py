"""Where a robot stands or moves: its root, the floor, and who bears load when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from thesis_pin.contacts.balance.stance import stance
from thesis_pin.contacts.floor import Floor, raised
from thesis_pin.contacts.soles.foot import Foot
from thesis_pin.contacts.standing.anchored import anchored
from thesis_pin.contacts.standing.phases import detect, lowest_point
from thesis_pin.contacts.standing.placing import stand
from thesis_pin.errors import BadInput, WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.motion.base import BASE_ANGLES, BASE_PLACE
from thesis_pin.loops.motion.whole import WholeMotion
from thesis_pin.numeric.trajectory import JointTrajectory

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

HELD = np.array([0.0, 1.0])
"""Times between which a pose is held [s]."""


@dataclass(frozen=True, eq=False)
class Setting:
    """A robot over a floor.

    Attributes:
        whole: What all joints do, the root's included.
        floor: The floor.
        stands: Which feet bear load, booleans ``(n, feet)``.
        anchor: The foot that the root follows from; None if it is told.
        said: What was chosen, in sentences.
    """

    whole: WholeMotion
    floor: Floor
    stands: Flags
    anchor: Foot | None
    said: tuple[str, ...]

    def placed(self, robot: ClosedRobot, joints: JointTrajectory) -> JointTrajectory:
        """Another motion of the same joints with its root where it belongs."""
        if self.anchor is None:
            return joints
        return anchored(robot, joints, self.anchor, self.whole.joints.q[0])


def held(
    robot: ClosedRobot,
    pose: Array,
    placed: bool,
    feet: Sequence[Foot],
    floor: Floor | None,
    support: ArrayLike | None,
    fitted: bool = False,
) -> Setting:
    """One pose, held for a second.

    Args:
        robot: The robot.
        pose: Closed configuration, shape ``(nq,)``.
        placed: Whether its root is where it is to be.
        feet: The robot's feet.
        floor: The floor; None for a level one that touches the lowest foot.
        support: Which feet bear load, booleans ``(feet,)``; None for all.
        fitted: Whether the floor says its slope only, and touches the lowest foot.
    """
    said = []
    stands = np.ones(len(feet), dtype=bool) if support is None else np.asarray(support)
    if stands.shape != (len(feet),) or stands.dtype != bool or not stands.any():
        raise WrongShape("support", stands.shape, f"booleans ({len(feet)},), one or more true")
    ground = Floor() if floor is None else floor
    if placed:
        places = stance(robot, feet, ground, pose[None])
        if floor is None or fitted:
            ground = raised(ground, lowest_point(ground, places))
            said.append(f"The floor is taken at {_height(ground)}, where the lowest foot is.")
    else:
        found = stand(
            robot, [foot for foot, on in zip(feet, stands, strict=True) if on], pose, ground
        )
        pose = found.q
        said.append("The robot was put on the floor; the pose says its joints only.")
    q = np.repeat(pose[None], 2, axis=0)
    rest = np.zeros((2, robot.model.nv))
    joints = JointTrajectory(HELD, q, rest, rest)
    whole = WholeMotion(joints, robot.actuators, ())
    return Setting(whole, ground, np.repeat(stands[None], 2, axis=0), None, tuple(said))


def moving(
    robot: ClosedRobot,
    whole: WholeMotion,
    feet: Sequence[Foot],
    floor: Floor | None,
    support: ArrayLike | None,
    told: bool,
    fitted: bool = False,
) -> Setting:
    """A motion over the floor.

    Args:
        robot: The robot.
        whole: What all joints do.
        feet: The robot's feet.
        floor: The floor; None for a level one at the lowest that a foot gets.
        support: Which feet bear load, booleans ``(n, feet)``; None to tell it.
        told: Whether the motion says where the root is.
        fitted: Whether the floor says its slope only, and is at the lowest that a foot gets.

    Raises:
        BadInput: It doesn't, and no sole rests all the time.
    """
    said = []
    count = len(whole.joints.time)
    stands = None if support is None else np.asarray(support)
    if stands is not None and (stands.dtype != bool or stands.shape != (count, len(feet))):
        raise WrongShape("support", stands.shape, f"booleans ({count}, {len(feet)})")
    ground = Floor() if floor is None else floor
    if not told:
        if stands is None:
            stands = np.ones((count, len(feet)), dtype=bool)
            said.append("Nobody said who bears load: all feet, all the time.")
        foot = _resting(feet, stands)
        first = [one for one, on in zip(feet, stands[0], strict=True) if on]
        start = stand(robot, first, whole.joints.q[0], ground).q
        whole = replace(whole, joints=anchored(robot, whole.joints, foot, start))
        said.append(f"Nobody said where the root is: it follows from {foot.name}, which rests.")
        return Setting(whole, ground, stands, foot, tuple(said))
    places = stance(robot, feet, ground, whole.joints.q, whole.joints.v)
    if floor is None or fitted:
        ground = raised(ground, lowest_point(ground, places))
        said.append(f"The floor is taken at {_height(ground)}, the lowest that a foot gets.")
    if stands is None:
        stands = detect(ground, places)
        said.append(
            "Nobody said who bears load: feet that are low and slow, "
            + ", ".join(f"{foot.name} in {stands[:, k].mean():.0%}" for k, foot in enumerate(feet))
            + " of the samples."
        )
    return Setting(whole, ground, stands, None, tuple(said))


def _height(floor: Floor) -> str:
    return f"{floor.height:z.4f} m" + (" at the world's origin" if floor.slope else "")


def _resting(feet: Sequence[Foot], stands: Flags) -> Foot:
    """A sole that bears load all the time."""
    for k, foot in enumerate(feet):
        if foot.kind == "sole" and stands[:, k].all():
            return foot
    raise BadInput(
        "nothing says where the root is, and no sole bears load all the time",
        allowed=", ".join((*BASE_PLACE, *BASE_ANGLES)),
    )
