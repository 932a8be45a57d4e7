"""Scenes hold what they say, and refuse what no page could show."""

import json
import re
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from example_robots import NAMES, SHARE, example_robot

from thesis_pin import drawing, scene, viewer
from thesis_pin.errors import BadInput, NotFinite, UnknownName, WrongShape

TIME = np.linspace(0.0, 1.0, 5)
GROUPS = (scene.Group("a", "all"),)


def ball(**changes):
    given = {
        "name": "ball",
        "group": "a",
        "position": np.zeros((5, 3)),
        "radius": 0.1,
        "colours": ("#000000",),
    }
    return scene.Ball(**given | changes)


def made(*items, **changes):
    given = {"title": "t", "description": "d", "time": TIME, "groups": GROUPS, "items": items}
    return scene.Scene(**given | changes)


def decoded(buffer):
    """The player's format, read by a reader of its own."""
    (length,) = struct.unpack("<I", buffer[:4])
    floats = np.frombuffer(buffer[4 + length :], dtype="<f4")

    def revive(value):
        if set(value) == {"$"}:
            start, count = value["$"]
            return floats[start : start + count]
        return value

    return json.loads(buffer[4 : 4 + length], object_hook=revive), len(floats)


@pytest.mark.parametrize(
    ("changes", "error", "says"),
    [
        ({"items": (ball(position=np.zeros((4, 3))),)}, WrongShape, "position of item 'ball'"),
        ({"items": (ball(position=np.full((5, 3), np.inf)),)}, NotFinite, "index (0, 0)"),
        ({"items": (ball(level=np.zeros(4)),)}, WrongShape, "level"),
        ({"items": (ball(group="b"),)}, UnknownName, "unknown group 'b'"),
        ({"items": (ball(), ball())}, BadInput, "two items are called 'ball'"),
        ({"time": TIME[::-1]}, BadInput, "increase strictly"),
        ({"time": np.array([0.0])}, WrongShape, "at least 2"),
        ({"readouts": (scene.Readout("x", np.zeros(3)),)}, WrongShape, "readout 'x'"),
    ],
)
def test_what_no_page_could_show_is_refused_with_item_and_array(changes, error, says):
    with pytest.raises(error) as found:
        made(**changes)
    assert says in str(found.value)


def test_encoding_keeps_every_number_to_single_precision():
    path = np.random.default_rng(5).normal(size=(5, 3))
    arrow = scene.Arrow("arrow", "a", path, 2 * path, 0.5, 0.01, "#112233")
    document, _ = decoded(viewer.encode(made(ball(position=path), arrow)))
    first, second = document["items"]
    np.testing.assert_array_equal(first["samples"]["position"], path.astype("f4").ravel())
    np.testing.assert_array_equal(second["samples"]["vector"], (2 * path).astype("f4").ravel())
    assert (second["kind"], second["scale"], second["colour"]) == ("arrow", 0.5, "#112233")
    np.testing.assert_array_equal(document["time"], TIME.astype("f4"))


def test_arrays_that_items_share_are_stored_once():
    items = [ball(name=f"ball {k}", position=np.arange(15.0).reshape(5, 3)) for k in range(20)]
    _, floats = decoded(viewer.encode(made(*items)))
    assert floats == 15 + len(TIME)


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


def test_thinning_keeps_both_ends_and_short_motions_whole():
    assert scene.thinned(5, 10).tolist() == [0, 1, 2, 3, 4]
    some = scene.thinned(10001, 1201)
    assert (some[0], some[-1], len(some)) == (0, 10000, 1201)


def test_the_example_of_the_documents_runs(tmp_path, monkeypatch):
    document = Path(__file__).parents[2] / "docs" / "viewer.md"
    (code,) = re.findall(r"```python\n(.*?)```", document.read_text(), flags=re.DOTALL)
    robots = SHARE / "example-robot-data" / "robots" / NAMES[0]
    monkeypatch.chdir(tmp_path)
    exec(code.replace('"panda.urdf"', repr(str(robots))).replace('"share"', repr(str(SHARE))), {})
    assert (tmp_path / "panda.html").stat().st_size > 1e5


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


def test_importing_the_viewer_imports_nothing_heavy():
    code = (
        "import sys; from thesis_pin import drawing, page, scene, serving, viewer\n"
        "heavy = {'pinocchio', 'scipy', 'matplotlib', 'meshcat', 'plotly', 'jinja2'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
