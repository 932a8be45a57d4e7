"""Pollard's pages in a real browser: loops closed, arrows, arcs and traces where they belong."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from chromium import differing, share_drawn

import pollard_pin
from pollard_pin.motion.curves import appendix_b, line
from pollard_pin.report.drawn import curves
from pollard_pin.report.drawn.page import trajectory_page
from pollard_pin.report.drawn.view import path_scene
from pollard_pin.report.judged.limits import MARGIN_BOUNDS
from pollard_pin.specification import ACTUATOR_NAMES
from thesis_pin.pages import player as viewer

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def report():
    robot = pollard_pin.load()
    path = appendix_b(robot.specification, duration=10.0)
    return pollard_pin.trajectory_report(robot, path, samples=601)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pages")


@pytest.fixture(scope="module")
def file(report, folder):
    viewer.write_html(path_scene(report), folder / "pollard.html")
    return folder / "pollard.html"


@pytest.fixture
def view(browser, file):
    browser.watch(file)
    return browser


SAMPLES = (0, 130, 422, 600)


def test_ten_seconds_make_a_quiet_page_under_3_mb_that_draws_and_moves(
    view, file, report, artefacts
):
    assert file.stat().st_size < 3e6
    assert view.requests() == [file.as_uri()]
    assert view.complaints() == []
    first = view.still()
    assert share_drawn(first) > 0.01
    view.run("player.time = 4")
    assert differing(first, view.still(artefacts / "pollard_view.png")) > 2000


def test_every_group_can_be_hidden_and_shown_again(view):
    names = view.run("[...player.groups.keys()]")
    assert names == ["robot", "loops", "tip", "trace", "spray", "torques", "forces"]
    view.run("player.time = player.duration / 2")
    before = view.still()
    for name in names:
        view.run(f"player.toggle({name!r})")
        assert differing(before, view.still()) > 20, name
        view.run(f"player.toggle({name!r})")
        assert differing(before, view.still()) < 20, name


def test_loops_look_closed_at_the_ball_joints_pinocchio_finds(view, report):
    for sample in SAMPLES:
        view.run(f"player.time = {report.joints.time[sample]}")
        model, data = report.robot.model, report.robot.model.createData()
        pin.framesForwardKinematics(model, data, report.joints.q[sample])
        for pair in [loop.frames for loop in report.robot.loops]:
            first, second = (view.vertices(name).mean(axis=0) for name in pair)
            place = data.oMf[model.getFrameId(pair[0])].translation
            np.testing.assert_allclose(first, second, atol=2e-4)
            radius = np.linalg.norm(view.vertices(pair[0]) - place, axis=1)
            np.testing.assert_allclose(radius, 0.011, atol=2e-6)
            assert view.shown(" to ".join(pair)) is False


def test_arrows_have_the_size_and_direction_of_the_ball_joint_forces(view, report):
    for sample in SAMPLES:
        view.run(f"player.time = {report.joints.time[sample]}")
        model, data = report.robot.model, report.robot.model.createData()
        pin.framesForwardKinematics(model, data, report.joints.q[sample])
        largest = np.linalg.norm(report.dynamics.loop_force, axis=-1).max()
        for i, (anchor, _) in enumerate([loop.frames for loop in report.robot.loops]):
            start = data.oMf[model.getFrameId(anchor)].translation
            force = report.dynamics.loop_force[sample, i]
            points = view.vertices(f"loop_force_{i + 1}")
            tip = points[np.argmax((points - start) @ force)]
            np.testing.assert_allclose(tip, start + 0.12 / largest * force, atol=1e-5)


def test_the_spray_starts_at_the_tip_and_points_along_the_tool(view, report):
    for sample in SAMPLES:
        view.run(f"player.time = {report.joints.time[sample]}")
        model, data = report.robot.model, report.robot.model.createData()
        pin.framesForwardKinematics(model, data, report.joints.q[sample])
        tool = data.oMf[model.getFrameId("tool_tip")]
        np.testing.assert_allclose(tool.translation, report.motion.pose[sample, :3], atol=1e-12)
        points = view.vertices("spray")
        tip = points[np.argmax(points @ tool.rotation[:, 0])]
        np.testing.assert_allclose(tip, tool.act(np.array([0.08, 0.0, 0.0])), atol=1e-5)


def test_torque_arcs_turn_about_their_motors_by_their_share(view, report):
    for sample in SAMPLES:
        view.run(f"player.time = {report.joints.time[sample]}")
        model, data = report.robot.model, report.robot.model.createData()
        jacobian = pin.computeJointJacobians(model, data, report.joints.q[sample])
        for k, name in enumerate(ACTUATOR_NAMES):
            joint = model.getJointId(name)
            axis = jacobian[3:, model.joints[joint].idx_v]
            torque = report.torque[sample, k]
            full = np.abs(report.torque[:, :3] if k < 3 else report.torque[:, 3:]).max()
            turned = view.run(
                "(() => { const item = player.items.find((i) => i.name === "
                f"'torque_{name}'); const [ring, head] = item.object.children[0].children;"
                "player.stage.world.updateMatrixWorld(true);"
                "const at = (x, y) => "
                "ring.localToWorld(new MeshCat.THREE.Vector3(x, y, 0)).toArray();"
                "return [at(0, 0), at(1, 0), head.getWorldPosition(new MeshCat.THREE.Vector3())"
                ".toArray()]; })()"
            )
            centre, start, head = map(np.array, turned)
            np.testing.assert_allclose(centre, data.oMi[joint].translation, atol=1e-6)
            if abs(torque) < 1e-3 * full:
                continue
            begin, end = start - centre, head - centre
            end /= np.linalg.norm(end)
            angle = np.arctan2(np.cross(begin, end) @ axis, begin @ end)
            expected = 2 * np.pi * torque / full
            assert np.exp(1j * angle) == pytest.approx(np.exp(1j * expected), abs=1e-3)


def test_between_samples_bodies_are_where_the_mean_angles_put_them(view, report):
    robot, data = report.robot, report.robot.model.createData()
    names = [shape.name for shape in robot.visual_model.geometryObjects]
    places = robot.visual_model.createData()
    for k in (70, 333):
        view.run(f"player.time = {report.joints.time[k : k + 2].mean()}")
        middle = report.joints.q[k : k + 2].mean(axis=0)
        pin.updateGeometryPlacements(robot.model, data, robot.visual_model, places, middle)
        for name in ("forearm_0", "chain1_rod_0", "chain2_rod_0"):
            # Half a sample's motion moves these by millimetres.
            box = view.vertices(name)
            centre = (box.max(axis=0) + box.min(axis=0)) / 2
            expected = places.oMg[names.index(name)].translation
            np.testing.assert_allclose(centre, expected, atol=2e-4)


def test_the_tip_warns_as_the_arm_is_stretched(report):
    assert set(report.distance_class) == {2.0}
    outwards = line([0.45, 0, 0, 0, 0, 0], [0.80, 0, 0, 0, 0, 0], 2.0)
    stretching = pollard_pin.trajectory_report(report.robot, outwards, samples=41)
    zone = stretching.distance_class
    assert set(zone) == {0.0, 1.0, 2.0}
    assert (np.diff(zone) <= 0).all()
    assert (stretching.solutions.margin[zone == 0] < MARGIN_BOUNDS[0]).all()
    assert (stretching.solutions.margin[zone == 2] >= MARGIN_BOUNDS[1]).all()
    label = path_scene(stretching).readouts[2]
    assert label.texts[int(label.values[-1])] == "nearly singular"


def test_the_report_page_is_complete_quiet_and_fits_a_phone(browser, report, folder, artefacts):
    file = folder / "report.html"
    file.write_bytes(trajectory_page(report))
    plots = curves.plots(report)
    for width, height, mobile in ((1280, 900, False), (390, 844, True)):
        browser.open(file.as_uri(), width, height, mobile)
        browser.until("window.ready && player.framesDrawn > 0")
        assert browser.requests() == [file.as_uri()]
        assert browser.complaints() == []
        drawn = browser.run("document.querySelectorAll('.plot .cartesianlayer').length")
        assert drawn == len(plots)
        assert browser.run("document.documentElement.scrollWidth") <= width
        browser.run("player.pause(); player.time = 3")
        browser.still(artefacts / f"pollard_report_{width}.png")
    text = browser.run("document.querySelector('main').innerText")
    for words in ("Pollard can follow this path", "Motors", "Joint reactions", "Assumptions"):
        assert words in text
