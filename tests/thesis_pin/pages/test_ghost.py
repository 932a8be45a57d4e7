"""A ghost is the same robot at other configurations, translucent, in a group of its own."""

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
from thesis_pin.errors import BadInput, NotFinite, WrongShape
from thesis_pin.pages import drawing, player, scene
from thesis_pin.pages.ghost import with_ghost


@pytest.fixture(scope="module")
def robot():
    return pollard_pin.load()


@pytest.fixture
def rng():
    return np.random.default_rng(5)


def picture(robot, q):
    return scene.Scene(
        title="t",
        description="d",
        time=np.arange(float(len(q))),
        groups=(scene.Group("robot", "robot"),),
        items=tuple(drawing.robot_items(robot.model, robot.visual_model, q)),
    )


def test_a_ghost_stands_where_its_own_configurations_put_it(robot, rng):
    q, other = rng.uniform(-1, 1, (2, 5, 12))
    both = with_ghost(picture(robot, q), robot.model, robot.visual_model, other, "plan")
    shapes = [item for item in both.items if item.group == "ghost"]
    assert len(shapes) == len(robot.visual_model.geometryObjects)
    data = robot.model.createData()
    for k in range(5):
        pin.forwardKinematics(robot.model, data, other[k])
        for shape, own in zip(shapes, robot.visual_model.geometryObjects, strict=True):
            place = data.oMi[own.parentJoint]
            np.testing.assert_allclose(shape.placement[k, :3], place.translation, atol=1e-12)
            turned = pin.Quaternion(shape.placement[k, 3:]).toRotationMatrix()
            np.testing.assert_allclose(turned, place.rotation, atol=1e-12)


def test_a_ghost_is_translucent_and_changes_nothing_of_the_robot(robot, rng):
    q, other = rng.uniform(-1, 1, (2, 5, 12))
    alone = picture(robot, q)
    both = with_ghost(alone, robot.model, robot.visual_model, other, "plan")
    assert both.items[: len(alone.items)] == alone.items
    assert all(item.opacity < 1 and item.ghost for item in both.items[len(alone.items) :])
    assert both.groups[-1].label == "plan"
    assert both.groups[-1].key == "g"


def test_a_ghost_brings_no_shape_a_second_time(robot, rng):
    """Meshes weigh most of a page; a ghost shares those of its robot."""
    q, other = rng.uniform(-1, 1, (2, 5, 12))
    alone = picture(robot, q)
    both = with_ghost(alone, robot.model, robot.visual_model, other)
    moves = 4 * 7 * 5 * len(robot.visual_model.geometryObjects)  # float32 placements
    words = 700 * len(robot.visual_model.geometryObjects)
    assert len(player.encode(both)) - len(player.encode(alone)) < moves + words


@pytest.mark.parametrize(
    ("q", "error"),
    [
        (np.zeros((4, 12)), WrongShape),
        (np.zeros((5, 11)), WrongShape),
        (np.full((5, 12), np.nan), NotFinite),
    ],
)
def test_a_ghost_that_does_not_fit_the_scene_is_refused(robot, q, error):
    with pytest.raises(error):
        with_ghost(picture(robot, np.zeros((5, 12))), robot.model, robot.visual_model, q)


def test_one_ghost_is_enough(robot):
    q = np.zeros((5, 12))
    both = with_ghost(picture(robot, q), robot.model, robot.visual_model, q)
    with pytest.raises(BadInput, match="two items"):
        with_ghost(both, robot.model, robot.visual_model, q)
