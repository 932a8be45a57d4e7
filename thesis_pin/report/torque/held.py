"""What the world holds: no leg of such a robot bears its weight."""

from __future__ import annotations

import pinocchio as pin

from thesis_pin.loops.closures import ClosedRobot

HELD = (
    "The world holds {link}, as the file says, so none of the {count} limbs on it bears its "
    "weight; of a robot on its feet see thesis-pin balance, of one that flies --free-flyer"
)


def held_note(robot: ClosedRobot) -> str | None:
    """A sentence on a tied root link with a mass of its own and limbs that no loop joins.

    Arms have one limb, and chains of a parallel robot meet again: of those there is nothing to say.
    """
    model = robot.model
    limbs = list(model.parents)[1:].count(0)
    links = [
        frame
        for frame in model.frames
        if frame.type == pin.FrameType.BODY and frame.parentJoint == 0
    ]
    if robot.loops or limbs < 2 or not links or not any(link.inertia.mass for link in links):
        return None
    return HELD.format(link=links[0].name, count=limbs)
