"""The command ``scout-pin``: its words. What only Scout does is in :mod:`scout_pin.verbs`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from scout_pin.cli.gaits import which_gait, which_pose
from scout_pin.cli.making import which_new, which_urdf
from scout_pin.cli.servos import which_servos, which_size
from scout_pin.cli.sweeps import which_judge
from scout_pin.cli.walks import which_walk
from thesis_pin.command.flags.options import add_json, add_robot
from thesis_pin.command.registry import Command, Parser, Robot, Verb
from thesis_pin.command.verbs import common

ROBOT = Robot(
    package="scout_pin",
    another="another biped",
    motion=which_gait,
    report="report.document:gait_report",
    page="report.drawn.page:gait_page",
    scene="report.drawn.view:gait_scene",
    movement="report.movement:gait_movement",
    simulation="study.simulate.draws:simulate_gait",
    inverse_kinematics="model:Scout.leg_inverse_kinematics",
    still="verbs:still",
    motion_flag="gait",
    sweep="study.sweeping.making:gait_study",
    walks="verbs.sized:walk",
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
            "which servos carry this gait: of a list, or the smallest of any size?",
            "Servos of a list held against what a gait asks of each joint: safety factor, RMS; "
            "without a list the smallest that would do, its time as it is and left free; or for a "
            "walking speed.",
            "size examples/servos.csv --gait examples/walk.toml --time-unit 0.05",
            samples=401,
            per=("robot", "group", "joint"),
            more=which_size,
        ),
        common.sweep_verb(
            ROBOT,
            "which dimensions and servos would do better?",
            "Thousands of bipeds, each judged by the report on a gait or by the walk that is "
            "planned for it: the best, the Pareto front, the one nearest to a wish.",
            "sweep --gait examples/walk.toml --vary 'legs.*.x_3=0.06:0.08:3' "
            "--vary 'servos.*.stall_torque=0.3,0.5' --samples 41 --jobs 1",
            samples=401,
            judges=which_judge,
        ),
        common.simulate_verb(
            ROBOT,
            "does the robot walk this gait, in an engine of its own?",
            "A gait walked by position servos on a floor, in MuJoCo: distance, heading, slip, "
            "tilt, torques beside the plan's; exits with 1 if it does something else.",
            "simulate --gait examples/walk.toml --html simulated.html",
            engine=which_servos,
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
            which_pose,
        ),
        common.info_verb(ROBOT, "info --specification examples/lopsided.toml"),
        Verb(
            "plan",
            "a gait that the robot can walk, from rest to rest",
            "Plan a walk within limits of margin, torque, speed and posture, and judge it.",
            "plan --step-length 30 --margin 10 --steps 4 --out my_walk",
            "scout_pin.study.plan.planning:plan_gait",
            "scout_pin.verbs.planned:plan",
            (partial(add_robot, another=ROBOT.another), which_walk),
        ),
        Verb(
            "new",
            "a biped of your own, and a first gait for it",
            "Write a commented specification, a gait for one, or a shipped example.",
            "new my_biped.toml --force",
            "scout_pin.making.gaits:gait_text",
            "scout_pin.verbs:new",
            (which_new, partial(add_json, what="what was written")),
        ),
        Verb(
            "from-urdf",
            "a URDF of this kind as a specification",
            "Read a biped with leg axes z y z z z x, whatever its frames, into a specification.",
            "from-urdf urdf/scout/scout.urdf --to my_scout.toml --force",
            "scout_pin.making.from_urdf:from_urdf",
            "scout_pin.verbs:from_urdf",
            (which_urdf, partial(add_json, what="joints, signs and notes")),
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
