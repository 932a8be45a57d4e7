"""First gaits of a biped, made from where its soles are in the neutral pose.

Both feet stay on the floor and the motion is slow, so that whether it stands is a matter of
statics; the report judges it like any other.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Literal, get_args

import numpy as np
import pinocchio as pin

from scout_pin.kinematics.neutral import tilts
from scout_pin.model import Scout
from scout_pin.motion.files import GaitFile, gait_of
from scout_pin.motion.trajectory import joint_trajectory
from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.model.specification import parse_toml
from thesis_pin.numeric.checks import choice, instance

Kind = Literal["squat", "sway"]

BEND = (0.06, 0.12, 0.03)
"""How far the torso is lowered from the neutral pose, tried in this order, in legs' lengths."""

SHARE = (0.5, 0.3, 0.15)
"""How far the torso sways towards a foot, tried in this order, in halves of the feet's distance."""

DIP = 0.06
"""How much deeper a squat goes, in legs' lengths."""


def gait_text(robot: Scout, kind: Kind) -> str:
    """A gait in TOML that a biped can follow: a squat, or a sway from foot to foot.

    Args:
        robot: The biped.
        kind: ``"squat"`` or ``"sway"``.

    Raises:
        BadInput: Its soles are tilted in the neutral pose, or it can't follow one.
    """
    instance("robot", robot, Scout, "scout_pin.load()")
    choice("kind of gait", kind, get_args(Kind))
    if wrong := tilts(robot.specification):
        beta = np.radians(robot.specification.leg(wrong[0].side).beta_deg)
        raise BadInput(wrong[0].sentence(beta), remedy="scout-pin info says more")
    last: ThesisPinError | None = None
    for bend in BEND:
        for share in SHARE:
            text = _text(robot, kind, bend, share)
            gait = gait_of(parse_toml("gait", GaitFile, text))
            try:
                joint_trajectory(robot, gait.sample(gait.sample_times(41)))
            except ThesisPinError as error:
                last = last or error
            else:
                return text
    raise BadInput(
        f"no {kind} from the neutral pose is within the joints' reach ({last})",
        remedy="Check lengths, angles and joint ranges: scout-pin info, scout-pin view",
    )


def _text(robot: Scout, kind: Kind, bend: float, share: float) -> str:
    feet = robot.neutral_feet()
    left, right = feet["left"], feet["right"]
    length = min(leg.x_3 + leg.x_4 for leg in robot.legs.values())
    height = min(-left[2, 3], -right[2, 3]) - bend * length
    com = pin.centerOfMass(robot.model, robot.model.createData(), pin.neutral(robot.model))
    # The centre of mass over the middle of the soles, wherever their origins are.
    middle = np.mean(
        [robot.sole_vertices(side, feet[side])[:, :2].mean(axis=0) for side in feet], axis=0
    )
    forward, sideways = middle[1] - com[1], middle[0] - com[0]
    half = abs(right[0, 3] - left[0, 3]) / 2
    swing, dip = share * half, DIP * length
    name = robot.specification.name
    places = "\n".join(_foot(side, feet[side]) for side in ("left", "right"))
    if kind == "squat":
        what = f"goes down by {1e3 * dip:.1f} mm and up again"
        x = f"x_mm = {1e3 * sideways:z.2f}"
        z = _curve("z_mm", (0, 2, 4), (height, height - dip, height))
        end = 4
    else:
        what = f"sways by {1e3 * swing:.1f} mm to the left, to the right and back"
        x = _curve("x_mm", (0, 2, 6, 8), (sideways, sideways - swing, sideways + swing, sideways))
        z = f"z_mm = {1e3 * height:.2f}"
        end = 8
    return f"""\
# A first gait for {name}, made from its neutral soles: slowly, both feet on the floor,
# the torso {what}.
# Make it yours; docs/scout.md has the format.

format = 1
name = "{kind}"
source = "made from the neutral soles of {name}"
time_unit = 1.0            # seconds in one unit of t
interpolation = "quintic"  # smooth, at rest at both ends

[torso]  # x to the right, y forward, z up
{x}
y_mm = {1e3 * forward:z.2f}  # the centre of mass over the middle of the soles
{z}

{places}
[[phases]]
start = 0
end = {end}
support = "double"  # left, right or double: who bears load
"""


def _curve(key: str, t: tuple[int, ...], values: tuple[float, ...]) -> str:
    """A curve that rests at every node."""
    pieces = "".join(
        f"  {{ t = [{a}, {b}], value = [{1e3 * start:z.2f}, {1e3 * stop:z.2f}] }},\n"
        for (a, start), (b, stop) in pairwise(zip(t, values, strict=True))
    )
    return f"{key} = [\n{pieces}]"


def _foot(side: str, place: np.ndarray) -> str:
    yaw = np.degrees(np.arctan2(place[1, 0], place[0, 0]))
    turned = f"yaw_deg = {yaw:z.3f}\n" if round(yaw, 3) else ""
    return (
        f"[{side}_foot]\nx_mm = {1e3 * place[0, 3]:z.3f}\ny_mm = {1e3 * place[1, 3]:z.3f}\n{turned}"
    )
