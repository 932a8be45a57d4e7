"""Any Pinocchio model is drawn where Pinocchio puts it."""

import numpy as np
import pinocchio as pin
import pytest
from example_robots import NAMES, example_robot

from thesis_pin.errors import BadInput, NotFinite, UnknownName, WrongShape
from thesis_pin.pages import drawing


@pytest.mark.parametrize("name", NAMES)
def test_any_pinocchio_model_becomes_bodies_where_pinocchio_puts_them(name):
    robot, visual, q = example_robot(name)
    items = drawing.robot_items(robot, visual, q)
    assert len(items) == visual.ngeoms
    data, places = robot.createData(), visual.createData()
    for sample in (0, len(q) - 1):
        pin.updateGeometryPlacements(robot, data, visual, places, q[sample])
        for k, item in enumerate(items):
            x, y, z, *quaternion = item.placement[sample]
            moved = pin.SE3(pin.Quaternion(np.array(quaternion)).matrix(), np.array([x, y, z]))
            expected = places.oMg[k].homogeneous
            np.testing.assert_allclose(moved.homogeneous @ item.local, expected, atol=1e-9)


def test_configurations_that_do_not_fit_the_model_are_refused():
    model = pin.buildSampleModelManipulator()
    with pytest.raises(WrongShape, match=r"\(n, 6\)"):
        drawing.joint_placements(model, np.zeros((3, 5)))
    with pytest.raises(NotFinite):
        drawing.joint_placements(model, np.full((3, 6), np.nan))


def test_every_primitive_is_drawable_and_keeps_its_size():
    import coal

    model, geometry = pin.Model(), pin.GeometryModel()
    shapes = {
        "box": coal.Box(1.0, 2.0, 3.0),
        "ball": coal.Sphere(0.5),
        "cylinder": coal.Cylinder(0.2, 0.8),
        "capsule": coal.Capsule(0.2, 0.8),
        "cone": coal.Cone(0.2, 0.8),
        "egg": coal.Ellipsoid(0.1, 0.2, 0.3),
    }
    for name, shape in shapes.items():
        geometry.addGeometryObject(pin.GeometryObject(name, 0, pin.SE3.Identity(), shape))
    found = {i.name: i.geometry for i in drawing.robot_items(model, geometry, np.zeros((2, 0)))}
    assert found["box"] == {"type": "box", "size": [1.0, 2.0, 3.0]}
    assert found["ball"] == {"type": "ellipsoid", "radii": [0.5, 0.5, 0.5]}
    assert found["egg"] == {"type": "ellipsoid", "radii": [0.1, 0.2, 0.3]}
    for name in ("cylinder", "capsule", "cone"):
        assert found[name] == {"type": name, "radius": 0.2, "length": pytest.approx(0.8)}


def test_a_shape_without_surface_is_named():
    import coal

    geometry = pin.GeometryModel()
    plane = coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
    geometry.addGeometryObject(pin.GeometryObject("ground", 0, pin.SE3.Identity(), plane))
    with pytest.raises(BadInput, match="'ground': can't draw a Halfspace"):
        drawing.robot_items(pin.Model(), geometry, np.zeros((2, 0)))


def arm():
    """Two bars in a plane; the second joint's axis is tilted."""
    model = pin.Model()
    first = model.addJoint(0, pin.JointModelRY(), pin.SE3.Identity(), "shoulder")
    tilted = pin.JointModelRevoluteUnaligned(np.array([0.6, 0.0, 0.8]))
    place = pin.SE3(np.eye(3), np.array([1.0, 0.0, 0.0]))
    second = model.addJoint(first, tilted, place, "elbow")
    for name, joint in (("a", first), ("b", second)):
        model.addFrame(pin.Frame(name, joint, place, pin.FrameType.OP_FRAME))
    return model


def test_axes_for_arcs_are_the_axes_pinocchio_turns_about():
    model, q = arm(), np.random.default_rng(3).uniform(-1, 1, (4, 2))
    moves = drawing.joint_placements(model, q)
    for column, name in enumerate(("shoulder", "elbow")):
        found = drawing.axis_placements(model, name, moves)
        for k in range(len(q)):
            x, y, z, w = found[k, 3:]
            axis = pin.Quaternion(w, x, y, z).matrix()[:, 2]
            jacobian = pin.computeJointJacobians(model, model.createData(), q[k])
            np.testing.assert_allclose(axis, jacobian[3:, column], atol=1e-12)
    slider = pin.Model()
    slider.addJoint(0, pin.JointModelPX(), pin.SE3.Identity(), "rail")
    with pytest.raises(BadInput, match="joint 'rail': it is a JointModelPX"):
        drawing.axis_placements(slider, "rail", drawing.joint_placements(slider, q[:, :1]))


def test_closures_show_how_far_a_loop_is_open():
    model, q = arm(), np.array([[0.0, 0.0], [0.3, -0.2]])
    first, second, bar = drawing.closure_items(model, [("a", "b")], q, "loops", 0.1)
    data = model.createData()
    for k in range(2):
        pin.framesForwardKinematics(model, data, q[k])
        a, b = (data.oMf[model.getFrameId(name)].translation for name in "ab")
        np.testing.assert_allclose(first.position[k], a, atol=1e-12)
        np.testing.assert_allclose(second.position[k], b, atol=1e-12)
        np.testing.assert_allclose(bar.vector[k], b - a, atol=1e-12)
    assert second.radius < first.radius  # so that a closed loop shows one ball
    with pytest.raises(UnknownName, match="unknown frame 'c'"):
        drawing.closure_items(model, [("a", "c")], q, "loops", 0.1)
