"""``robot.viewer()``: Pinocchio's viewer of a robot, and what follows it, in meshcat's own page."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

import pollard_pin
import scout_pin
from thesis_pin.errors import BadInput, NotFinite, WrongShape
from thesis_pin.loops.closures import ClosedRobot
from thesis_pin.loops.loading import load
from thesis_pin.pages.meshcat import window
from thesis_pin.pages.meshcat.collada import is_mixed
from thesis_pin.pages.meshcat.robot import RobotViewer, closed
from thesis_pin.pages.meshcat.window import Window

ARM = """<robot name="arm/one"><link name="base"/><link name="arm">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
</link><joint name="hinge" type="revolute"><parent link="base"/><child link="arm"/>
<origin xyz="0 0 0.5"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/>
</joint></robot>"""

MIDDLE = """(() => {
  const node = %s.reduce((node, step) => node.children[step], viewer.scene_tree);
  viewer.scene.updateMatrixWorld(true);
  const box = new MeshCat.THREE.Box3().setFromObject(node.object);
  return viewer.scene.worldToLocal(box.getCenter(new MeshCat.THREE.Vector3())).toArray();
})()"""


def middle(page, *steps):
    return np.array(page.run(MIDDLE % json.dumps(["meshcat", *steps])))


@pytest.mark.browser
def test_a_displayed_configuration_moves_bodies_and_what_follows_them(browser, artefacts):
    robot = scout_pin.load()
    with robot.viewer() as viewer:
        assert isinstance(viewer, pin.visualize.MeshcatVisualizer)
        browser.open(viewer.url)
        browser.until("window.viewer && viewer.scene_tree.children.meshcat?.children.scout")
        q = robot.configuration(pin.SE3(np.eye(3), np.array([0.1, 0.2, 0.4])), np.full(12, 0.1))
        viewer.display(q)
        viewer.viewer["told"].set_property("count", 1)
        browser.until("viewer.scene_tree.children.meshcat.children.told?.object.count === 1")
        data = robot.model.createData()
        com = pin.centerOfMass(robot.model, data, q)
        np.testing.assert_allclose(middle(browser, "scout", "com", "com"), com, atol=1e-6)
        floor = middle(browser, "scout", "com", "com_floor")
        np.testing.assert_allclose(floor, com * (1, 1, 0), atol=1e-6)
        geometry = robot.visual_model
        shown = geometry.createData()
        pin.updateGeometryPlacements(robot.model, data, geometry, shown, q)
        for one, place in zip(geometry.geometryObjects, shown.oMg, strict=True):
            if type(one.geometry).__name__ == "Cylinder":
                where = middle(browser, "scout", "visuals", one.name)
                np.testing.assert_allclose(where, place.translation, atol=1e-6)
        browser.still(artefacts / "meshcat_viewer_scout.png")
        assert browser.complaints() == []
        assert "<script src" not in viewer.static_html()


def test_a_named_server_that_isnt_there_is_an_error(monkeypatch):
    monkeypatch.setattr(window, "FIRST_ANSWER", 0.5)
    with pytest.raises(BadInput, match="no meshcat server answers"):
        scout_pin.load().viewer("tcp://127.0.0.1:9")


def sent(monkeypatch):
    """What is sent to meshcat from now on: (kind, path) of each command."""
    commands = []
    send = Window.send

    def heard(self, command):
        low = command.lower()
        commands.append((low["type"], low["path"]))
        send(self, command)

    monkeypatch.setattr(Window, "send", heard)
    return commands


def test_a_robot_without_shapes_is_drawn_as_bars_and_only_changes_are_sent(monkeypatch, capfd):
    commands = sent(monkeypatch)
    robot = ClosedRobot(ARM)
    with robot.viewer() as viewer:
        assert ("set_object", "/meshcat/arm-one/robot/joint 1 hinge") in commands
        commands.clear()
        viewer.display(robot.q0)
        assert [one for one in commands if one[0] == "set_object"] == []
        assert viewer.jupyter_cell(200).data.count(viewer.url) == 1
    assert capfd.readouterr() == ("", "")


def test_a_named_server_is_shared_by_several_robots():
    with ClosedRobot(ARM).viewer() as first:
        pollard = pollard_pin.load()
        second = pollard.viewer(first.viewer.window.zmq_url)
        assert second.url == first.url
        second.close()
        everything = first.viewer.static_html()  # the first one's server is still there
        assert everything.count("fetch(") > 40


def test_loops_are_closed_at_first():
    for robot in (pollard_pin.load(), ClosedRobot(ARM)):
        q = closed(robot)
        for loop in robot.loops:
            places = []
            data = robot.model.createData()
            pin.framesForwardKinematics(robot.model, data, q)
            places = [data.oMf[frame].translation for frame in loop.ids]
            np.testing.assert_allclose(*places, atol=1e-9)


def test_a_configuration_of_another_robot_is_refused():
    robot = ClosedRobot(ARM)
    with robot.viewer() as viewer:
        with pytest.raises(WrongShape, match="q"):
            viewer.display(np.zeros(3))
        with pytest.raises(NotFinite, match="q"):
            viewer.display([np.nan])
        viewer.display()  # Pinocchio's own way to draw again
        assert repr(viewer) == f"RobotViewer(arm/one, {viewer.url})"


def test_no_browser_is_opened():
    code = (
        "import webbrowser\n"
        "webbrowser.open = webbrowser.get = lambda *_, **__: 1 / 0\n"
        "import pollard_pin\n"
        "pollard_pin.load().viewer()\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


COLLADA = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><library_geometries>
<geometry><mesh><triangles><input semantic="VERTEX"/><input semantic="NORMAL"/></triangles></mesh>
</geometry><geometry><mesh><triangles><input semantic="VERTEX"/><input semantic="NORMAL"/>{more}
</triangles></mesh></geometry></library_geometries></COLLADA>"""


def test_files_that_meshcats_page_makes_nothing_of_are_told(tmp_path):
    file = tmp_path / "body.dae"
    assert not is_mixed(file)
    for more, wanted in (('<input semantic="TEXCOORD"/>', True), ("", False), ("<", False)):
        file.write_text(COLLADA.format(more=more))
        assert is_mixed(file) is wanted


def test_a_body_of_mixed_collada_is_drawn_by_the_corners_that_pinocchio_has():
    robot = load("example:anymal_b_simple_description/anymal")
    mixed = [one for one in robot.visual_model.geometryObjects if is_mixed(one.meshPath)]
    assert Path(mixed[0].meshPath).name == "anymal_base.dae"
    drawn = RobotViewer.loadMeshFromFile(None, mixed[0])
    whole = np.array(mixed[0].geometry.vertices())
    np.testing.assert_allclose(drawn.vertices * mixed[0].meshScale, whole, atol=1e-6)
    assert len(drawn.faces) == mixed[0].geometry.num_tris
