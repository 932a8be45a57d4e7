"""Pollard's path led by its spray tip, as any robot's: the same torques as by its closed form."""

import numpy as np
import pytest

import pollard_pin
import thesis_pin
from pollard_pin.closure import CLOSURE_PATH
from pollard_pin.motion.curves import appendix_b
from pollard_pin.report.movement import path_movement
from thesis_pin.loops.motion.told import COORDINATES, JointMotion, Tool
from thesis_pin.numeric.quaternions import unbroken
from thesis_pin.numeric.rotations import quaternions
from thesis_pin.report.exchange.movement import content


@pytest.fixture(scope="module")
def anyones():
    return thesis_pin.load(pollard_pin.URDF_PATH, CLOSURE_PATH)


@pytest.fixture(scope="module")
def path(pollard):
    return appendix_b(pollard.specification)


@pytest.fixture(scope="module")
def report(pollard, path):
    return pollard_pin.trajectory_report(pollard, path, samples=201)


def product(w, q):
    """Quaternion product of vectors (w, 0) and q as x, y, z, w."""
    vector = q[:, 3:] * w + np.cross(w, q[:, :3])
    return np.column_stack([vector, -(w * q[:, :3]).sum(axis=1)])


def test_torques_of_the_exact_path_are_the_same(anyones, path, report):
    time = report.joints.time
    tool = path.at(time).tool
    turn = unbroken(quaternions(tool.rotation))
    rate = product(tool.omega, turn) / 2
    push = product(tool.alpha, turn) / 2 + product(tool.omega, rate) / 2
    course = [
        np.column_stack(parts)
        for parts in (
            (tool.position, turn),
            (tool.velocity, rate),
            (tool.acceleration, push),
        )
    ]
    none = np.zeros((len(time), 0))
    led = Tool("tool_tip", COORDINATES)
    motion = JointMotion(
        "path", time, (), none, none, none, course[0], base_change=tuple(course[1:]), tool=led
    )
    found = thesis_pin.torque_report(anyones, motion)
    whole = report.joints.part(slice(None))
    np.testing.assert_allclose(found.joints.q, whole.q, atol=1e-12)
    np.testing.assert_allclose(found.joints.a, whole.a, atol=1e-10)
    np.testing.assert_allclose(found.dynamics.torque, report.torque, atol=1e-11)


def test_torques_of_a_table_of_the_path_are_the_same(anyones, pollard, path, report, tmp_path):
    file = tmp_path / "path.csv"
    file.write_bytes(content(path_movement(pollard, path, samples=2001), "poses"))
    motion = thesis_pin.read_motion(anyones, file, frame="tool_tip")
    found = thesis_pin.torque_report(anyones, motion)
    np.testing.assert_allclose(found.joints.q[::10], report.joints.part(slice(None)).q, atol=1e-9)
    # Accelerations of a spline through samples of 0.01 s are wrong by about 1e-4 of themselves.
    np.testing.assert_allclose(
        found.dynamics.torque[::10][2:-2], report.torque[2:-2], atol=2e-4 * report.torque.max()
    )
    assert found.within_limits


def test_its_place_alone_leaves_the_wrist_free(anyones, tmp_path):
    time = np.linspace(0, 1, 21)
    rows = "\n".join(f"{t},0.45,{0.01 * t},0.05" for t in time)
    (tmp_path / "place.csv").write_text(f"t,x,y,z\n{rows}\n")
    motion = thesis_pin.read_motion(anyones, tmp_path / "place.csv", frame="tool_tip")
    with pytest.raises(thesis_pin.SingularPose, match="wrist_roll"):
        thesis_pin.torque_report(anyones, motion)
