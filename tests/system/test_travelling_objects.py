"""Robots, solutions, motions, reports and errors travel: pickle, deepcopy, other processes."""

import copy
import html
import multiprocessing
import pickle
from functools import cache
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from studied import swept

import pollard_pin
import scout_pin
import thesis_pin
from pollard_pin.study.timing.report import time_report
from scout_pin.report.drawn.view import gait_scene
from scout_pin.report.verdict import sentences
from thesis_pin import errors
from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.loading import load

ROOT = Path(__file__).parents[2]
LOOPED = ROOT / "tests" / "thesis_pin" / "loops" / "data"


def looped(root=None):
    return load(LOOPED / "four_bar.urdf", LOOPED / "four_bar.yaml", root_joint=root)


def gait_report():
    return scout_pin.gait_report(scout_pin.load(), scout_pin.load_gait(), samples=21)


def simulation():
    """A second of Scout's knee bend."""
    from scout_pin.study.simulate.conditions import Conditions

    gait = scout_pin.load_gait(ROOT / "examples" / "squat.toml")
    report = scout_pin.gait_report(scout_pin.load(), gait, samples=21, time_unit=0.5)
    return scout_pin.simulate_gait(report, Conditions(time_step=2e-3))


def replay():
    """Appendix B open loop, until it is lost."""
    return pollard_pin.simulate_path(trajectory_report())


def trajectory_report():
    return pollard_pin.trajectory_report(pollard_pin.load(), pollard_pin.appendix_b(), samples=21)


def timed_path():
    """The fastest law along a line."""
    from pollard_pin.motion.curves import line

    path = line([0.45, -0.05, 0, 0, 0, 0], [0.45, 0.05, 0, 0, 0, 0], 1.0)
    return pollard_pin.time_path(pollard_pin.load(), path)


def torque_block(package):
    robot, name = package.load(), "scout" if package is scout_pin else "pollard"
    if name == "scout":
        gait = scout_pin.load_gait()
        return next(iter(scout_pin.torque_blocks(robot, gait, gait.sample_times(21))))
    path = pollard_pin.appendix_b()
    return next(iter(pollard_pin.torque_blocks(robot, path, np.linspace(0, path.duration, 21))))


def joint_motion():
    """A crank's swing about the pose at which the four-bar is closed."""
    robot = looped()
    time = np.linspace(0.0, 1.0, 6)
    crank = assembly(robot).q[robot.actuated_q] + 0.1 * np.sin(time)[:, None]
    return thesis_pin.JointMotion(
        "swing",
        time,
        robot.actuators,
        crank,
        0.1 * np.cos(time)[:, None],
        -0.1 * np.sin(time)[:, None],
    )


def feet_of_scout():
    """Scout as any robot with feet."""
    robot = load(scout_pin.URDF_PATH, root_joint=pin.JointModelFreeFlyer())
    return robot, thesis_pin.find_feet(robot)


