"""Misuse of the libraries: whatever one argument is, the answer or one of our errors.

Each row calls a public function rightly; the test then replaces one argument at a
time by things it was not made for.
"""

import re
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from pollard_pin.dynamics.inverse import tree_torques
from pollard_pin.motion import curves as pollard_curves
from pollard_pin.motion import samples as pollard_samples
from pollard_pin.motion.feed import at_speed
from pollard_pin.motion.path import ToolMotion
from pollard_pin.thesis import ExplicitModel as PollardExplicit
from scout_pin.thesis import ExplicitModel as ScoutExplicit
from thesis_pin.errors import BadInput, ThesisPinError
from thesis_pin.loops import dynamics as loop_dynamics
from thesis_pin.loops import kinematics as loops
from thesis_pin.loops.loading import load as load_looped
from thesis_pin.model import loading
from thesis_pin.model.mechanism import inertia
from thesis_pin.numeric.interpolation import cubic, interpolate

JUNK = {
    "None": None,
    "zero": 0,
    "minus one": -1,
    "half": 2.5,
    "NaN": float("nan"),
    "infinity": float("inf"),
    "True": True,
    "text": "abc",
    "empty text": "",
    "empty list": [],
    "ragged list": [[1, 2], [3]],
    "list of text": ["a"] * 6,
    "tuple of seven": (1, 1, 1, 1, 1, 1, 1),
    "dict": {},
    "object": object(),
    "function": lambda *_: None,
    "no axes": np.array(0.5),
    "empty array": np.zeros(0),
    "five zeros": np.zeros(5),
    "six NaN": np.full(6, np.nan),
    "complex": np.zeros(6) + 1j,
    "three axes": np.zeros((2, 3, 7)),
    "empty stack of 6": np.zeros((0, 6)),
    "empty stack of 12": np.zeros((0, 12)),
}

DATA = Path(__file__).parents[1] / "thesis_pin" / "loops" / "data"
EXAMPLES = Path(__file__).parents[2] / "examples"
SCOUT, POLLARD = scout_pin.load(), pollard_pin.load()
FEET, GAIT = SCOUT.neutral_feet(), scout_pin.load_gait()
TIMES = GAIT.sample_times(5)
MOTION = GAIT.sample(TIMES)
FREE = SCOUT.to_free_flyer(np.zeros(18), np.zeros(18), np.zeros(18))
POSE = [0.45, 0.0, 0.1, 0.0, 0.0, 0.0]
END = [0.46, 0.0, 0.1, 0.0, 0.0, 0.0]
BRANCH = pollard_pin.DEFAULT_BRANCH
SPRAY = pollard_pin.appendix_b().sample(5)
Q, V, A = POLLARD.joint_motion(POSE, np.full(6, 0.1), np.zeros(6))
MOTORS = Q[[0, 6, 9, 3, 4, 5]]
PATH = pollard_pin.appendix_b()
STACK = {"q": Q[None], "v": V[None], "a": A[None]}
LEG = SCOUT.leg_inverse_kinematics("left", FEET["left"])
LEGS = SCOUT.leg_inverse_kinematics("left", np.stack([FEET["left"]] * 3))
USEFUL = POLLARD.inverse_kinematics([POSE] * 3, "useful")

