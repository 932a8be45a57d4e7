"""What follows the biped in meshcat: centre of mass, its projection, the support polygon."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial import ConvexHull

import scout_pin
from scout_pin.report.drawn.viewer import overlays


@pytest.fixture(scope="module", params=["free_flyer", "thesis"])
def robot(request):
    return scout_pin.load(root=request.param)


def standing(robot, lift=0.0, angles=None):
    """On both soles in the neutral pose, or above the floor."""
    feet = robot.neutral_feet()
    torso = np.eye(4)
    torso[2, 3] = lift - robot.sole_vertices("left", feet["left"])[:, 2].min()
    return robot.configuration(torso, np.zeros(12) if angles is None else angles)


def drawn(robot, *configurations):
    return {item.name: item for item in overlays(robot, np.array(configurations), 0.2)}


def test_the_centre_of_mass_is_pinocchios_and_stands_above_its_projection(robot):
    q = standing(robot, angles=np.linspace(-0.3, 0.3, 12))
    found = drawn(robot, q)
    com = pin.centerOfMass(robot.model, robot.model.createData(), q)
    np.testing.assert_allclose(found["com"].position[0], com, atol=1e-12)
    np.testing.assert_allclose(found["com_floor"].position[0], com * (1, 1, 0), atol=1e-12)


def test_the_polygon_is_the_hull_of_the_soles_that_lie_on_the_floor(robot):
    both, flying = standing(robot), standing(robot, lift=1e-3)
    bent = np.zeros(12)
    bent[10] = 0.4  # the right knee or ankle: its sole leaves the floor
    one = standing(robot, angles=bent)
    polygon = drawn(robot, both, flying, one)["polygon"]
    assert polygon.which.tolist() == [0, -1, 2]
    for outline, q, sides in (
        (polygon.outlines[0], both, ("left", "right")),
        (polygon.outlines[2], one, ("left",)),
    ):
        data = robot.model.createData()
        pin.framesForwardKinematics(robot.model, data, q)
        corners = [
            robot.sole_vertices(side, data.oMf[robot.sole_frames[side]].homogeneous)[:, :2]
            for side in sides
        ]
        assert ConvexHull(outline[:, :2]).volume == pytest.approx(
            ConvexHull(np.concatenate(corners)).volume, rel=1e-9
        )
        assert (outline[:, 2] == 0).all()
