"""The page of any robot's torque report: bodies where there are shapes, bars where not."""

from pathlib import Path

import numpy as np
import pytest

from thesis_pin.loops.checking.assembly import assembly
from thesis_pin.loops.joints import singles
from thesis_pin.loops.loading import load
from thesis_pin.loops.motion.files import JointMotion, read_motion
from thesis_pin.pages.drawing import frame_placements
from thesis_pin.pages.reports.torque import torque_page
from thesis_pin.pages.reports.torque_scene import scene
from thesis_pin.report.torque.document import torque_report

ROOT = Path(__file__).parents[4]
DATA = ROOT / "tests" / "thesis_pin" / "loops" / "data"


@pytest.fixture(scope="module")
def four_bar():
    robot = load(DATA / "four_bar.urdf", DATA / "four_bar.yaml")
    start = float(singles(robot.model)["motor"].position(assembly(robot).q))
    time = np.linspace(0, 1, 31)[:, None]
    motion = JointMotion(
        "a <b>swing</b>",
        time[:, 0],
        ("motor",),
        start + 0.1 * np.sin(time),
        0.1 * np.cos(time),
        -0.1 * np.sin(time),
    )
    return torque_report(robot, motion)


def test_a_robot_without_shapes_is_drawn_as_bars_from_joint_to_joint(four_bar):
    items = {item.name: item for item in scene(four_bar).items}
    assert not any(name.startswith("body") for name in items)
    ends = [item for name, item in items.items() if name.startswith("bar to")]
    assert len(ends) == 2
    q = four_bar.joints.q
    for item, frame in zip(ends, four_bar.robot.loops[0].frames, strict=True):
        there = frame_placements(four_bar.robot.model, frame, q)[:, :3]
        np.testing.assert_allclose(item.origin + item.vector, there, atol=1e-12)


def test_a_robot_with_shapes_is_drawn_by_them():
    robot = load(*(ROOT / "urdf/pollard" / f"pollard.{end}" for end in ("urdf", "closures.yaml")))
    report = torque_report(robot, read_motion(robot, ROOT / "examples" / "pollard_motors.csv"))
    names = [item.name for item in scene(report).items]
    assert sum(name.startswith("body") for name in names) == len(robot.visual_model.geometryObjects)
    assert not any(name.startswith("bar") for name in names)
    assert sum(name.startswith("force") for name in names) == 2
    assert sum(name.startswith("torque") for name in names) == 6


def test_arrows_of_loop_forces_point_as_the_forces_do(four_bar):
    arrow = next(item for item in scene(four_bar).items if item.name == "force 0")
    np.testing.assert_array_equal(arrow.vector, four_bar.dynamics.force[:, 0])


def test_the_page_says_the_verdict_and_its_texts_are_escaped(four_bar):
    page = torque_page(four_bar).decode()
    for sentence in four_bar.verdict():
        assert sentence.split(";")[0] in page
    assert "a &lt;b&gt;swing" in page
    assert "a <b>swing</b>" not in page