FIVE_BAR = LOOPED / "five_bar.yaml"
MAKERS = {
    "Scout": scout_pin.load,
    "Scout in the thesis's coordinates": lambda: scout_pin.load(root="thesis", inertia="printed"),
    "Pollard": pollard_pin.load,
    "ClosedRobot": looped,
    "ClosedRobot, free-flying": lambda: looped(pin.JointModelFreeFlyer()),
    "Specification of Scout": lambda: scout_pin.load().specification,
    "Specification of Pollard": lambda: pollard_pin.load().specification,
    "Gait": scout_pin.load_gait,
    "GaitMotion": lambda: scout_pin.load_gait().sample(np.linspace(0, 40, 9)),
    "LegSolutions": lambda: scout_pin.load().leg_inverse_kinematics("left", STANDING),
    "Contact": lambda: scout_pin.load().contacts[0],
    "GaitReport": gait_report,
    "Plan": lambda: scout_pin.plan_gait(scout_pin.load(), steps=1),
    "PlanRequest": lambda: scout_pin.PlanRequest(speed=0.05, margin=0.004),
    "GaitStudy": lambda: scout_pin.gait_study(samples=41),
    "PlanStudy": scout_pin.plan_study,
    "PathStudy": lambda: pollard_pin.path_study(path=ROOT / "examples" / "spray_arch.toml"),
    "TimeStudy": pollard_pin.time_study,
    "Designs": lambda: swept("x=1,2", "kind=round,flat").designs,
    "Sweep": lambda: swept("x=1,2"),
    "Choice": lambda: thesis_pin.Choice.of(swept("x=1,2"), None, "x<2"),
    "Simulation": simulation,
    "Simulation of a path": replay,
    "ToolPath": pollard_pin.appendix_b,
    "ToolPath of segments": lambda: pollard_pin.load_path(ROOT / "examples" / "spray_arch.toml"),
    "ToolMotion": lambda: pollard_pin.appendix_b().sample(9),
    "Solutions": lambda: pollard_pin.load().inverse_kinematics(POSE, "useful"),
    "Assemblies": lambda: pollard_pin.load().forward_kinematics(np.full(6, 0.1)),
    "Branch": lambda: pollard_pin.DEFAULT_BRANCH,
    "TrajectoryReport": trajectory_report,
    "TimedPath": timed_path,
    "TimeReport": lambda: time_report(timed_path(), samples=21),
    "TorqueBlock of Scout": lambda: torque_block(scout_pin),
    "TorqueBlock of Pollard": lambda: torque_block(pollard_pin),
    "ClosureFile": lambda: thesis_pin.ClosureFile.read(FIVE_BAR),
    "Description": lambda: looped().description,
    "Loop": lambda: looped().loops[0],
    "ForwardDynamics": lambda: thesis_pin.ForwardDynamics(looped()),
    "JointMotion": joint_motion,
    "TorqueReport": lambda: thesis_pin.torque_report(looped(), joint_motion()),
    "Smallest motors": lambda: scout_pin.smallest_motors(gait_report(), curve=True),
    "Foot": lambda: feet_of_scout()[1][0],
    "Floor": lambda: thesis_pin.Floor(),
    "Placed": lambda: thesis_pin.stand(*feet_of_scout(), feet_of_scout()[0].q0),
    "FootDynamics": lambda: thesis_pin.foot_dynamics(*feet_of_scout(), feet_of_scout()[0].q0),
    "BalanceReport": lambda: thesis_pin.balance_report(feet_of_scout()[0]),
    "Workspace": lambda: thesis_pin.evaluate_workspace(
        looped(), {looped().actuators[0]: np.linspace(1.4, 1.5, 3)}
    ),
    "Placements": lambda: pollard_pin.evaluate_placements(
        pollard_pin.load(), pollard_pin.appendix_b(), z=[0.0, 0.05], samples=21
    ),
    "Placement": lambda: pollard_pin.Placement.of([0.0, 0.0, 0.1], 0.2, True),
    "Tolerances": lambda: pollard_pin.read_tolerances(ROOT / "examples" / "tolerances.toml"),
    "Accuracy": lambda: pollard_pin.path_accuracy(
        pollard_pin.load(), pollard_pin.appendix_b(), samples=5, draws=3, within=1e-3
    ),
    "Scene": lambda: gait_scene(gait_report()),
    "LoopDynamics": lambda: thesis_pin.inverse_dynamics(
        looped(), looped().q0, ZERO, ZERO, check=False
    ),
}
STANDING = scout_pin.load().neutral_feet()["left"]
POSE = np.array([0.45, 0.05, 0.1, 0.2, -0.1, 0.3])
ZERO = np.zeros(4)


def same(one, other, seen=None):
    """Whether two objects hold the same numbers and texts, however deep."""
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if hasattr(one, "__dataclass_fields__"):
        names = one.__dataclass_fields__
        return all(same(getattr(one, name), getattr(other, name)) for name in names)
    if isinstance(one, thesis_pin.ClosedRobot | scout_pin.Scout):
        return one.model == other.model and one.urdf == other.urdf
    if type(one).__eq__ is object.__eq__:  # no notion of equality: by its class
        return type(one) is type(other)
    return one == other


def travelled(way, thing):
    return pickle.loads(pickle.dumps(thing)) if way == "pickle" else copy.deepcopy(thing)


@cache
def made(name):
    """A traveller, made once for both ways."""
    return MAKERS[name]()


