"""Links against links: what the specification gives the shape of, and what is only drawn."""

import numpy as np
import pinocchio as pin
import pytest

import scout_pin
from scout_pin.motion.collisions import collisions
from scout_pin.motion.files import load_gait
from scout_pin.motion.trajectory import joint_trajectory
from scout_pin.specification import Specification
from thesis_pin.errors import SpecificationError

from ..conftest import EXAMPLES


def with_shapes(**links):
    """The thesis's robot with shapes of some links, by ``left_shank`` and the like."""
    data = Specification.read().model_dump()
    names = ("hip", "pelvis", "thigh", "shank", "ankle", "foot")
    for name, shapes in links.items():
        side, _, link = name.partition("_")
        body = data["torso"] if name == "torso" else data["legs"][side]["links"][names.index(link)]
        body["collision"] = shapes
    return scout_pin.load(Specification.model_validate(data))


def found(robot, samples=61):
    gait = load_gait(EXAMPLES / "walk.toml")
    motion = gait.sample(gait.sample_times(samples))
    joints = joint_trajectory(robot, motion)
    return motion, joints, collisions(robot, motion, joints)


def centres(robot, motion, joints, frame, point):
    """A point of a link in the world at each sample, by Pinocchio."""
    model, data = robot.model, robot.model.createData()
    number, result = model.getFrameId(frame), []
    for k in range(len(motion.t)):
        q = robot.configuration(motion.torso.placement[k], joints.q[k])
        pin.framesForwardKinematics(model, data, q)
        result.append(data.oMf[number].act(np.array(point)))
    return np.array(result)


def test_balls_on_both_shanks_touch_exactly_where_their_centres_are_near(scout):
    """Their distance along the walk, worked out by hand, with radii just below and above half."""
    motion, joints, _ = found(scout)
    knees = [centres(scout, motion, joints, f"{s}_shank", (0, 0, 0)) for s in ("left", "right")]
    apart = np.linalg.norm(knees[0] - knees[1], axis=1)
    neutral = [scout.data.oMf[scout.model.getFrameId(f"{s}_shank")] for s in ("left", "right")]
    pin.framesForwardKinematics(scout.model, scout.data, pin.neutral(scout.model))
    assert np.linalg.norm(neutral[0].translation - neutral[1].translation) > apart.min() + 2e-3
    for change, touch in ((-1e-4, False), (1e-4, True)):
        ball = [{"sphere": apart.min() / 2 + change}]
        robot = with_shapes(left_shank=ball, right_shank=ball)
        _, _, result = found(robot)
        assert result.judged == ("left_shank", "right_shank")
        pairs = [one.links for one in result.touching if "sole" not in "".join(one.links)]
        assert pairs == ([("left_shank", "right_shank")] if touch else [])
        report = scout_pin.gait_report(robot, load_gait(EXAMPLES / "walk.toml"), samples=61)
        assert report.can_walk != touch
        assert bool(report.time_units) != touch
        said = any("left_shank and right_shank collide" in one for one in report.verdict())
        assert said == touch


@pytest.mark.parametrize(
    "shape",
    [
        {"box": [0.2, 0.2, 0.2], "at": [0, 0, 0]},
        {"capsule": 0.1, "ends": [[0, 0, 0], [0.05, 0, 0]]},
        {"sphere": 0.1},
    ],
)
def test_what_touches_in_the_neutral_pose_is_left_out_and_listed(shape):
    robot = with_shapes(left_shank=[shape], right_shank=[shape])
    result = found(robot, 11)[2]
    assert ("left_shank", "right_shank") in result.neutral
    assert all(one.links != ("left_shank", "right_shank") for one in result.touching)


def test_neighbours_are_left_out_and_listed(scout):
    result = found(scout, 11)[2]
    assert ("torso", "left_hip") in result.neighbours
    assert ("left_thigh", "left_shank") in result.neighbours
    assert ("left_ankle", "left_sole") in result.neighbours
    assert ("left_shank", "right_shank") not in result.neighbours


def test_shapes_that_are_only_drawn_are_a_note_and_no_verdict(scout):
    """Knees and hips drawn twice as large touch; nobody said that they have that size."""
    data = Specification.read().model_dump()
    for servo in data["servos"].values():
        servo["size"] = (0.04, 0.058, 0.058)
    robot = scout_pin.load(Specification.model_validate(data))
    report = scout_pin.gait_report(robot, load_gait(EXAMPLES / "walk.toml"), samples=41)
    assert report.collisions.judged == ()
    assert report.collisions.touching == ()
    assert report.collisions.drawn
    assert report.can_walk
    assert any(sentence.startswith("As drawn, ") for sentence in report.verdict())
    document = report.summary()["collisions"]
    assert document["drawn_touching"]
    assert document["touching"] == []
    assert {"neighbours", "touching_in_neutral"} == set(document["left_out"])


@pytest.mark.parametrize(
    ("shape", "says"),
    [
        ({}, "needs one of box, sphere, capsule"),
        ({"sphere": 0.01, "box": [0.1, 0.1, 0.1]}, "needs one of"),
        ({"capsule": 0.01}, "a capsule has ends"),
        ({"sphere": 0.01, "ends": [[0, 0, 0], [1, 0, 0]]}, "a capsule has ends"),
        ({"capsule": 0.01, "ends": [[0, 0, 0], [0, 0, 0]]}, "must differ"),
        ({"sphere": 0.01, "rpy_deg": [1, 0, 0]}, "only a box"),
    ],
)
def test_a_shape_that_is_none_is_refused_with_its_key(tmp_path, shape, says):
    text = scout_pin.specification.SCOUT_PATH.read_text()
    values = ", ".join(f"{key} = {value}" for key, value in shape.items())
    path = tmp_path / "robot.toml"
    path.write_text(text.replace("[torso]", f"[torso]\ncollision = [{{ {values} }}]", 1))
    with pytest.raises(SpecificationError) as caught:
        Specification.read(path)
    (problem,) = caught.value.problems
    assert "torso.collision" in problem.key
    assert says in problem.what
    assert f"{path}:" in problem.where


def test_the_urdf_carries_given_shapes_as_collision_and_draws_what_it_drew():
    capsule = {"capsule": 0.01, "ends": [[0, 0, 0], [0.06, 0, 0]]}
    box = {"box": [0.04, 0.02, 0.03], "at": [0.01, 0, 0], "rpy_deg": [0, 90, 0]}
    robot = with_shapes(left_shank=[capsule, box])
    shapes = [
        one
        for one in robot.collision_model.geometryObjects
        if robot.model.frames[one.parentFrame].name == "left_shank"
    ]
    kinds = sorted(type(one.geometry).__name__ for one in shapes)
    assert kinds == ["Box", "Cylinder", "Sphere", "Sphere"]
    (cuboid,) = [one for one in shapes if type(one.geometry).__name__ == "Box"]
    np.testing.assert_allclose(2 * np.array(cuboid.geometry.halfSide), [0.04, 0.02, 0.03])
    plain = scout_pin.load()
    drawn = [len(one.visual_model.geometryObjects) for one in (robot, plain)]
    assert drawn[0] == drawn[1]
