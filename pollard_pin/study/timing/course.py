"""A path's geometry on the robot: what laws of motion along it are worked out from."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from pollard_pin.kinematics.geometry import DEFAULT_BRANCH, Branch, one_branch
from pollard_pin.kinematics.singularity import actuation, actuation_along, require_one_sign
from pollard_pin.model import Pollard
from pollard_pin.motion.chain import Chain
from pollard_pin.motion.path import ToolPath
from pollard_pin.motion.trajectory import joint_trajectory
from pollard_pin.motion.untimed import untimed
from pollard_pin.study.timing.track import PathTrack
from thesis_pin.display.brief import Brief
from thesis_pin.numeric.checks import instance
from thesis_pin.timing.fastest import fastest
from thesis_pin.timing.limits import Limits
from thesis_pin.timing.solving import INTERVALS
from thesis_pin.timing.track import Grid

SAMPLES = 2001
"""At which a path is tried before anything is asked of its timing."""


@dataclass(frozen=True, eq=False)
class Course(Brief):
    """A path that the robot can follow, its timing left open.

    Attributes:
        path: The path.
        track: Its geometry on the robot.
        notes: What was made of it, in plain words.
    """

    path: ToolPath
    track: PathTrack
    notes: tuple[str, ...]

    @classmethod
    def of(cls, robot: Pollard, path: ToolPath, branch: Branch | None = None) -> Course:
        """A path on a robot.

        Args:
            robot: The robot.
            path: The path of the spray tip; its timing counts for nothing.
            branch: Which inverse-kinematics solution; None for the default branch.

        Raises:
            Unreachable, SingularPose: It can't be followed at all; with the place.
            TrajectoryError: It doesn't move.
        """
        instance("robot", robot, Pollard, "pollard_pin.load()")
        instance("path", path, ToolPath, "load_path() or appendix_b()")
        chosen = DEFAULT_BRANCH if branch is None else one_branch(branch)
        path = path.followed_by(robot.specification)
        _try(robot, path, chosen)
        curves, told = untimed(path)
        chain = Chain.of(curves)
        notes = [*(_of_geometry(note) for note in path.notes), *told]
        if path.variants is not None:
            notes.append(
                "the table's samples are smoothed within their resolution; what that leaves open "
                "of the path isn't judged here"
            )
        if chain.corners:
            some = f"{chain.corners} corner" + "s" * (chain.corners > 1)
            notes.append(f"the path has {some}, where the tool stops")
        return cls(path, PathTrack(robot, chosen, chain), tuple(notes))

    @property
    def robot(self) -> Pollard:
        """The robot."""
        return self.track.robot

    @property
    def branch(self) -> Branch:
        """The solution of inverse kinematics."""
        return self.track.branch

    @cached_property
    def grid(self) -> Grid:
        """Places on it, with what they ask for: the first that laws are tried on."""
        return Grid.of(self.track, INTERVALS)

    def least_duration(self, limits: Limits) -> float:
        """Duration of the fastest law on the first grid [s]: quick, within a few per cent.

        Raises:
            Infeasible: At rest a limit is exceeded somewhere.
        """
        return fastest(self.grid, limits).duration


def _of_geometry(note: str) -> str:
    """A note on a path without what it says of its timing."""
    if note.startswith("times are made from a tool speed") and "; " in note:
        return note.partition("; ")[2]
    if "at this speed" in note:
        start = note.partition(", doesn't resolve")[0]
        return f"{start}, may be bent by rounding; where it is, laws are slow"
    return note


def _try(robot: Pollard, path: ToolPath, branch: Branch) -> None:
    """Refuse what can't be followed with the places by the path's own time."""
    motion = path.sample(SAMPLES)
    joints = joint_trajectory(robot, motion, branch=branch)
    holding = actuation_along(robot.geometry, joints.solutions.angles)

    def determinant(time: float) -> float:
        there = robot.inverse_kinematics(path.at(time).pose, branch)
        return float(actuation(there.posture).base_determinant[0])

    require_one_sign(determinant, motion.time, holding.base_determinant)