@pytest.mark.parametrize("way", ["pickle", "deepcopy"])
@pytest.mark.parametrize("name", MAKERS)
def test_an_object_arrives_with_the_numbers_it_left_with(way, name):
    thing = made(name)
    found = travelled(way, thing)
    assert type(found) is type(thing)
    assert same(thing, found)


@pytest.mark.parametrize("used", [False, True])
@pytest.mark.parametrize("way", ["pickle", "deepcopy"])
@pytest.mark.parametrize("name", ["Scout", "Pollard", "ClosedRobot", "ClosedRobot, free-flying"])
def test_a_robot_that_has_travelled_computes_the_same_bits(name, way, used):
    """Also once pools, geometry and contacts have been made."""
    robot = MAKERS[name]()
    if used and name in ("Scout", "Pollard"):
        assert robot.pool is not None
        assert robot.visual_model.ngeoms > 0
    found = travelled(way, robot)
    q = pin.randomConfiguration(robot.model, -np.ones(robot.model.nq), np.ones(robot.model.nq))
    v, a = np.full(robot.model.nv, 0.3), np.full(robot.model.nv, -0.2)
    one, other = (pin.rnea(r.model, r.data, q, v, a) for r in (robot, found))
    np.testing.assert_array_equal(one, other)
    if used and name in ("Scout", "Pollard"):
        assert found.visual_model.ngeoms == robot.visual_model.ngeoms


def test_a_report_that_has_travelled_says_the_same():
    report = gait_report()
    found = travelled("pickle", report)
    assert sentences(found) == sentences(report)
    for other in (trajectory_report(), MAKERS["TorqueReport"]()):
        assert other.verdict() == travelled("pickle", other).verdict()


def test_robots_work_in_a_spawned_process():
    scout, pollard = scout_pin.load(), pollard_pin.load()
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        feet = pool.apply(scout.neutral_feet)
        found = pool.apply(pollard.inverse_kinematics, (POSE,))
        motion = pool.apply(pollard_pin.appendix_b().sample, (9,))
        with pytest.raises(errors.Unreachable, match="outside the joint limits"):
            pool.apply(scout.inverse_kinematics, (np.eye(4), np.eye(4), np.eye(4)))
    np.testing.assert_array_equal(feet["left"], STANDING)
    np.testing.assert_array_equal(found.angles, pollard.inverse_kinematics(POSE).angles)
    np.testing.assert_array_equal(motion.pose, pollard_pin.appendix_b().sample(9).pose)


ERRORS = [
    errors.BadInput("it is wrong", where="file, line 3", allowed="right", remedy="Mend it"),
    errors.WrongShape("q", (3,), "(4,)"),
    errors.NotFinite("q", (2,)),
    errors.UnknownName("joint", "kne", ["knee", "hip"]),
    errors.SingularPose("it is singular", where="sample 3"),
    errors.Unreachable("too far", where="left foot"),
]


@pytest.mark.parametrize("error", ERRORS, ids=lambda error: type(error).__name__)
def test_an_error_arrives_with_its_words(error):
    found = travelled("pickle", error)
    assert type(found) is type(error)
    assert str(found) == str(error)
    assert vars(found) == vars(error)


def test_every_public_class_is_tried():
    known = {name.split(",")[0].split(" ")[0] for name in MAKERS}
    for package in (thesis_pin, scout_pin, pollard_pin):
        for name in dir(package):
            thing = getattr(package, name)
            if isinstance(thing, type) and not issubclass(thing, Exception):
                assert name in known, name


@pytest.mark.parametrize("name", MAKERS)
def test_an_object_shows_itself_in_a_line_and_a_short_table(name):
    """No address, no thousands of numbers; a scene's cell plays and is tried by itself."""
    thing = made(name)
    line = repr(thing)
    assert len(line) <= 200
    assert " at 0x" not in line
    assert "\n" not in line
    if hasattr(thing, "_repr_html_") and name != "Scene":
        cell = thing._repr_html_()
        assert " at 0x" not in cell
        assert cell.count("<tr") <= 22  # twenty rows, headings, what is left out
        assert len(cell) < 40_000
        verdict = getattr(thing, "verdict", None)
        if verdict is not None:
            assert html.escape(verdict()[0]) in cell
            assert cell.index(html.escape(verdict()[0])) < cell.index("<table")
