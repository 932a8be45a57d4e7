"""The command ``scout-pin``: its words. What only Scout does is in :mod:`scout_pin.verbs`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial

from scout_pin.cli.walks import which_walk
from thesis_pin.command import common, options
from thesis_pin.command.options import add_branch, add_json, count, number
from thesis_pin.command.registry import Command, Parser, Robot, Verb

_branch = partial(
    add_branch,
    signs="the way the knees bend, forward or backward, or three signs S_E S_2 S_K, written "
    "--branch=+-+; for both legs, or for left and right, --branch=+++,-+-",
)


def _which_gait(words: argparse.ArgumentParser) -> None:
    _branch(words, default="the gait's, the specification's, else nearest to neutral")
    words.add_argument(
        "--gait",
        metavar="NAME|FILE",
        help="thesis, thesis-program, a .toml gait or a .csv of samples (default: thesis)",
    )
    words.add_argument(
        "--interpolation",
        choices=("linear", "quadratic", "cubic", "free", "quintic"),
        help="method for the gait's nodes, instead of the gait's own",
    )
    options.add_smooth(words)
    words.add_argument(
        "--time-unit",
        type=number("--time-unit", positive=True),
        metavar="SECONDS",
        help="seconds in the gait's unit of t (default: the gait's own)",
    )
    words.add_argument(
        "--cycle",
        action="store_true",
        help="the gait's end is its start, a step further (as cycle = true in its file)",
    )
    words.add_argument(
        "--repeat",
        type=count("--repeat", 1),
        default=1,
        metavar="N",
        help="walk the gait N times, each time a step further and with as many samples "
        "(default: 1)",
    )


def _which_new(words: argparse.ArgumentParser) -> None:
    words.add_argument("target", metavar="FILE|-", help="what to write; - is standard output")
    words.add_argument(
        "--motion",
        choices=("squat", "sway"),
        help="write a first gait for the robot of --specification, made from its neutral soles",
    )
    words.add_argument(
        "--specification", metavar="FILE", help="the robot of --motion (default: the thesis's)"
    )
    words.add_argument(
        "--example", metavar="NAME", help="write a shipped example, as walk.toml; any lists them"
    )
    _force(words)


def _which_urdf(words: argparse.ArgumentParser) -> None:
    words.add_argument(
        "file", metavar="FILE", help="a URDF, MJCF or SDF, or example:NAME of example-robot-data"
    )
    words.add_argument(
        "--to",
        metavar="FILE|-",
        default="-",
        help="where the specification goes (default: standard output)",
    )
    words.add_argument(
        "--left", metavar="JOINT", help="a joint of the left leg (default: found by its name)"
    )
    words.add_argument(
        "--sole",
        nargs=5,
        type=number("--sole", positive=True),
        metavar=("LEFT", "RIGHT", "HEEL", "TOES", "HEIGHT"),
        help="edges of both soles from the point below the ankle, and the ankle's height above "
        "them [m] (default: the lowest face of each foot's shapes)",
    )
    words.add_argument(
        "--servo",
        nargs=2,
        type=number("--servo", positive=True),
        metavar=("TORQUE", "SPEED"),
        help="stall torque [N·m] and no-load speed [rad/s] of joints whose limits say none",
    )
    options.add_friction(words)
    _force(words)


def _force(words: argparse.ArgumentParser) -> None:
    words.add_argument("--force", action="store_true", help="replace a file that is there")


def _which_servos(words: argparse.ArgumentParser) -> None:
    words.add_argument(
        "--servo-stiffness",
        type=number("--servo-stiffness", positive=True),
        default=20.0,
        metavar="N·m/rad",
        help="how a position servo gives way (default: 20)",
    )
    words.add_argument(
        "--servo-damping",
        type=number("--servo-damping"),
        default=0.05,
        metavar="N·m·s/rad",
        help="how it is damped (default: 0.05)",
    )
    words.add_argument(
        "--armature",
        type=number("--armature"),
        default=5e-4,
        metavar="kg·m²",
        help="inertia of rotors as joints feel it, where the specification has none "
        "(default: 0.0005)",
    )
    words.add_argument(
        "--no-sag-compensation",
        action="store_true",
        help="command the planned angles, not beyond them by what the servos give way",
    )
    words.add_argument(
        "--friction",
        type=number("--friction", positive=True),
        metavar="NUMBER",
        help="coefficient between sole and floor, at least 1e-6 (default: the specification's)",
    )
    words.add_argument(
        "--floor-tilt",
        nargs=2,
        type=number("--floor-tilt", within=(-45.0, 45.0), unit="degrees"),
        default=(0.0, 0.0),
        metavar=("AHEAD", "RIGHT"),
        help="angles by which the floor rises ahead and to the right [°] (default: 0 0)",
    )


def _which_pose(words: argparse.ArgumentParser) -> None:
    _branch(words, default="all")
    words.add_argument("side", choices=("left", "right"))
    words.add_argument(
        "--position",
        nargs=3,
        required=True,
        type=number("--position"),
        metavar=("X", "Y", "Z"),
        help="origin of the sole in the torso frame [m]",
    )
    words.add_argument(
        "--rotation",
        nargs=3,
        default=(0.0, 0.0, 0.0),
        type=number("--rotation"),
        metavar=("PITCH", "ROLL", "YAW"),
        help="Rx(pitch) Ry(roll) Rz(yaw) [°] (default: 0 0 0)",
    )


ROBOT = Robot(
    package="scout_pin",
    another="another biped",
    motion=_which_gait,
    report="report.document:gait_report",
    page="report.drawn.page:gait_page",
    scene="report.drawn.view:gait_scene",
    movement="report.movement:gait_movement",
    simulation="study.simulate.draws:simulate_gait",
    inverse_kinematics="model:Scout.leg_inverse_kinematics",
    still="verbs:still",
)

COMMAND = Command(
    "scout-pin",
    "Scout, an 18-DoF biped: torque reports, animations, inverse kinematics, URDF.",
    (
        common.report_verb(
            ROBOT,
            "gait",
            "can this gait walk, and can the servos carry it?",
            "Torques, contact forces, stability and servo limits of a gait.",
            "gait --gait examples/walk.toml --time-unit 0.05 --out report",
            samples=401,
            breaks="the gait breaks a limit",
        ),
        common.size_verb(
            ROBOT,
            "which servos of a list carry this gait?",
            "Servos of a list held against what a gait asks of each joint: safety factor, RMS.",
            "size examples/servos.csv --gait examples/walk.toml --time-unit 0.05",
            samples=401,
        ),
        common.simulate_verb(
            ROBOT,
            "does the robot walk this gait, in an engine of its own?",
            "A gait walked by position servos on a floor, in MuJoCo: distance, heading, slip, "
            "tilt, torques beside the plan's; exits with 1 if it does something else.",
            "simulate --gait examples/walk.toml --html simulated.html",
            engine=_which_servos,
            samples=401,
        ),
        common.view_verb(
            ROBOT,
            "watch a gait in the browser",
            "Show the robot along a gait with forces, ZMP and support, on 127.0.0.1.",
            "view --gait examples/walk.toml --html walk.html",
        ),
        common.convert_verb(
            ROBOT,
            "Write a gait as a table of poses, joint angles or servo ticks, in our own format, "
            "or for ROS.",
            "convert --gait examples/walk.toml --to walk_angles.csv --as joints --units deg,ms",
        ),
        common.ik_verb(
            ROBOT,
            "joint angles of one leg for a foot pose, every branch",
            "Every set of joint angles that brings a sole to a pose in the torso frame.",
            "ik left --position -0.0445 -0.02 -0.22 --rotation 5 0 10",
            _which_pose,
        ),
        common.info_verb(ROBOT, "info --specification examples/lopsided.toml"),
        Verb(
            "plan",
            "a gait that the robot can walk, from rest to rest",
            "Plan a walk within limits of margin, torque, speed and posture, and judge it.",
            "plan --step-length 30 --margin 10 --steps 4 --out my_walk",
            "scout_pin.study.plan.planning:plan_gait",
            "scout_pin.verbs.planned:plan",
            (
                partial(options.add_robot, another=ROBOT.another),
                partial(which_walk, branch=_branch),
            ),
        ),
        Verb(
            "new",
            "a biped of your own, and a first gait for it",
            "Write a commented specification, a gait for one, or a shipped example.",
            "new my_biped.toml --force",
            "scout_pin.making.gaits:gait_text",
            "scout_pin.verbs:new",
            (_which_new, partial(add_json, what="what was written")),
        ),
        Verb(
            "from-urdf",
            "a URDF of this kind as a specification",
            "Read a biped with leg axes z y z z z x, whatever its frames, into a specification.",
            "from-urdf urdf/scout/scout.urdf --to my_scout.toml --force",
            "scout_pin.making.from_urdf:from_urdf",
            "scout_pin.verbs:from_urdf",
            (_which_urdf, partial(add_json, what="joints, signs and notes")),
        ),
        common.urdf_verb(
            ROBOT,
            "the URDF of a specification",
            "Print the URDF, or write it in both readings with its meshes into a folder.",
        ),
        common.audit_verb(ROBOT, "audit --equation 4.3.3:dot_e_9i"),
    ),
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
