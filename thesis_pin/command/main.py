"""The command ``thesis-pin``: what works for any robot."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from thesis_pin.command.flags.options import add_audit, add_json, add_report, add_view
from thesis_pin.command.flags.words import (
    perhaps_motion,
    strictly,
    where_to,
    which_derivation,
    which_grid,
    which_list,
    which_motion,
    which_pose,
    which_robot,
    which_stance,
    which_wrenches,
    written,
)
from thesis_pin.command.registry import Command, Parser, Verb
from thesis_pin.command.showing.beside import add_beside
from thesis_pin.command.showing.film import add_film
from thesis_pin.command.showing.meshcat import add_meshcat
from thesis_pin.command.sizing.words import add_kind, add_output

COMMAND = Command(
    "thesis-pin",
    "Any robot, with closed loops or without: is its description sound, what do its motors need, "
    "where can it go, does it stand?",
    (
        Verb(
            "check",
            "is a robot's description sound?",
            "Check a robot's description: names, tree, loops, motors, degrees of freedom, and "
            "where it closes.",
            "check urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml",
            "thesis_pin.loops.checking.soundness:check",
            "thesis_pin.command.verbs.any_robot:check",
            (
                which_robot,
                which_pose,
                strictly,
                written,
                partial(add_json, what="the findings"),
            ),
        ),
        Verb(
            "torque",
            "what do the motors need for a motion?",
            "Torques, loop forces, power and work of any robot whose joints move as a file says.",
            "torque urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml "
            "examples/pollard_motors.csv",
            "thesis_pin.report.torque.document:torque_report",
            "thesis_pin.command.verbs.any_robot:torque",
            (
                which_robot,
                which_motion,
                which_pose,
                which_wrenches,
                partial(add_report, breaks="a motor or joint leaves its limits"),
                add_beside,
            ),
        ),
        Verb(
            "balance",
            "does it keep its balance on its feet?",
            "Forces on the feet of any robot, its torques, and whether it stands, slips or tips: "
            "in a pose or along a motion.",
            "balance example:talos_reduced_box --slope 5",
            "thesis_pin.report.balance.making:balance_report",
            "thesis_pin.command.verbs.balance:balance",
            (
                which_robot,
                which_stance,
                partial(add_report, breaks="it falls, or a motor or joint leaves its limits"),
            ),
        ),
        Verb(
            "size",
            "which motors carry this motion: of a list, or the smallest of any size?",
            "Motors of a list held against what a motion asks of each motor of any robot: safety "
            "factor, RMS; without a list the smallest that would do.",
            "size urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml "
            "examples/pollard_motors.csv --list examples/servos.csv",
            "thesis_pin.sizing.motors:size_motors",
            "thesis_pin.command.verbs.any_robot:size",
            (
                which_robot,
                which_motion,
                which_list,
                which_pose,
                which_wrenches,
                partial(add_kind, per=("joint", "robot"), bounds="box"),
                add_output,
            ),
        ),
        Verb(
            "view",
            "any robot in the browser, moved by sliders or on a motion",
            "Show any robot on 127.0.0.1: with a slider for each joint, loops kept closed, frames, "
            "masses and limits; or on a motion with its loops' forces and the motors' torques.",
            "view urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml "
            "examples/pollard_motors.csv --html view.html",
            "thesis_pin.pages.reports.torque_scene:scene",
            "thesis_pin.command.verbs.any_robot:view",
            (
                which_robot,
                perhaps_motion,
                which_pose,
                which_wrenches,
                add_view,
                add_beside,
                add_meshcat,
                add_film,
            ),
        ),
        Verb(
            "workspace",
            "where can it go, and how well do its motors hold it there?",
            "Reach and conditioning over a grid of motors or of a frame's coordinates, in one "
            "assembly.",
            "workspace urdf/pollard/pollard.urdf urdf/pollard/pollard.closures.yaml "
            "--frame tool_tip --along x 0.2 0.7 --along z -0.4 0.4 --at y 0 --at roll 0 --at pitch "
            "0 --at yaw 0 --points 21 --out space",
            "thesis_pin.loops.workspace.mapped:evaluate_workspace",
            "thesis_pin.command.verbs.workspace:workspace",
            (
                which_robot,
                which_grid,
                which_pose,
                where_to,
                partial(add_json, what="the grid"),
            ),
        ),
        Verb(
            "audit",
            "are the printed equations of a derivation right?",
            "A computed verdict on every equation of anyone's derivation, held against Pinocchio.",
            "audit examples/your_derivation/two_link_arm.toml "
            "--model examples/your_derivation/two_link_arm.urdf",
            "thesis_pin.audit.derivation.auditing:audit_derivation",
            "thesis_pin.command.verbs.audit:derivation",
            (which_derivation, add_audit),
        ),
        Verb(
            "formats",
            "what of a robot's file is read?",
            "Formats of robots: what of each is used, and what is passed over and named.",
            "formats",
            "thesis_pin.report.formats:formats",
            "thesis_pin.command.verbs.any_robot:formats",
            (partial(add_json, what="the formats"),),
        ),
    ),
)


def parser() -> Parser:
    """The command's parser with all its verbs."""
    return COMMAND.parser()


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point; returns the exit code."""
    return COMMAND.main(arguments)
