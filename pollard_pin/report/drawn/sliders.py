"""The robot led by six sliders of its tool: closed-form inverse kinematics, branch by branch."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, USEFUL_BRANCHES, Branch
from pollard_pin.kinematics.solutions import Solutions
from pollard_pin.model import Pollard
from pollard_pin.report.drawn.view import CHAINS, colour_of_part
from pollard_pin.report.info import typical_pose
from pollard_pin.specification import ACTUATOR_SYMBOLS, ACTUATORS
from thesis_pin.errors import SingularPose
from thesis_pin.numeric.checks import instance
from thesis_pin.pages.drawing import robot_items
from thesis_pin.pages.live.layers import layers
from thesis_pin.pages.live.page import LivePage
from thesis_pin.pages.live.rig import Slider, Stand
from thesis_pin.pages.scene import Group
from thesis_pin.tolerances import TOLERANCES

Array = NDArray[np.float64]
Readouts = tuple[tuple[str, str], ...]

_ANGLES = (("ψ of the tool", np.pi / 2), ("θ of the tool", np.pi), ("φ of the tool", np.pi))
"""Their ends: cos ψ ≥ 0 has every orientation once."""


class ToolRig:
    """The robot led by the pose of its tool; the state is the pose and the branch's number.

    Args:
        robot: The robot.
        pose: Where its tool is at first, shape ``(6,)``.
        branch: On which branch.
    """

    def __init__(self, robot: Pollard, pose: Array, branch: Branch = DEFAULT_BRANCH) -> None:
        self.robot, self._pose = robot, pose
        self.branches = USEFUL_BRANCHES if branch in USEFUL_BRANCHES else (*USEFUL_BRANCHES, branch)
        self.choices = tuple(str(one) for one in self.branches)
        self._first = self.branches.index(branch)
        robot.inverse_kinematics(pose, branch).require()
        far = float(np.linalg.norm(pose[:3])) * _ROOM
        self.sliders = (
            *(
                Slider(f"{axis} of the spray tip", "mm", min(-far, x), max(far, x), "tool")
                for axis, x in zip("xyz", pose[:3].tolist(), strict=True)
            ),
            *(Slider(name, "°", -end, end, "tool") for name, end in _ANGLES),
        )

    def start(self) -> Stand:
        """The pose it was given."""
        return self._stand(self._pose, self._first)

    def moved(self, state: Array, slider: int, value: float) -> Stand:
        """See :class:`~thesis_pin.pages.live.rig.Rig`; out of reach the last pose is kept."""
        pose, number = self._known(state)
        asked = pose.copy()
        asked[slider] = value
        name = self.sliders[slider].name
        return self._if_reached(asked, number, (pose, number), f"{name} stays where it is")

    def chosen(self, state: Array, choice: int) -> Stand:
        """The same pose on another branch; the branch is kept if that doesn't reach it."""
        pose, number = self._known(state)
        branch = self.branches[choice]
        return self._if_reached(pose, choice, (pose, number), f"branch {branch} isn't taken")

    def alone(self) -> str:
        """See :class:`~thesis_pin.pages.live.rig.Rig`."""
        return "its branches and margins are worked out by the command"

    def _known(self, state: Array) -> tuple[Array, int]:
        """Pose and branch of a state; where it makes no sense those of the start."""
        pose, number = state[:6], int(np.clip(state[6], 0, len(self.branches) - 1))
        if self.robot.inverse_kinematics(pose, self.branches[number]).valid:
            return pose, number
        return self._pose, self._first

    def _if_reached(
        self, pose: Array, number: int, kept: tuple[Array, int], otherwise: str
    ) -> Stand:
        solution = self.robot.inverse_kinematics(pose, self.branches[number])
        if solution.valid:
            return self._stand(pose, number)
        return self._stand(*kept, (f"{otherwise}: {solution.explain()}",))

    def _stand(self, pose: Array, number: int, notes: tuple[str, ...] = ()) -> Stand:
        solutions = self.robot.inverse_kinematics(pose, self.branches)
        one = self.robot.inverse_kinematics(pose, self.branches[number])
        return Stand(
            state=(*pose.tolist(), float(number)),
            q=one.angles,
            values=tuple(pose.tolist()),
            marks=("",) * 6,
            levels={
                1 + k: 0
                for k, beyond in enumerate(one.beyond_limits.tolist())
                if beyond >= -TOLERANCES.joint_limit
            },
            notes=notes,
            readouts=readouts(self.robot, one),
            choice=number,
            possible=tuple(solutions.valid.tolist()),
        )


_ROOM = 2.0
"""Sliders of places reach this many times as far as the tip is at first."""


def readouts(robot: Pollard, solution: Solutions) -> Readouts:
    """Margins of a pose that is reached, and where its motors stand.

    Args:
        robot: The robot.
        solution: Of one pose on one branch.
    """
    found = [("reach margin", f"{float(solution.margin):.3f}")]
    lost = str(solution.singularity[()])
    try:
        held = robot.actuation(solution.angles)
        condition, determinant = float(held.condition), float(held.base_determinant)
        found.append(("condition number", f"{condition:.1f}"))
        found.append(("determinant of the base motors", f"{determinant:.3g}"))
    except SingularPose as error:
        lost = lost or error.what
        found += [("condition number", "∞"), ("determinant of the base motors", "–")]
    found.append(("singular", lost or "no"))
    found.append(("loops open by", f"{1e6 * float(solution.loop_residual.max()):.3f} µm"))
    angles = np.degrees(solution.angles[list(ACTUATORS)])
    found += [
        (f"motor {symbol}", f"{angle:.2f}°")
        for symbol, angle in zip(ACTUATOR_SYMBOLS, angles.tolist(), strict=True)
    ]
    return tuple(found)


def slider_page(
    robot: Pollard,
    branch: Branch = DEFAULT_BRANCH,
    command: str = "pollard-pin view --sliders",
) -> LivePage:
    """The robot with six sliders for its tool, at first where appendix B's curve starts.

    Args:
        robot: The robot.
        branch: Its branch at first; any useful one can be chosen on the page.
        command: What shows the page with sliders that move, for pages whose don't.

    Raises:
        Unreachable: The branch doesn't reach that pose.
    """
    instance("robot", robot, Pollard, "pollard_pin.load()")
    rig = ToolRig(robot, typical_pose(robot), branch)
    q = rig.start().q
    drawn = layers(
        robot,
        q,
        bodies=robot_items(
            robot.model,
            robot.visual_model,
            np.tile(q, (2, 1)),
            group="robot",
            colour=colour_of_part,
        ),
        groups=(Group("robot", "robot", CHAINS),),
    )
    title = f"{robot.specification.name.capitalize()}, its tool moved by sliders"
    return LivePage(rig, drawn, title, command)