CALLS = {
    "scout load": (scout_pin.load, {"specification": None, "root": "thesis", "inertia": "printed"}),
    "to_free_flyer": (SCOUT.to_free_flyer, {n: np.zeros(18) for n in "qva"}),
    "to_thesis": (SCOUT.to_thesis, dict(zip("qva", FREE, strict=True))),
    "leg_inverse_kinematics": (
        SCOUT.leg_inverse_kinematics,
        {"side": "left", "torso_to_foot": FEET["left"], "reference": np.zeros(6)},
    ),
    "scout inverse_kinematics": (
        SCOUT.inverse_kinematics,
        {
            "torso": np.eye(4),
            "left_foot": FEET["left"],
            "right_foot": FEET["right"],
            "reference": np.zeros(12),
        },
    ),
    "leg_forward_kinematics": (
        SCOUT.leg_forward_kinematics,
        {"side": "left", "theta": np.zeros(6)},
    ),
    "scout forward_kinematics": (
        SCOUT.forward_kinematics,
        {"theta": np.zeros(12), "torso": np.eye(4)},
    ),
    "sole_vertices": (SCOUT.sole_vertices, {"side": "left", "foot": np.eye(4)}),
    "LegSolutions.explain": (LEG.explain, {"index": (), "branch": 0}),
    "LegSolutions.explain of a stack": (LEGS.explain, {"index": 1, "branch": 0}),
    "load_gait": (scout_pin.load_gait, {"source": "thesis", "interpolation": "cubic"}),
    "Gait.support": (GAIT.support, {"t": TIMES}),
    "Gait.sample_times": (GAIT.sample_times, {"samples": 5}),
    "Gait.rate_jumps": (GAIT.rate_jumps, {"time_unit": 0.1}),
    "Gait.body": (GAIT.body, {"name": "torso", "t": TIMES, "time_unit": 0.1}),
    "Gait.sample": (GAIT.sample, {"t": TIMES, "time_unit": 0.1}),
    "scout joint_trajectory": (
        scout_pin.joint_trajectory,
        {
            "robot": SCOUT,
            "motion": MOTION,
            "branch": ("+++", "-+-"),
            "reference": np.zeros(12),
        },
    ),
    "configuration": (SCOUT.configuration, {"torso": np.eye(4), "angles": np.zeros(12)}),
    "scout inverse_dynamics": (
        scout_pin.inverse_dynamics,
        {"robot": SCOUT, "motion": MOTION, "joints": scout_pin.joint_trajectory(SCOUT, MOTION)},
    ),
    "gait_report": (
        scout_pin.gait_report,
        {"robot": SCOUT, "gait": GAIT, "samples": 5, "time_unit": 0.1, "branch": "+++,-+-"},
    ),
    "touchdown_impact": (
        scout_pin.touchdown_impact,
        {"robot": SCOUT, "q": FREE[0], "v": FREE[1], "side": "left"},
    ),
    "zero_moment_point": (
        scout_pin.zero_moment_point,
        {"mass": 1.0, "com": np.zeros(3), "momentum_rate": np.zeros(6), "ground_height": 0.0},
    ),
    "leg_rates": (
        scout_pin.leg_rates,
        {
            "leg": SCOUT.legs["left"],
            "theta": scout_pin.joint_trajectory(SCOUT, MOTION).q[:, :6],
            "foot": MOTION.left_foot.seen_from(MOTION.torso),
        },
    ),
    "support_margin": (
        scout_pin.support_margin,
        {"robot": SCOUT, "motion": MOTION, "points": np.zeros((len(TIMES), 2))},
    ),
    "Contact.from_outline": (
        scout_pin.Contact.from_outline,
        {"outline": np.array([[0, 0], [1, 0], [0, 1]]), "friction": 0.5},
    ),
    "Contact.margin": (SCOUT.contacts[0].margin, {"wrench": np.ones(6)}),
    "Contact.violation": (SCOUT.contacts[0].violation, {"wrench": np.ones(6)}),
    "scout ExplicitModel.V": (ScoutExplicit().V, {"q": np.zeros(18), "v": np.zeros(18)}),
    "pollard ExplicitModel.margin": (PollardExplicit().margin, {"pose": POSE}),
    "pollard load": (pollard_pin.load, {"specification": None, "inertia": "printed"}),
    "pollard inverse_kinematics": (
        POLLARD.inverse_kinematics,
        {"pose": POSE, "branch": BRANCH, "reference": Q},
    ),
    "pollard forward_kinematics": (POLLARD.forward_kinematics, {"motors": MOTORS, "reference": Q}),
    "posture": (POLLARD.posture, {"q": Q}),
    "pose": (POLLARD.pose, {"q": Q}),
    "branch_of": (POLLARD.branch_of, {"q": Q}),
    "joint_motion": (
        POLLARD.joint_motion,
        {"pose": POSE, "rate": np.zeros(6), "acceleration": np.zeros(6), "branch": BRANCH},
    ),
    "rate_jacobian": (POLLARD.rate_jacobian, {"q": Q}),
    "actuation": (POLLARD.actuation, {"q": Q}),
    "mobility": (POLLARD.mobility, {"q": Q}),
    "pollard joint_trajectory": (
        pollard_pin.joint_trajectory,
        {"robot": POLLARD, "motion": SPRAY, "branch": BRANCH, "reference": np.zeros(12)},
    ),
    "pollard inverse_dynamics": (
        pollard_pin.inverse_dynamics,
        {
            "robot": POLLARD,
            "motion": SPRAY,
            "joints": pollard_pin.joint_trajectory(POLLARD, SPRAY),
        },
    ),
    "inverse_dynamics_at": (
        pollard_pin.inverse_dynamics_at,
        {"robot": POLLARD, "q": Q, "v": V, "a": A, "posture": POLLARD.posture(Q)},
    ),
    "tree_torques": (tree_torques, {"robot": POLLARD, **STACK}),
    "pollard forward_dynamics": (
        POLLARD.forward_dynamics,
        {"q": Q, "v": V, "torque": np.zeros(6)},
    ),
    "simulate": (
        POLLARD.simulate,
        {
            "q": Q,
            "v": np.zeros(12),
            "torque": lambda *_: np.zeros(6),
            "duration": 2e-3,
            "step": 1e-3,
        },
    ),
    "three_torques": (
        pollard_pin.three_torques,
        {"jacobian": POLLARD.rate_jacobian(Q), "joint_force": np.zeros(12), "length": 0.1},
    ),
    "energy": (POLLARD.energy, {"q": Q, "v": V}),
    "Solutions.explain": (POLLARD.inverse_kinematics(POSE).explain, {"index": ()}),
    "Solutions.explain of a stack": (USEFUL.explain, {"index": (1, 2)}),
    "Branch.parse": (pollard_pin.Branch.parse, {"text": "-++-+++"}),
    "appendix_b": (
        pollard_pin.appendix_b,
        {
            "specification": POLLARD.specification,
            "placement": [0.45, 0, 0],
            "orientation": [0, 0, 0],
            "duration": 20,
            "timing": "constant-rate",
        },
    ),
    "Path.at": (PATH.at, {"time": [0.0, 1.0]}),
    "Path.sample": (PATH.sample, {"count": 5}),
    "line": (
        pollard_curves.line,
        {"start": POSE, "end": END, "duration": 1.0, "timing": "rest-to-rest"},
    ),
    "arc": (
        pollard_curves.arc,
        {
            "start": POSE,
            "via": [0.47, 0.05, 0.1],
            "end": END,
            "duration": 1.0,
            "timing": "rest-to-rest",
        },
    ),
    "through": (
        pollard_samples.through,
        {"time": [0, 1, 2], "poses": np.zeros((3, 6)), "method": "cubic"},
    ),
    "joined": (pollard_curves.joined, {"paths": [PATH]}),
    "load_path": (pollard_pin.load_path, {"file": str(EXAMPLES / "spray_arch.toml")}),
    "at_speed": (
        at_speed,
        {
            "position": np.array([[0.4, 0, 0], [0.4, 0.1, 0], [0.4, 0.2, 0.1]]),
            "rotation": np.stack([np.eye(3)] * 3),
            "speed": 0.05,
            "timing": "ramped",
        },
    ),
    "through_orientations": (
        pollard_samples.through_orientations,
        {
            "time": [0, 1, 2],
            "position": np.zeros((3, 3)),
            "rotation": np.stack([np.eye(3)] * 3),
            "method": "cubic",
        },
    ),
    "ToolMotion.of_coordinates": (
        ToolMotion.of_coordinates,
        {
            "time": [0, 1],
            "pose": np.zeros((2, 6)),
            "rate": np.zeros((2, 6)),
            "acceleration": np.zeros((2, 6)),
        },
    ),
    "trajectory_report": (
        pollard_pin.trajectory_report,
        {"robot": POLLARD, "path": PATH, "samples": 5, "branch": BRANCH, "motors": "six"},
    ),
    "evaluate_workspace": (
        pollard_pin.evaluate_workspace,
        {
            "robot": POLLARD,
            "x": [0.4, 0.5],
            "y": 0.0,
            "z": [0.0, 0.1],
            "orientation": [0, 0, 0],
            "branch": BRANCH,
            "jobs": 1,
        },
    ),
    "Placement.of": (
        pollard_pin.Placement.of,
        {"position": [0, 0, 0.1], "turn": 0.1, "mirrored": True},
    ),
    "place_path": (
        pollard_pin.place_path,
        {"path": PATH, "placement": pollard_pin.Placement((0.0, 0.0, 0.1))},
    ),
    "evaluate_placements": (
        pollard_pin.evaluate_placements,
        {
            "robot": POLLARD,
            "path": PATH,
            "x": [0.0, 0.05],
            "y": 0.0,
            "z": 0.0,
            "turn": 0.0,
            "mirrored": False,
            "branch": BRANCH,
            "objective": "torque",
            "condition": 50.0,
            "samples": 5,
            "refine": False,
            "best": 1,
            "start": pollard_pin.Placement(),
            "start_branch": BRANCH,
        },
    ),
    "path_accuracy": (
        pollard_pin.path_accuracy,
        {
            "robot": POLLARD,
            "path": PATH,
            "allowed": None,
            "samples": 3,
            "branch": BRANCH,
            "draws": 2,
            "seed": 0,
            "within": 1e-3,
            "stiffness": 100.0,
        },
    ),
    "workspace_accuracy": (
        pollard_pin.workspace_accuracy,
        {
            "robot": POLLARD,
            "x": [0.4, 0.5],
            "y": 0.0,
            "z": [0.0, 0.1],
            "orientation": [0, 0, 0],
            "allowed": None,
            "branch": BRANCH,
            "draws": 0,
            "seed": 0,
            "within": 1e-3,
            "stiffness": 100.0,
        },
    ),
    "read_tolerances": (
        pollard_pin.read_tolerances,
        {"file": str(EXAMPLES / "tolerances.toml"), "distribution": "normal"},
    ),
    "loops.close": (
        loops.close,
        {"robot": POLLARD, "guess": Q, "motors": MOTORS, "iterations": 20},
    ),
    "loops.jacobian": (loops.jacobian, {"robot": POLLARD, "q": Q}),
    "loops.drift": (loops.drift, {"robot": POLLARD, "q": Q, "v": V}),
    "loops.follow": (
        loops.follow,
        {
            "robot": POLLARD,
            "time": [0.0, 1.0],
            "motors": [MOTORS] * 2,
            "rates": np.zeros((2, 6)),
            "accelerations": np.zeros((2, 6)),
            "guess": Q,
        },
    ),
    "loop_dynamics.inverse_dynamics": (
        loop_dynamics.inverse_dynamics,
        {"robot": POLLARD, "q": Q, "v": V, "a": A},
    ),
    "load": (
        load_looped,
        {"file": DATA / "five_bar.urdf", "closures": DATA / "five_bar.yaml", "root_joint": None},
    ),
    "load_model": (
        loading.load_model,
        {"urdf": SCOUT.urdf.replace("meshes", "."), "root_joint": None},
    ),
    "frame_id": (loading.frame_id, {"model": SCOUT.model, "name": "left_sole"}),
    "check_physical": (
        inertia.check_physical,
        {"link": "arm", "mass": 1.0, "com": np.zeros(3), "centroidal": np.eye(3)},
    ),
    "cubic": (cubic, {"t": [0, 1, 2], "value": [0, 1, 0]}),
    "interpolate": (interpolate, {"t": [0, 1, 2], "value": [0, 1, 0], "method": "cubic"}),
}

