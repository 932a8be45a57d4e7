"""The command ``pollard-pin``: its words. What only Pollard does is in :mod:`pollard_pin.verbs`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial

from pollard_pin.cli.accuracy import which_tolerances
from pollard_pin.cli.placement import which_places
from pollard_pin.cli.sweeps import which_judge
from pollard_pin.cli.timing import which_geometry, which_law
from thesis_pin.command.flags.drawn_as import add_figures
from thesis_pin.command.flags.numbers import add_number, number
from thesis_pin.command.flags.options import (
    add_branch,
    add_euler,
    add_jobs,
    add_json,
    add_points,
    add_robot,
    add_smooth,
)
from thesis_pin.command.registry import Command, Parser, Robot, Verb
from thesis_pin.command.verbs import common


def _which_curve(words: argparse.ArgumentParser) -> None:
    words.add_argument(
        "--path", metavar="FILE", help=".csv or .toml path (default: the curve of appendix B)"
    )
    add_smooth(words)
    duration = "duration of appendix B's curve (default: the specification's)"
    add_number(words, "--duration", "SECONDS", duration, positive=True)
    words.add_argument(
        "--timing",
        choices=("constant-rate", "rest-to-rest", "ramped"),
        help="timing of appendix B's curve (default: the specification's), or of a path whose "
        "times a tool speed gives (default: ramped)",
    )
    add_euler(words)
    feed = "speed of the spray tip along a path without times [m/s]"
    add_number(words, "--feed", "SPEED", feed, positive=True)


def _which_path(words: argparse.ArgumentParser) -> None:
    _branch(words, default="this one")
    _which_curve(words)
    _which_place(words)


def _which_geometry(words: argparse.ArgumentParser) -> None:
    _branch(words, default="this one")
    which_geometry(words)
    _which_place(words)


def _which_place(words: argparse.ArgumentParser) -> None:
    placement = (
        "what is added to the path's x, y, z [m] (default: nothing; to appendix B's curve, as it "
        "is printed, the specification's)"
    )
    add_number(words, "--placement", ("X", "Y", "Z"), placement)
    turn = "turn the path with its tool about the vertical through its middle, from x towards y [°]"
    add_number(words, "--turn", "DEGREES", turn)
    words.add_argument(
        "--mirror",
        action="store_true",
        help="the path's mirror image, y about its middle, as a left door's is to a right one's",
    )


def _which_path_and_motors(words: argparse.ArgumentParser) -> None:
    _which_path(words)
    words.add_argument(
        "--actuators",
        choices=("six", "three"),
        default="six",
        help="six motors, or the thesis's three with what they can't carry (default: six)",
    )


def _which_pose(words: argparse.ArgumentParser) -> None:
    _branch(words, default="all 16 with f0 f1 f2 at +")
    words.add_argument(
        "pose",
        nargs=6,
        type=number("the pose"),
        metavar="VALUE",
        help="x y z of the spray tip [m], then ψ θ φ of the tool [°]",
    )
    words.add_argument(
        "--allow-singular",
        action="store_true",
        help="answer at singular poses too, with angles that are free set to zero",
    )


def _which_motors(words: argparse.ArgumentParser) -> None:
    words.add_argument(
        "motors",
        nargs=6,
        type=number("a motor angle"),
        metavar="ANGLE",
        help="θ21 θ211 θ212 θ1615 θ1716 θ1817 [°]",
    )


def _which_grid(words: argparse.ArgumentParser) -> None:
    _branch(words, default="this one")
    for axis, default in (("x", [0.1, 0.8]), ("y", [0.0]), ("z", [-0.5, 0.5])):
        text = "one value, or from and to"
        add_number(words, f"--{axis}", "METRES", text, nargs="+", default=default)
    orientation, still = ("PSI", "THETA", "PHI"), (0.0, 0.0, 0.0)
    add_number(words, "--orientation", orientation, "ψ, θ, φ of the tool [°]", default=still)
    add_points(words, 101)
    add_jobs(words)
    words.add_argument("--out", metavar="DIR", help="write workspace.csv, .json and figures")
    add_figures(words)


def _which_engine(words: argparse.ArgumentParser) -> None:
    words.add_argument(
        "--engine",
        choices=("mujoco", "pinocchio"),
        default="mujoco",
        help="MuJoCo, whose ball joints are stiff springs, or Pinocchio's exact constrained "
        "dynamics (default: mujoco)",
    )
    words.add_argument(
        "--open-loop",
        action="store_true",
        help="nothing corrects the torques (default: so it is where no stiffness is given)",
    )
    stiffness = "of a servo at each motor's joint: one number, or six in the motors' order"
    add_number(words, "--stiffness", "N·m/rad", stiffness, nargs="+")
    damping = "the same of its rate (default: critical for what each motor moves at the start)"
    add_number(words, "--damping", "N·m·s/rad", damping, nargs="+")


_branch = partial(
    add_branch,
    signs="seven signs e0 f0 w e1 f1 e2 f2, written --branch=-++-+++",
)
_robot = partial(add_robot, another="another three-chain robot")

ROBOT = Robot(
    package="pollard_pin",
    another="another three-chain robot",
    motion=_which_path_and_motors,
    report="report.document:trajectory_report",
    page="report.drawn.page:trajectory_page",
    scene="report.drawn.view:path_scene",
    movement="report.movement:path_movement",
    simulation="study.simulate.draws:simulate_path",
    inverse_kinematics="model:Pollard.inverse_kinematics",
    motion_flag="path",
    sweep="study.sweeping.making:path_study",
)

COMMAND = Command(
    "pollard-pin",
    "Pollard, a three-chain parallel spray robot: torque reports, animations, kinematics, "
    "workspace, URDF.",
    (
        common.report_verb(
            ROBOT,
            "trajectory",
            "what the motors, joints and ball joints have to do on a path",
            "Torques, power, work, loop reactions and singularity margins on a path.",
            "trajectory --path examples/spray_arch.toml --out report",
            samples=2001,
            breaks="a motor exceeds its limits",
        ),
        Verb(
            "time",
            "how fast can this path be followed?",
            "Laws of motion along a path whose geometry is kept, within limits of motors, ball "
            "joints and tool: the fastest, the largest constant tool speed, the least loading.",
            "time --path examples/spray_arch.toml --torque 2 2 2 0.05 0.05 0.05 --speed 10 "
            "--to fastest.toml",
            "pollard_pin.study.timing.timed:time_path",
            "pollard_pin.verbs:time",
            (_robot, _which_geometry, which_law),
        ),
        common.size_verb(
            ROBOT,
            "which motors carry this path: of a list, or the smallest of any size?",
            "Motors of a list held against what a path asks of each joint: safety factor, RMS; "
            "without a list the smallest that would do, its time as it is and left free.",
            "size examples/servos.csv --path examples/spray_arch.toml",
            samples=2001,
            per=("group", "joint", "robot"),
            bounds="box",
        ),
        common.sweep_verb(
            ROBOT,
            "which lengths and motors would do better?",
            "Thousands of robots, each judged by the report on a path or by the law of motion that "
            "its motors allow: the best, the Pareto front, the one nearest to a wish.",
            "sweep --path examples/spray_arch.toml --vary 'chain_*.x_43=90%:110%:3' "
            "--vary chain_0.x_32=0.3,0.33 --samples 101 --jobs 1",
            samples=2001,
            judges=which_judge,
        ),
        common.simulate_verb(
            ROBOT,
            "does the robot do what was planned, in an engine of its own?",
            "Torques of a path replayed on the closed robot, open loop or under joint servos: "
            "deviation of the tool, loops, energy; exits with 1 if it fails.",
            "simulate --path examples/spray_arch.toml --stiffness 30 30 30 0.3 0.3 0.01",
            engine=_which_engine,
            samples=2001,
        ),
        common.view_verb(
            ROBOT,
            "watch the robot on a path in the browser",
            "Show the robot on a path with torques, ball-joint forces and margins, on 127.0.0.1.",
            "view --path examples/spray_arch.toml --html spray.html",
        ),
        common.convert_verb(
            ROBOT,
            "Write a path as a table of poses, motor angles or servo ticks, in our own format, "
            "or for ROS.",
            "convert --path examples/spray_arch.toml --as joint-trajectory --to arch.yaml",
        ),
        common.ik_verb(
            ROBOT,
            "joint angles for a pose of the tool, every useful branch",
            "The twelve joint angles that bring the spray tip to a pose.",
            "ik 0.45 0 0.05 0 10 0",
            _which_pose,
        ),
        Verb(
            "fk",
            "every assembly mode of six motor angles",
            "Poses of the spray tip for angles of the six motors, every assembly mode.",
            "fk -35 -40 40 0 20 0",
            "pollard_pin.model:Pollard.forward_kinematics",
            "pollard_pin.verbs:fk",
            (_robot, _which_motors, partial(add_json, what="the modes")),
        ),
        Verb(
            "workspace",
            "reach and conditioning over a slice or a volume",
            "Reach, condition number and sign of the actuation over a grid.",
            "workspace --x 0.1 0.8 --y 0 --z -0.5 0.5 --out slice",
            "pollard_pin.study.workspace:evaluate_workspace",
            "pollard_pin.verbs:workspace",
            (_robot, _which_grid, partial(add_json, what="the reachable positions")),
        ),
        Verb(
            "place",
            "where a part should stand, turned or mirrored, on which branch",
            "Judge a grid of placements of a path, refine the best, and report on it.",
            "place --path examples/spray_arch.toml --x -0.05:0.05:0.05 --z 0:0.2:0.05",
            "pollard_pin.study.placement.search:evaluate_placements",
            "pollard_pin.verbs:place",
            (
                _robot,
                partial(_branch, default="this one"),
                _which_curve,
                which_places,
                partial(add_json, what="the placements"),
            ),
        ),
        Verb(
            "accuracy",
            "how far off is the spray tip if lengths, angles and motors are?",
            "Errors of lengths, angles, play and motors at the spray tip, along a path or over the "
            "workspace: at worst, by root sum square, of drawn robots; and which matter most.",
            "accuracy --path examples/spray_arch.toml --tolerances examples/tolerances.toml "
            "--within 1mm",
            "pollard_pin.study.accuracy.study:path_accuracy",
            "pollard_pin.verbs:accuracy",
            (_robot, _which_path, which_tolerances),
        ),
        common.info_verb(ROBOT, "info --inertia printed"),
        common.urdf_verb(
            ROBOT,
            "URDF, closure file and MJCF of a specification",
            "Print the cut-open URDF, or write it in both readings with its closure file and the "
            "MJCF of the closed robot.",
        ),
        common.audit_verb(ROBOT, "audit --equation 2.4.1:A_10"),
    ),
    moved={"check": "thesis-pin check URDF CLOSURES"},
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