ANYTHING = {"check_physical": ["link"]}
"""Arguments that are only told, of which nothing can be wrong."""


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Junk may be a sound name of a file; what it names is written outside the checkout."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", CALLS)
def test_whatever_an_argument_is_only_our_errors_come_out(name):
    call, arguments = CALLS[name]
    call(**arguments)
    taken = []
    for key in arguments:
        refused = 0
        for junk, value in JUNK.items():
            try:
                call(**arguments | {key: value})
            except ThesisPinError:
                refused += 1
            except Exception as error:
                pytest.fail(f"{key} = {junk}: {type(error).__name__}: {error}")
        if not refused and key not in ANYTHING.get(name, ()):
            taken.append(key)
    assert not taken, f"{taken} may be anything at all"


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: scout_pin.load(3), "3 isn't the name of a specification file"),
        (lambda: POLLARD.inverse_kinematics(POSE, tuple(BRANCH)), "branch is a int"),
        (lambda: POLLARD.inverse_kinematics(POSE, []), "branch is empty"),
        (lambda: POLLARD.rates(POSE, np.zeros(6), "useful"), r"Branch\.parse"),
        (lambda: POLLARD.inverse_kinematics(POSE, BRANCH._replace(w=0)), "each 1 or -1"),
        (lambda: USEFUL.explain(), r"stack of shape \(3, 16\) \(poses, then branches\)"),
        (lambda: LEGS.explain(), "a whole number from 0 to 2"),
        (lambda: USEFUL.require_one(), "one pose"),
        (lambda: SCOUT.to_free_flyer(np.zeros(18), a=np.zeros(18)), "a is given without v"),
        (
            lambda: SCOUT.to_free_flyer(np.zeros((2, 18)), np.zeros((3, 18))),
            r"v has shape \(3, 18\)",
        ),
        (lambda: scout_pin.gait_report(scout_pin.load(root="thesis"), GAIT), "root is 'thesis'"),
        (lambda: scout_pin.gait_report(GAIT, GAIT), r"robot is a Gait; allowed: a Scout"),
        (lambda: SCOUT.leg_inverse_kinematics("left", [pin.SE3.Identity(), 3]), "isn't an array"),
    ],
)
def test_the_message_says_what_is_wrong_and_what_was_allowed(call, says):
    with pytest.raises(BadInput) as caught:
        call()
    assert re.search(says, str(caught.value)), str(caught.value)
